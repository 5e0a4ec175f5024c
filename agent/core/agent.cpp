#include "agent/core/agent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/protocol/course.hpp"
#include "common/protocol/follow.hpp"
#include "common/protocol/sanity.hpp"
#include "common/protocol/term.hpp"

namespace gyre::agent {

namespace {

/// A motion slower than that is as good as none.
constexpr double kLongestPeriod_s = 3600.0;
/// One axis told in two ways, before and after it is settled, differs by no more.
constexpr Duration kRounding(2);
constexpr double kNoPace = 1e-9;

MergeLimits merge_limits(const mechanics::Limits& vehicle) {
  const MergeLimits cautious;
  return {vehicle.speed_max_m_s.value_or(cautious.speed_m_s),
          vehicle.acceleration_max_m_s2.value_or(cautious.acceleration_m_s2),
          vehicle.winch_rate_max_m_s.value_or(cautious.winch_rate_m_s)};
}

Command command_of(const mechanics::Reference& r, double stiffness_n_m) {
  return {r.position_w_m, mechanics::paid_out(r, stiffness_n_m)};
}

}  // namespace

Agent::Agent(const AgentOptions& options)
    : options_(options),
      clock_(options.timekeeper),
      plans_(options.vehicle, options.machines),
      merge_(merge_limits(options.vehicle)),
      steps_(options.vehicle, options.stall),
      coordinator_(options.coordinator_timeout),
      vehicles_(options.vehicle_timeout) {}

Outputs Agent::step(LocalTime now, const Event& event) {
  Outputs out;
  // What waited for a process that was stopped is as old as that, whenever it says that it arrived. To whoever flies it
  // does not matter soon; whoever is about to begin would begin there.
  if (stepped_at_ && now - *stepped_at_ > (flown_at_ ? options_.stall : 5 * options_.control_period)) {
    listen(now);
  }
  stepped_at_ = now;
  watch_.step(now);
  std::visit([&](const auto& e) { on(now, e, out); }, event);
  out.next_tick = next_tick_;
  return out;
}

std::optional<SwarmTime> Agent::swarm_time(LocalTime now) const {
  if (!clock_.synchronised()) return std::nullopt;
  return clock_.at(now);
}

void Agent::on(LocalTime now, const Tick& tick, Outputs& out) {
  undecodable_ = tick.undecodable;
  if (now < next_tick_) return;
  // A stall is not made up for: the next tick is one period from now, not a burst of the missed ones.
  const bool hurries = !clock_.synchronised() && !coordinator_.silent(now);
  const Duration period = hurries ? options_.hurry : options_.control_period;
  next_tick_ += period;
  if (next_tick_ <= now) next_tick_ = now + period;

  if (!requested_at_ || now - *requested_at_ >= request_period(now)) {
    requested_at_ = now;
    out.time_request = protocol::TimeRequest{options_.carrier, options_.incarnation, ++requests_, now};
  }
  const std::optional<SwarmTime> time = swarm_time(now);
  if (time && !doubts_clock(now)) {
    protocol::settle(course_, *time);
    const auto r = reference(course_, *time);
    if (r && back_at_the_vehicle(now)) send(now, setpoint(*time, *r), out);
  }
  const bool alone = coordinator_.ever_heard() && coordinator_.silent(now) && !doubts_clock(now);
  if (alone != alone_) {
    alone_ = alone;
    out.notices.push_back({alone ? Notice::Level::kWarning : Notice::Level::kInfo,
                           alone ? "the coordinator is silent: flying on alone" : "the coordinator is back"});
  }
  if (now >= next_status_) out.status = status(now);
}

/// Nothing is better than a leap: the vehicle goes on along its path, and is led again from where it is then.
void Agent::send(LocalTime now, const protocol::Setpoint& setpoint, Outputs& out) {
  const auto why = steps_.objection(now, setpoint);
  if (!why) {
    out.setpoint = setpoint;
    return;
  }
  if (!withheld_ || now - withheld_->at > options_.complained) out.notices.push_back({Notice::Level::kError, *why});
  withheld_ = Withheld{now, *why};
  steps_.forget();
  listen(now);
}

bool Agent::accepts_term(std::uint64_t term, Outputs& out) {
  if (term < term_) {
    ++dropped_.wrong_term;
    return false;
  }
  if (term > term_) {
    if (!terms_.believes(term_, term)) {
      ++dropped_.nonsense;
      return false;
    }
    if (term_ != 0) {
      out.notices.push_back(
          {Notice::Level::kInfo, text("a new coordinator took over: term %llu", protocol::generation(term))});
      // It learned swarm time from us and the others; it may be off by what we are apart.
      clock_.doubt(std::chrono::milliseconds(1));
    }
    term_ = term;
    confirmed_ = 0;  // what was confirmed was confirmed to the former one
    heard_.reset();
    offers_taken_ = 0;
    beacons_ = {};
  }
  return true;
}

void Agent::take_early_offer(LocalTime now, Outputs& out) {
  if (!early_offer_ || early_offer_->term > term_) return;
  const protocol::PlanOffer offer = std::move(*early_offer_);
  early_offer_.reset();
  if (offer.term == term_) on(now, offer, out);
}

void Agent::on(LocalTime now, const protocol::Beacon& beacon, Outputs& out) {
  if (!sane(beacon)) {
    ++dropped_.nonsense;
    return;
  }
  if (const auto time = swarm_time(now)) {
    const Duration age = *time - beacon.swarm_time;
    const Duration age_max = options_.beacon_age_max + std::min(clock_.uncertainty(now), kLongest);
    // None comes from the future: this clock stood still, or the coordinator's jumped, or somebody lies. Which it is,
    // exchanges will tell; until then the vehicle knows its path better than this agent does.
    if (age < -(options_.beacon_ahead_max + std::min(clock_.uncertainty(now), kLongest))) {
      doubted_at_ = now;
      ++dropped_.nonsense;
      return;
    }
    doubted_at_.reset();
    if (age > age_max) {
      // To a process that was stopped, old ones come first; to one whose clock leapt without it, only old ones.
      if (awake_since_) doubted_at_ = now;
      ++dropped_.late;
      return;
    }
  }
  if (!accepts_term(beacon.term, out)) return;
  take_early_offer(now, out);
  using Verdict = protocol::SequenceJudge::Verdict;
  if (const Verdict verdict = beacons_.take(beacon.sequence); verdict != Verdict::kNew) {
    ++(verdict == Verdict::kDuplicate ? dropped_.duplicate
       : verdict == Verdict::kLate    ? dropped_.late
                                      : dropped_.nonsense);
    return;
  }
  if (!revisions_.believes(heard_ ? heard_->course.revision : course_.revision, beacon.course.revision)) {
    ++dropped_.nonsense;
    return;
  }
  if (heard_ && beacon.sequence > heard_->sequence + 1) {
    beacons_missed_ += beacon.sequence - heard_->sequence - 1;
    awaited_until_ = std::max(awaited_until_, now + options_.lossy);
  }
  ++beacons_received_;
  coordinator_.heard(now);
  heard_ = beacon;
  adopt(now, out);
}

void Agent::on(LocalTime now, const protocol::PlanOffer& offer, Outputs& out) {
  if (!sane(offer) || offer.carrier != options_.carrier) {
    ++dropped_.nonsense;
    return;
  }
  if (!accepts_term(offer.term, out)) {
    if (offer.term > term_) early_offer_ = offer;
    return;
  }
  early_offer_.reset();
  if (offer.sequence < offers_taken_) {
    ++dropped_.late;
    return;
  }
  // None is said again, so one that leaps is taken; but it does not make deaf to those that follow.
  if (offer.sequence - offers_taken_ <= kFurthestOffer) offers_taken_ = offer.sequence;
  const bool keeps = offer.neighbour.size() != neighbour_.size() ||
                     !std::equal(neighbour_.begin(), neighbour_.end(), offer.neighbour.begin(),
                                 [](const auto& a, const auto& b) { return a.number == b.number; });
  neighbour_ = offer.neighbour;
  const bool forgot = plans_.take(offer.slices, protocol::plans_of(course_));
  out.question = plans_.question();
  if (forgot || keeps) tell_plans(now, out);
}

void Agent::on(LocalTime now, const PlanVerdict& verdict, Outputs& out) {
  const bool wanted = plans_.take(verdict);
  out.question = plans_.question();  // the next one, whatever became of this
  if (!wanted) return;
  if (!verdict.figures) out.notices.push_back({Notice::Level::kError, "plan refused: " + plans_.refusal()});
  if (heard_) adopt(now, out);
  tell_plans(now, out);
}

void Agent::tell_plans(LocalTime now, Outputs& out) {
  out.held = protocol::HeldPlans{options_.carrier, options_.incarnation, plans_.held(), neighbour_};
  out.status = status(now);  // the coordinator is waiting for this answer
}

void Agent::adopt(LocalTime now, Outputs& out) {
  const std::optional<SwarmTime> time = swarm_time(now);
  if (!time || !believed_ || doubts_clock(now)) return;  // the next beacon says it again
  const std::uint64_t confirmed_before = confirmed_;
  if (const auto& proposal = heard_->proposal; proposal && confirms(*proposal)) confirmed_ = proposal->revision;
  const bool confirmed = confirmed_ != confirmed_before;

  const bool newer = heard_->course.newer_than(course_) || course_.none();
  bool flown = false;
  if (newer || (heard_->course.lease != course_.lease && !course_.newer_than(heard_->course))) {
    protocol::Course wanted = heard_->course;
    protocol::settle(wanted, *time);
    // Without one of its plans there is no reference: a course is flown whole or not at all.
    flown = reference(wanted, *time) && merge_to(now, wanted);
    if (flown) course_ = std::move(wanted);
  }
  if ((flown && newer) || confirmed) awaited_until_ = now + options_.awaited;
  // The coordinator extends the lease only when all have said that they hold it.
  if (flown || confirmed) out.status = status(now);
}

/// Whether it can fly what is proposed.
bool Agent::confirms(const protocol::Course& proposal) const {
  if (proposal.term != term_ || proposal.revision == confirmed_ || !proposal.newer_than(course_)) return false;
  const auto plans = protocol::plans_of(proposal);
  if (plans_.find(plans.back()) == nullptr) return false;
  const protocol::Ramp& ramp = proposal.pace.ramps.back();
  return proposal.pace == course_.pace || plans_.flies(plans.back(), ramp);
}

Path Agent::path(const protocol::Course& course) const {
  const mechanics::CarrierSlice& slice = *plans_.find(course.base.number);
  Path path;
  path.at = [this, &course, k = slice.cable_stiffness_n_m](SwarmTime at) {
    return command_of(*reference(course, at), k);
  };
  // One plan's motion at one pace and nothing else, now and before.
  const double pace = course.pace.target();
  const bool plain = course.transitions.empty() && course.pace.ramps.size() == 1 &&
                     course.pace.ramps.front().duration == Duration::zero();
  if (plain && pace > 0.0 && mechanics::moves(slice))
    path.period = from_seconds(std::min(kTwoPi / slice.rate_rad_s / pace, kLongestPeriod_s));
  return path;
}

/// Whether to fly `course` from now on; it begins where the carrier is.
bool Agent::merge_to(LocalTime now, const protocol::Course& course) {
  const SwarmTime time = clock_.at(now);
  if (reference(course_, time)) {
    // The same plans, at the same moment of them: it goes on as it did, whatever is to come.
    const protocol::PlanMoment flown = course_.moment(time);
    const protocol::PlanMoment wanted = course.moment(time);
    const bool same = course.base == course_.base && course.transitions == course_.transitions &&
                      std::abs((flown.at - wanted.at).count()) <= kRounding.count() &&
                      std::abs(flown.pace - wanted.pace) <= kNoPace &&
                      std::abs(flown.rate_1_s - wanted.rate_1_s) <= kNoPace;
    // A delay that is being made up for belongs to the course it was measured on.
    const bool another = !same || (course.newer_than(course_) && merge_.under_way(time));
    if (another) merge_.begin(time, merge_.apply(time, path(course_)), path(course));
    return true;
  }
  if (awake_since_ && now - *awake_since_ < options_.backlog) return false;
  if (!wants_vehicle_since_) wants_vehicle_since_ = now;
  if (vehicle_ && now - vehicle_held_ <= options_.vehicle_timeout) {
    begin_at_the_vehicle(now, path(course));
  } else if (now - *wants_vehicle_since_ < options_.vehicle_wait) {
    return false;
  }
  return true;
}

void Agent::give_way() {
  course_ = {};
  confirmed_ = 0;
  merge_ = Merge(merge_limits(options_.vehicle));
  steps_.forget();
  wants_vehicle_since_.reset();
  flown_at_.reset();
  awake_since_.reset();
  seems_lost_ = false;
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
  believed_ = reply.believed == 0 || reply.believed == options_.incarnation;
  rival_ = reply.rival;
  if (!believed_) give_way();
  const std::optional<SwarmTime> time_before = swarm_time(now);
  const bool before = time_before.has_value();
  std::optional<Command> flown;
  if (before && reference(course_, *time_before)) flown = merge_.apply(*time_before, path(course_));
  using Verdict = protocol::Timekeeper::Verdict;
  const protocol::Exchange exchange{reply.request_sent, reply.request_received, reply.reply_sent, event.arrived};
  const std::optional<Duration> suspected = suspected_before(exchange);
  const Verdict verdict = clock_.observe(exchange, now, suspected);
  contradicted_ = verdict == Verdict::kContradiction;
  if (verdict == Verdict::kLeapt) {
    leapt(now, *time_before - clock_.at(now), flown, out);
  } else if (verdict == Verdict::kFoundAnew) {
    out.notices.push_back({Notice::Level::kWarning,
                           "a clock jumped, this one or the coordinator's: swarm time was found "
                           "anew"});
    vehicle_ages_ = {};  // by the clock that may have jumped
    if (flown && reference(course_, clock_.at(now))) merge_.begin(clock_.at(now), *flown, path(course_));
    // The carrier is where the last setpoint led it, and is led on where time is off by no more than one of them: as
    // after a coordinator has learned it from its agents. Or it has gone on by itself: where that is, it has to tell.
    const bool led = flown_at_ && now - *flown_at_ <= 5 * options_.control_period;
    const Duration off = clock_.at(now) - *time_before;
    if (!led || off > options_.control_period || off < -options_.control_period) {
      listen(now);
    }
  } else if (verdict != Verdict::kTaken) {
    ++dropped_.nonsense;
    return;
  } else if (before && watch_.suspicion() && suspected &&
             refutes(exchange, *time_before - (now - event.arrived), *suspected)) {
    watch_.refuted();
  }
  if (!before && clock_.synchronised()) {
    out.notices.push_back(
        {Notice::Level::kInfo, text("swarm time found, uncertain by %.3f ms", 1e3 * seconds(clock_.uncertainty(now)))});
    if (heard_) adopt(now, out);
    out.status = status(now);  // the coordinator is waiting for that, too
  }
}

std::optional<mechanics::Reference> Agent::reference(const protocol::Course& course, SwarmTime now) const {
  return protocol::reference(course, now, [this](const protocol::PlanNumber& number) { return plans_.find(number); });
}

protocol::Setpoint Agent::setpoint(SwarmTime now, const mechanics::Reference& r) {
  // Nearly always there is nothing to merge, and `r` is all of it.
  const mechanics::CarrierSlice& slice = *plans_.find(course_.base.number);
  const Command wanted =
      merge_.under_way(now) ? merge_.apply(now, path(course_)) : command_of(r, slice.cable_stiffness_n_m);
  // What is to be flown is asked for ahead of the machines' lags, at this last stage: all before it goes by where the
  // vehicle is to be, as all that the vehicle tells does.
  const Command command{mechanics::led(wanted.position_w_m, slice.vehicle_lag_s),
                        mechanics::led(wanted.winch_m, slice.winch_lag_s)};
  protocol::Setpoint s;
  s.carrier = options_.carrier;
  s.incarnation = options_.incarnation;
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

}  // namespace gyre::agent
