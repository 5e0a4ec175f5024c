#include "simulator/core/setpoint_judge.hpp"

#include <cmath>

#include "common/protocol/age_judge.hpp"
#include "simulator/core/extrapolation.hpp"

namespace gyre::simulator {

SetpointJudge::SetpointJudge(const mechanics::Plan& plan, double longest_rest_m)
    : load_position_w_m_(plan.load.position_w_m), reach_m_(kReachMargin_m + kReachFactor * longest_rest_m) {
  for (const mechanics::Carrier& carrier : plan.carriers) last_[carrier.id] = {};
}

bool SetpointJudge::has_plausible_stamp(const protocol::Setpoint& setpoint) {
  const Duration stamp = setpoint.swarm_time.time_since_epoch();
  return stamp >= -protocol::kLongestStamp && stamp <= protocol::kLongestStamp;
}

SetpointJudge::Stamp SetpointJudge::judge_stamp(Last& last, SwarmTime stamp, LocalTime arrived, bool fresh_start) {
  if (!last.any) return Stamp::kGoesOn;
  const auto apart = [](Duration a, Duration b) { return a > b ? a - b : b - a; };
  const Duration delay = arrived.time_since_epoch() - stamp.time_since_epoch();
  const Duration before = last.arrived.time_since_epoch() - last.swarm_time.time_since_epoch();
  if (apart(delay, before) <= kContradiction) {
    last.agreeing = 0;
    return Stamp::kGoesOn;
  }
  if (fresh_start) return Stamp::kBeginsAnew;
  last.agreeing = last.agreeing > 0 && apart(delay, last.contradicting) <= kContradiction ? last.agreeing + 1 : 1;
  last.contradicting = delay;
  return last.agreeing < kAgreeing ? Stamp::kContradicts : Stamp::kBeginsAnew;
}

std::optional<std::string> SetpointJudge::objection(const protocol::Setpoint& setpoint, LocalTime arrived) {
  if (auto text = nonsense(setpoint)) {
    ++dropped_.nonsense;
    return text;
  }
  Last& last = last_.at(setpoint.carrier);
  if (!last.agent.believes(arrived, setpoint.incarnation)) {
    ++dropped_.duplicate;
    return "carrier " + std::to_string(setpoint.carrier) + ": a setpoint of another agent than the one that flies it";
  }
  bool fresh_start = !last.any || arrived - last.arrived > from_seconds(kExtrapolationHorizon_s);
  const Stamp stamp = judge_stamp(last, setpoint.swarm_time, arrived, fresh_start);
  if (stamp == Stamp::kContradicts) {
    ++dropped_.nonsense;
    return "carrier " + std::to_string(setpoint.carrier) + ": a setpoint stamped by another clock than those before";
  }
  fresh_start = fresh_start || stamp == Stamp::kBeginsAnew;
  if (!fresh_start && setpoint.swarm_time == last.swarm_time) {
    ++dropped_.duplicate;
    return "carrier " + std::to_string(setpoint.carrier) + ": the same setpoint twice";
  }
  if (!fresh_start && setpoint.swarm_time < last.swarm_time) {
    ++dropped_.late;
    return "carrier " + std::to_string(setpoint.carrier) + ": a setpoint older than the one being flown";
  }
  last.any = true;
  last.swarm_time = setpoint.swarm_time;
  last.arrived = arrived;
  last.began_anew = stamp == Stamp::kBeginsAnew;
  last.agreeing = 0;
  return std::nullopt;
}

std::uint64_t SetpointJudge::follows(CarrierId carrier, LocalTime now) const {
  const protocol::Incumbent& agent = last_.at(carrier).agent;
  return agent.silent(now) ? 0 : *agent.who();
}

std::vector<CarrierId> SetpointJudge::contested(LocalTime now) const {
  std::vector<CarrierId> out;
  for (const auto& [carrier, last] : last_) {
    if (last.agent.contested(now)) out.push_back(carrier);
  }
  return out;
}

std::optional<std::string> SetpointJudge::nonsense(const protocol::Setpoint& s) const {
  const std::string who = "setpoint for carrier " + std::to_string(s.carrier) + ": ";
  if (last_.count(s.carrier) == 0) return who + "the mission has no such carrier";
  if (!has_plausible_stamp(s)) {
    return who + "stamped with a time that no swarm's clock shows";
  }
  const bool finite = s.position_w_m.allFinite() && s.velocity_w_m_s.allFinite() && s.acceleration_w_m_s2.allFinite() &&
                      std::isfinite(s.winch_length_m) && std::isfinite(s.winch_rate_m_s) &&
                      std::isfinite(s.winch_acceleration_m_s2);
  if (!finite) return who + "a value is not a finite number";
  if ((s.position_w_m - load_position_w_m_).norm() > reach_m_) {
    return who + "further than " + std::to_string(reach_m_) + " m from the load";
  }
  if (s.winch_length_m < 0.0 || s.winch_length_m > reach_m_) {
    return who + "winch length outside 0 to " + std::to_string(reach_m_) + " m";
  }
  if (s.velocity_w_m_s.norm() > kAbsurdSpeed_m_s || std::abs(s.winch_rate_m_s) > kAbsurdSpeed_m_s) {
    return who + "faster than " + std::to_string(kAbsurdSpeed_m_s) + " m/s";
  }
  if (s.acceleration_w_m_s2.norm() > kAbsurdAcceleration_m_s2 ||
      std::abs(s.winch_acceleration_m_s2) > kAbsurdAcceleration_m_s2) {
    return who + "accelerated by more than " + std::to_string(kAbsurdAcceleration_m_s2) + " m/s2";
  }
  return std::nullopt;
}

}  // namespace gyre::simulator
