#include "agent/core/agent.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/protocol/course.hpp"
#include "common/protocol/sanity.hpp"
#include "common/protocol/term.hpp"

namespace gyre::agent {

using protocol::Stage;

namespace {

/// A motion slower than that is as good as none.
constexpr double kLongestPeriod_s = 3600.0;

MergeLimits merge_limits(const mechanics::Limits& vehicle) {
  const MergeLimits cautious;
  return {vehicle.speed_max_m_s.value_or(cautious.speed_m_s),
          vehicle.acceleration_max_m_s2.value_or(cautious.acceleration_m_s2),
          vehicle.winch_rate_max_m_s.value_or(cautious.winch_rate_m_s)};
}

/// The reference as a command: the cable is paid out short by what its tension stretches it, l0 = l − s / k.
Command command_of(const mechanics::Reference& r, double stiffness_n_m) {
  Command command{r.position_w_m, r.length_m};
  if (stiffness_n_m > 0.0) command.winch_m = command.winch_m - (1.0 / stiffness_n_m) * r.tension_n;
  return command;
}

/// Whether it is one plan's motion and nothing else, now and before.
bool plain(const protocol::Course& course) {
  return std::none_of(course.transitions.begin(), course.transitions.end(),
                      [](const protocol::Transition& t) { return t.stage == Stage::kGo; });
}

bool finite(const protocol::Setpoint& s) {
  return s.position_w_m.allFinite() && s.velocity_w_m_s.allFinite() && s.acceleration_w_m_s2.allFinite() &&
         s.direction_w.allFinite() && std::isfinite(s.winch_length_m + s.winch_rate_m_s + s.winch_acceleration_m_s2);
}

/// Where a carrier is `age_s` after it said so.
Command command_of(const protocol::CarrierState& s, double age_s) {
  return {{s.position_w_m + age_s * s.velocity_w_m_s, s.velocity_w_m_s, Eigen::Vector3d::Zero()},
          {s.winch_length_m + age_s * s.winch_rate_m_s, s.winch_rate_m_s, 0.0}};
}

}  // namespace

Agent::Agent(const AgentOptions& options)
    : options_(options),
      clock_(options.timekeeper),
      plans_(options.vehicle),
      merge_(merge_limits(options.vehicle)),
      coordinator_(options.coordinator_timeout) {}

Outputs Agent::step(LocalTime now, const Event& event) {
  Outputs out;
  std::visit([&](const auto& e) { on(now, e, out); }, event);
  out.next_tick = next_tick_;
  return out;
}

std::optional<SwarmTime> Agent::swarm_time(LocalTime now) const {
  if (!clock_.synchronised()) return std::nullopt;
  return clock_.at(now);
}

void Agent::on(LocalTime now, const Tick& /*tick*/, Outputs& out) {
  if (now < next_tick_) return;
  // A stall is not made up for: the next tick is one period from now, not a burst of the missed ones.
  next_tick_ += options_.control_period;
  if (next_tick_ <= now) next_tick_ = now + options_.control_period;

  if (now >= next_request_) {
    next_request_ = now + (clock_.synchronised() ? options_.request_period : options_.request_period_at_start);
    out.time_request = protocol::TimeRequest{options_.carrier, options_.incarnation, ++requests_, now};
  }
  const std::optional<SwarmTime> time = swarm_time(now);
  if (time) {
    protocol::settle(course_, *time);
    const auto r = reference(course_, *time);
    if (r && back_at_the_vehicle(now)) {
      const protocol::Setpoint s = setpoint(*time, *r);
      if (finite(s)) out.setpoint = s;  // where a mixture's forces cancel, the cable has no direction to be flown
    }
  }
  const bool alone = coordinator_.ever_heard() && coordinator_.silent(now);
  if (alone != alone_) {
    alone_ = alone;
    out.notices.push_back({alone ? Notice::Level::kWarning : Notice::Level::kInfo,
                           alone ? "the coordinator is silent: flying on alone" : "the coordinator is back"});
  }
  if (now >= next_status_) out.status = status(now);
}

bool Agent::accepts_term(std::uint64_t term, Outputs& out) {
  if (term < term_) {
    ++dropped_.wrong_term;
    return false;
  }
  if (term > term_) {
    if (term_ != 0) {
      out.notices.push_back(
          {Notice::Level::kInfo, text("a new coordinator took over: term %llu", protocol::generation(term))});
      // It learned swarm time from us and the others; it may be off by what we are apart.
      clock_.doubt(std::chrono::milliseconds(1));
    }
    term_ = term;
    confirmed_ = 0;  // what was confirmed was confirmed to the former one, whose transitions had numbers of their own
    heard_.reset();
  }
  return true;
}

void Agent::on(LocalTime now, const protocol::Beacon& beacon, Outputs& out) {
  if (!sane(beacon)) {
    ++dropped_.nonsense;
    return;
  }
  if (const auto time = swarm_time(now)) {
    const Duration age = *time - beacon.swarm_time;
    const Duration age_max = options_.beacon_age_max + std::min(clock_.uncertainty(now), kLongest);
    if (age > age_max || age < -age_max) {
      ++(age > Duration::zero() ? dropped_.late : dropped_.nonsense);
      return;
    }
  }
  if (!accepts_term(beacon.term, out)) return;
  if (heard_ && beacon.sequence <= heard_->sequence) {
    ++(beacon.sequence == heard_->sequence ? dropped_.duplicate : dropped_.late);
    return;
  }
  if (heard_) beacons_missed_ += beacon.sequence - heard_->sequence - 1;
  ++beacons_received_;
  coordinator_.heard(now);
  heard_ = beacon;
  adopt(now, beacon.course, out);
}

void Agent::on(LocalTime now, const protocol::PlanOffer& offer, Outputs& out) {
  if (!sane(offer) || offer.carrier != options_.carrier) {
    ++dropped_.nonsense;
    return;
  }
  if (!accepts_term(offer.term, out)) return;
  const protocol::PlanNumber refused_before = plans_.refused();
  if (!plans_.take(offer.slices, protocol::plans_of(course_))) return;
  if (plans_.refused() != refused_before) {
    out.notices.push_back({Notice::Level::kError, "plan refused: " + plans_.refusal()});
  }
  if (heard_) adopt(now, heard_->course, out);
  out.held = protocol::HeldPlans{options_.carrier, options_.incarnation, plans_.held()};
  out.status = status(now);  // the coordinator is waiting for this answer
}

void Agent::adopt(LocalTime now, const protocol::Course& course, Outputs& out) {
  const std::optional<SwarmTime> time = swarm_time(now);
  if (!time) return;
  const bool newer = term_ > course_term_ || course.revision > course_.revision || course_.base.number.none();
  protocol::Course wanted = course;
  protocol::settle(wanted, *time);
  // Without one of its plans there is no reference: a course is flown whole or not at all.
  if (newer && reference(wanted, *time) && merge_to(now, wanted)) {
    course_ = wanted;
    course_term_ = term_;
  }
  const std::uint64_t confirmed_before = confirmed_;
  confirm_proposal(*time);
  if (confirmed_ != confirmed_before) out.status = status(now);
}

Path Agent::path(const protocol::Course& course) const {
  const mechanics::CarrierSlice& slice = *plans_.find(course.base.number);
  Path path;
  path.at = [this, &course, k = slice.cable_stiffness_n_m](SwarmTime at) {
    return command_of(*reference(course, at), k);
  };
  if (plain(course) && mechanics::moves(slice))
    path.period = from_seconds(std::min(kTwoPi / slice.rate_rad_s, kLongestPeriod_s));
  return path;
}

bool Agent::merge_to(LocalTime now, const protocol::Course& course) {
  const SwarmTime time = clock_.at(now);
  if (reference(course_, time)) {
    const bool another = !(course.base == course_.base && plain(course) && plain(course_));
    if (another) merge_.begin(time, merge_.apply(time, path(course_)), path(course));
    return true;
  }
  if (!wants_vehicle_since_) wants_vehicle_since_ = now;
  if (vehicle_) {
    begin_at_the_vehicle(now, path(course));
  } else if (now - *wants_vehicle_since_ < options_.vehicle_wait) {
    return false;
  }
  return true;
}

/// After a stall, its own or the wire's to the vehicle, the vehicle has gone on by itself: what it is told next begins
/// where it is. False while that is unknown.
bool Agent::back_at_the_vehicle(LocalTime now) {
  if (flown_at_ && now - *flown_at_ > options_.stall && !awake_since_) {
    awake_since_ = now;
    vehicle_.reset();
  }
  if (awake_since_) {
    const Duration awake = now - *awake_since_;
    if (awake < options_.backlog || (!vehicle_ && awake < options_.vehicle_wait)) return false;
    if (vehicle_) begin_at_the_vehicle(now, path(course_));
    awake_since_.reset();
  }
  flown_at_ = now;
  return true;
}

void Agent::begin_at_the_vehicle(LocalTime now, const Path& path) {
  merge_.begin(clock_.at(now), command_of(*vehicle_, seconds(now - vehicle_heard_)), path);
  flown_at_ = now;  // a stall before the first setpoint is one, too
}

void Agent::confirm_proposal(SwarmTime now) {
  for (const protocol::Transition& t : course_.transitions) {
    if (t.stage == Stage::kProposed && t.start > now && plans_.find(t.to.number) != nullptr) {
      confirmed_ = std::max(confirmed_, t.id);
    }
  }
}

void Agent::on(LocalTime now, const TimeReplyArrived& event, Outputs& out) {
  const protocol::TimeReply& reply = event.reply;
  if (reply.carrier != options_.carrier || reply.incarnation != options_.incarnation || reply.sequence > requests_ ||
      event.arrived > now) {
    ++dropped_.nonsense;
    return;
  }
  if (reply.sequence <= requests_answered_) {
    ++(reply.sequence == requests_answered_ ? dropped_.duplicate : dropped_.late);
    return;
  }
  if (!accepts_term(reply.term, out)) return;
  requests_answered_ = reply.sequence;  // believed or not: a copy of a lie is not a second witness
  const bool before = clock_.synchronised();
  const auto verdict =
      clock_.observe({reply.request_sent, reply.request_received, reply.reply_sent, event.arrived}, now);
  if (verdict != protocol::Timekeeper::Verdict::kTaken) {
    ++dropped_.nonsense;
    return;
  }
  if (!before && clock_.synchronised()) {
    out.notices.push_back(
        {Notice::Level::kInfo, text("swarm time found, uncertain by %.3f ms", 1e3 * seconds(clock_.uncertainty(now)))});
    if (heard_) adopt(now, heard_->course, out);
    out.status = status(now);  // the coordinator is waiting for that, too
  }
}

void Agent::on(LocalTime now, const protocol::CarrierState& state, Outputs& /*out*/) {
  if (!sane(state) || state.carrier != options_.carrier) {
    ++dropped_.nonsense;
    return;
  }
  // Silent while this agent was awake; after a stall of its own, what comes first is old (back_at_the_vehicle).
  const bool was_silent =
      vehicle_ && now - vehicle_heard_ > options_.vehicle_timeout && flown_at_ && now - *flown_at_ <= options_.stall;
  vehicle_ = state;
  vehicle_heard_ = now;
  if (was_silent && is_lost(now)) awake_since_ = now;
}

bool Agent::is_lost(LocalTime now) const {
  const std::optional<SwarmTime> time = swarm_time(now);
  if (!time || !reference(course_, *time)) return false;
  const Command asked = merge_.apply(*time, path(course_));
  return (asked.position_w_m.value - vehicle_->position_w_m).norm() > options_.vehicle_lost_m;
}

std::optional<mechanics::Reference> Agent::reference(const protocol::Course& course, SwarmTime now) const {
  const auto stack =
      protocol::layers(course, now, [this](const protocol::PlanNumber& number) { return plans_.find(number); });
  if (stack.empty()) return std::nullopt;
  return mechanics::evaluate_course(stack.data(), stack.size(), 0.0);
}

protocol::Setpoint Agent::setpoint(SwarmTime now, const mechanics::Reference& r) {
  // Nearly always there is nothing to merge, and `r` is all of it.
  const Command command = merge_.under_way(now) ? merge_.apply(now, path(course_))
                                                : command_of(r, plans_.find(course_.base.number)->cable_stiffness_n_m);
  protocol::Setpoint s;
  s.carrier = options_.carrier;
  s.sequence = ++setpoints_;
  s.swarm_time = now;
  s.position_w_m = command.position_w_m.value;
  s.velocity_w_m_s = command.position_w_m.first;
  s.acceleration_w_m_s2 = command.position_w_m.second;
  s.direction_w = r.direction_w.value;
  s.tension_n = r.tension_n.value;
  s.cable_length_m = r.length_m.value;
  s.winch_length_m = command.winch_m.value;
  s.winch_rate_m_s = command.winch_m.first;
  s.winch_acceleration_m_s2 = command.winch_m.second;
  return s;
}

protocol::AgentState Agent::state(LocalTime now) const {
  const std::optional<SwarmTime> time = swarm_time(now);
  const mechanics::CarrierSlice* slice = plans_.find(course_.base.number);
  if (!time || slice == nullptr) return protocol::AgentState::kWaiting;
  if (coordinator_.silent(now)) return protocol::AgentState::kAlone;
  return mechanics::moves(*slice) || protocol::in_transition(course_, *time) ? protocol::AgentState::kFlying
                                                                             : protocol::AgentState::kReady;
}

std::optional<std::string> Agent::complaint(LocalTime now) const {
  if (!coordinator_.ever_heard()) return "no coordinator was heard";
  if (coordinator_.silent(now)) {
    return text("the coordinator is silent since %.1f s", seconds(now - *coordinator_.last()));
  }
  if (!clock_.synchronised()) return "swarm time was not found";
  if (plans_.find(course_.base.number) == nullptr) return "has no plan yet";
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

bool Agent::is_awaited(LocalTime now) const {
  const std::optional<SwarmTime> time = swarm_time(now);
  return time && std::any_of(course_.transitions.begin(), course_.transitions.end(), [&](const auto& transition) {
           return *time < transition.start + options_.awaited_after_start;
         });
}

protocol::AgentStatus Agent::status(LocalTime now) {
  next_status_ = now + (is_awaited(now) ? options_.status_period_awaited : options_.status_period);
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
  return s;
}

}  // namespace gyre::agent
