// What an agent tells of itself: its state, what keeps it from its work, its status; and how often it asks for the
// time.

#include <algorithm>

#include "agent/core/agent.hpp"
#include "common/base/text.hpp"

namespace gyre::agent {

protocol::AgentState Agent::state(LocalTime now) const {
  const std::optional<SwarmTime> time = swarm_time(now);
  const mechanics::CarrierSlice* slice = plans_.find(course_.base.number);
  if (!time || slice == nullptr) return protocol::AgentState::kWaiting;
  if (coordinator_.silent(now)) return protocol::AgentState::kAlone;
  return course_.rests(*time) ? protocol::AgentState::kReady : protocol::AgentState::kFlying;
}

std::optional<std::string> Agent::complaint(LocalTime now) const {
  if (!coordinator_.ever_heard()) return "no coordinator was heard";
  if (coordinator_.silent(now)) {
    return text("the coordinator is silent since %.1f s", seconds(now - *coordinator_.last()));
  }
  if (const auto complaint = clock_.complaint()) return complaint;
  if (!believed_) return "another agent flies this carrier, at " + rival_ + "; end one of the two";
  if (!rival_.empty()) return "another agent claims this carrier, at " + rival_ + "; end one of the two";
  if (!clock_.synchronised()) return "swarm time was not found";
  if (plans_.find(course_.base.number) == nullptr) return "has no plan yet";
  if (vehicles_.contested(now)) return "two vehicles, or simulators, tell where this carrier is; end one of them";
  // Whoever takes over is followed within kSucceeded.
  if (led_by_another(now) && now - *unfollowed_since_ > 2 * protocol::kSucceeded) {
    return "its vehicle follows another agent; end one of the two";
  }
  if (withheld_ && now - withheld_->at <= options_.complained) return withheld_->why;
  const Duration budget = heard_ ? heard_->skew_budget : Duration::zero();
  const Duration uncertainty = clock_.uncertainty(now);
  // Another agent's clock may be as wrong, the other way.
  if (budget > Duration::zero() && uncertainty > budget / 2) {
    return text("its clock may be wrong by %.3g ms, the plan in force allows %.3g ms", 1e3 * seconds(uncertainty),
                1e3 * seconds(budget / 2));
  }
  if (vehicle_ && now - vehicle_heard_ > options_.vehicle_timeout) {
    return text("its vehicle is silent since %.1f s", seconds(now - vehicle_heard_));
  }
  return std::nullopt;
}

protocol::AgentStatus Agent::status(LocalTime now) {
  next_status_ = now + (now < awaited_until_ ? options_.status_period_awaited : options_.status_period);
  protocol::AgentStatus s;
  s.carrier = options_.carrier;
  s.incarnation = options_.incarnation;
  s.sequence = ++statuses_;
  s.term = term_;
  s.state = state(now);
  if (const auto time = swarm_time(now)) s.swarm_time = *time;
  s.clock_uncertainty = clock_.uncertainty(now);
  s.clock_drift_ppm = clock_.drift_ppm();
  s.course = course_;
  s.confirmed = confirmed_;
  s.accepted = plans_.accepted();
  s.refused = plans_.refused();
  s.refusal = plans_.refusal().substr(0, protocol::kMaxTextBytes);
  s.beacons_received = beacons_received_;
  s.beacons_missed = beacons_missed_;
  s.dropped = dropped_;
  s.dropped.nonsense += undecodable_;
  s.address = options_.address;
  return s;
}

Duration Agent::request_period(LocalTime now) const {
  // The answer decides whether it may go on; and a leap makes the coordinator seem silent, too.
  if (const auto& suspicion = watch_.suspicion()) {
    return requested_at_ < suspicion->since ? Duration::zero() : options_.request_period_unanswered_at_start;
  }
  if (coordinator_.silent(now)) return options_.request_period;  // nobody answers: no reason to hurry
  const bool answered = requests_answered_ == requests_;
  if (!clock_.synchronised()) return answered ? Duration::zero() : options_.request_period_unanswered_at_start;
  return answered && !contradicted_ ? options_.request_period : options_.request_period_unanswered;
}

}  // namespace gyre::agent
