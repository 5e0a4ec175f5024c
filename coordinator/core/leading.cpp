// What is wished, whether it can be, and what is told of it. How the course follows is in course_changes.cpp.

#include "coordinator/core/leading.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"
#include "common/protocol/follow.hpp"
#include "common/protocol/term.hpp"
#include "coordinator/core/load_obstacle.hpp"

namespace gyre::coordinator {

using protocol::CommandKind;
using protocol::generation;
using protocol::PlanNumber;
using protocol::Wish;
using protocol::Wisher;

namespace {

/// Of its place, at rest: nobody departs from so far away.
constexpr double kAway_m = 0.1;

}  // namespace

Leading::Leading(LocalTime now, const Job& job, const CoordinatorOptions& options, Swarm& swarm, News& news,
                 const Beginning& beginning, Outputs& out)
    : job_(job),
      options_(options),
      swarm_(swarm),
      news_(news),
      term_(beginning.term),
      swarm_offset_(beginning.swarm_offset),
      since_(now),
      last_revision_(beginning.course ? beginning.course->revision : 0),
      lease_(beginning.course ? beginning.course->lease : std::nullopt) {
  for (const auto& [number, slices] : beginning.plans) plans_.learn(number, slices);
  const Slices slices = by_carrier(mechanics::slices(job_.plan));
  const auto known = plans_.recognise(slices, "motion");
  plan_ = known ? *known : plans_.add(term_, slices, "motion");
  protocol::Course course;
  if (beginning.course) {
    course = *beginning.course;
  } else {
    course.base = {plan_, PlanTime{}};
    course.pace.ramps.front().start = swarm_time(now);
  }
  course_ = course;
  course.stopping = stopping_time();
  change(std::move(course));
  news_.tell(out, Notice::Level::kInfo,
             text(beginning.course ? "term %llu: took over a swarm that flies, by the %s plan"
                                   : "term %llu: the load is held by the %s plan, at rest",
                  generation(term_), plans_.name(course_.base.number)));
  offer_plans(out);
}

void Leading::tick(LocalTime now, Outputs& out) {
  const SwarmTime time = swarm_time(now);
  const bool settled = protocol::settle(course_, time);
  if (settled) {
    if (course_.transitions.empty()) mixture_.clear();
    news_.tell(out, Notice::Level::kInfo, text("the load is held by the %s plan", plans_.name(course_.base.number)));
  }
  desk_.keep_promises(now, course_.wish, news_.latest, why_unsafe(now), out.replies);
  // Of n slices: not for every beacon.
  if (settled || now >= next_status_) budget_in_force_ = skew_budget(course_);
  if (consensus_.doubtful(swarm_.carriers)) {
    out.beacon = protocol::Beacon{term_, ++sequence_, time, course_, std::nullopt, budget_in_force_};
    return;
  }
  end_lease(time, out);
  // Who does not know the plan in force flies nothing that could stop, and has nothing to confirm.
  course_.lease =
      lease_.step(now, time, mission_in_force().silence, without(swarm_.carriers, without_plan(now)), swarm_.fleet);
  check_start(now, out);
  if (is_unbegun(time)) {
    // Nothing goes while that is open: it would begin from what nobody flies.
  } else if (agreement_) {
    pursue(now, out);
  } else {
    drive(now, out);
  }
  out.beacon = protocol::Beacon{term_, ++sequence_, time, course_, std::nullopt, budget_in_force_};
  if (is_unbegun(time)) {
    out.beacon->course = start_->before;
    out.beacon->course.lease = course_.lease;
  }
  if (agreement_ && agreement_->proposed()) out.beacon->proposal = agreement_->proposal();
  if (now >= next_status_) {
    next_status_ = now + options_.status_period;
    out.status = status(now);
    if (mission_told_ != out.status->plan) {
      const std::string& text = mission_in_force().mission_text;
      out.mission = {term_, out.status->plan, text.size() <= protocol::kMaxMissionBytes ? text : ""};
      mission_told_ = out.status->plan;
    }
  }
}

void Leading::heard(LocalTime arrived, const protocol::AgentStatus& status, Outputs& out) {
  consensus_.take(swarm_time(arrived), status);
  const auto correction = consensus_.correction(swarm_.carriers);
  if (!correction) return;
  swarm_offset_ += *correction;
  // Nobody has heard of what was granted by the wrong time: what they hold is the lease.
  course_.lease.reset();
  for (const CarrierId id : swarm_.carriers) {
    const protocol::AgentStatus* s = swarm_.fleet.status(id);
    if (s != nullptr && s->course.lease)
      course_.lease = std::max(course_.lease.value_or(*s->course.lease), *s->course.lease);
  }
  lease_ = LeaseBook(course_.lease);
  news_.tell(out, Notice::Level::kWarning,
             text("this clock jumped by %.3f s against all agents': swarm time is theirs", -seconds(*correction)));
}

void Leading::seen(LocalTime now, const protocol::CarrierState& state, Outputs& out) {
  if (consensus_.doubtful(swarm_.carriers)) return;
  const auto slice = [&](const PlanNumber& number) { return plans_.slice(number, state.carrier); };
  auto planned = protocol::reference(course_, swarm_time(now), slice);
  if (!planned || !planned->position_w_m.first.allFinite()) return;
  // The vehicle of a silent agent goes on along the course that this one followed, if that is another one.
  const protocol::AgentStatus* agent = swarm_.fleet.status(state.carrier);
  if (agent != nullptr && swarm_.fleet.silent(now, state.carrier)) {
    const auto off_m = [&](const mechanics::Reference& r) {
      return (r.position_w_m.value - state.position_w_m).norm();
    };
    const auto followed = protocol::reference(agent->course, swarm_time(now), slice);
    if (followed && followed->position_w_m.first.allFinite() && off_m(*followed) < off_m(*planned)) planned = followed;
  }
  paths_.take(now, state, planned->position_w_m);
  if (const auto stuck = paths_.stuck(now, swarm_.carriers.size())) stop_with(now, *stuck, out);
}

void Leading::learn(const protocol::HeldPlans& held, Outputs& out) {
  // Somebody who was out of reach when this coordinator recovered may still bring what nobody else knows.
  bool learned = false;
  const auto flown = protocol::plans_of(course_);
  for (const auto* slices : {&held.slices, &held.neighbour}) {
    for (const protocol::NumberedSlice& numbered : *slices) {
      const bool wanted = std::find(flown.begin(), flown.end(), numbered.number) != flown.end();
      learned = plans_.complete(numbered, wanted) || learned;
    }
  }
  if (learned) offer_plans(out);
}

void Leading::stand_down(const std::string& why, Outputs& out) {
  if (agreement_ && agreement_->intent().command) desk_.answer(*agreement_->intent().command, false, why, out.replies);
  agreement_.reset();
  desk_.break_promises(why, out.replies);
}

void Leading::shut_down(Outputs& out) {
  if (!shutting_down_) news_.tell(out, Notice::Level::kInfo, "ending the flight: to rest");
  shutting_down_ = true;
  desk_.break_promises("the flight is ending", out.replies);
}

// ---------------------------------------------------------------------------------------------------------- commands

std::optional<std::string> Leading::command_obstacle(LocalTime now, const protocol::Command& command) const {
  const SwarmTime time = swarm_time(now);
  const double target = course_.pace.target();
  // What may be forgotten is not "already" so: whoever asks again gets another answer.
  const bool safe = !why_unsafe(now);
  const bool resting = safe && course_.wish.pace == 0.0 && course_.wish.by != Wisher::kNobody;
  if (shutting_down_) return "the flight is ending";
  if (agreement_ && command.kind != CommandKind::kFreeze) return "a change is being agreed; try again in a second";
  switch (command.kind) {
    case CommandKind::kEngage:
      if (safe && course_.wish.pace == 1.0 && !course_.wish.rest_when_changed && target == 1.0)
        return "already in full motion, or on the way there";
      break;
    case CommandKind::kRelease:
      if (command.phase_rad && !std::isfinite(*command.phase_rad)) return "a phase is an angle";
      if (resting && target == 0.0) return "already at rest, or on the way there";
      break;
    case CommandKind::kFreeze:
      if (resting && course_.rests(time)) return "nothing moves";
      break;
    case CommandKind::kPace:
      if (!(command.pace >= 0.0 && command.pace <= 1.0)) return "a pace is from 0, at rest, to 1, full motion";
      if (auto why = too_slow(command.pace, job_.plan.limits, plans_.figures(protocol::plans_of(course_).back()))) {
        return why;
      }
      // A plan learned from the agents came without its certificate.
      if (protocol::plans_of(course_).back() == plan_) {
        if (auto why = swing_grows(command.pace, job_.swings)) return why;
      }
      if (safe && course_.wish.pace == command.pace && !course_.wish.rest_when_changed && target == command.pace) {
        return "already at that pace";
      }
      break;
    case CommandKind::kRetune:
      return "a retune needs its mission read first";
  }
  return std::nullopt;
}

void Leading::command(LocalTime now, const protocol::Command& command, Outputs& out) {
  if (desk_.heard_before(command.id, out.replies)) return;
  const auto answer = [&](bool done, const std::string& why) { desk_.answer(command.id, done, why, out.replies); };
  if (const auto why = command_obstacle(now, command)) return answer(false, *why);

  Wish wish{0.0, false, Wisher::kPerson};
  if (command.kind == CommandKind::kEngage) wish.pace = 1.0;
  if (command.kind == CommandKind::kPace) wish.pace = command.pace;
  const SwarmTime time = swarm_time(now);
  const bool rests = course_.rests(time);
  const bool at_once = command.kind == CommandKind::kFreeze;
  const auto only_wish = [&](const std::string& told) {
    if (agreement_) give_up(now, "overtaken by another command", out);
    if (!(course_.wish == wish)) {
      protocol::Course course = course_;
      course.wish = wish;
      change(std::move(course));
    }
    desk_.promise(command.id, {wish, told, now + options_.safe_within});
  };
  if (wish.pace == 0.0 && rests) return only_wish("at rest, and stays so until somebody engages");
  if (const auto gone = swarm_.why_out_of_touch(now); wish.pace == 0.0 && gone && course_.lease) {
    // Who cannot be told to stop will stop by itself, and when is known: the others stop with it.
    return only_wish(*gone +
                     text(": all stop together, %.1f s from now", std::max(0.0, seconds(*course_.lease - time))));
  }
  if (wish.pace == course_.pace.target() && !at_once) return only_wish("on the way there already");
  if (wish.pace > 0.0 && !without_plan(now).empty() && protocol::plans_of(course_).back() != plan_ &&
      course_.transitions.size() < protocol::kMaxTransitions) {
    if (const auto why = plan_obstacle(now, plan_)) return answer(false, *why);
    Intent over = transition_to(plan_, wish);
    over.rehearsed = false;
    over.command = command.id;
    return begin(now, over);
  }
  if (const auto why = obstacle(now, rests)) return answer(false, *why);
  Result<Intent> intent = ramp_to(now, wish, at_once);
  if (!intent) return answer(false, intent.error().text);
  Intent asked = intent.value();
  asked.command = command.id;
  if (command.kind == CommandKind::kRelease) asked.phase_rad = command.phase_rad;
  if (agreement_) give_up(now, "overtaken by another command", out);
  begin(now, asked);
}

void Leading::retune(LocalTime now, const Retune& retune, Outputs& out) {
  if (desk_.heard_before(retune.command, out.replies)) return;
  const auto refuse = [&](const std::string& why) {
    desk_.answer(retune.command, false, "cannot retune: " + why, out.replies);
  };
  if (shutting_down_) return refuse("the flight is ending");
  if (agreement_ || start_) return refuse("a change is being agreed; try again in a second");
  if (!retune.job) return refuse(retune.job.error().text);
  // What is rehearsed is the change at a constant pace, at most the full one.
  if (!course_.pace.constant(swarm_time(now))) return refuse("the pace is changing; try again when it is constant");
  if (course_.transitions.size() + 2 > protocol::kMaxTransitions) {  // this one, and one to turn it back by
    return refuse("too many transitions are under way; wait until they are complete");
  }
  if (const auto why = load_obstacle(job_.plan, retune.job.value().plan)) return refuse(*why);
  if (const auto why = swing_grows(course_.pace.target(), retune.job.value().swings)) return refuse(*why);
  before_retune_ = Mission{job_, plan_};
  job_ = retune.job.value();
  plan_ = plans_.add(term_, by_carrier(mechanics::slices(job_.plan)), "motion");
  if (const auto why = plan_obstacle(now, plan_)) {
    undo_retune();
    return refuse(*why);
  }
  offer_plans(out);
  // A swarm at rest moves through the change, and rests again. The agents see the plan and the proposal in the same
  // moment; the lead is theirs to accept and confirm.
  const bool rests = course_.rests(swarm_time(now));
  Intent intent = transition_to(plan_, rests ? Wish{1.0, true, Wisher::kPerson} : course_.wish);
  intent.command = retune.command;
  begin(now, intent);
}

// --------------------------------------------------------------------------------------------------------- obstacles

/// Whom this coordinator hears of and cannot tell what is flown: it died with a coordinator and an agent.
std::vector<CarrierId> Leading::without_plan(LocalTime now) const {
  const auto plans = protocol::plans_of(course_);
  std::vector<CarrierId> out;
  for (const CarrierId id : swarm_.carriers) {
    const auto unknown = [&](const PlanNumber& plan) { return plans_.slice(plan, id) == nullptr; };
    if (!swarm_.fleet.silent(now, id) && std::any_of(plans.begin(), plans.end(), unknown)) out.push_back(id);
  }
  return out;
}

/// Why the next coordinator may know nothing of the course, if this one dies now: somebody whom it may hear does not
/// follow it yet. Who is out of touch will not, for now, and is named in the answers; but what is not seen to have
/// begun may be turned back.
std::optional<std::string> Leading::why_unsafe(LocalTime now) const {
  const std::vector<CarrierId> missing = not_following(now, course_.revision);
  if (missing.empty()) return std::nullopt;
  const bool nobody = missing.size() == swarm_.carriers.size();
  const std::vector<CarrierId> late = start_ ? missing : without(missing, swarm_.out_of_touch(now));
  if (late.empty() && !nobody) return std::nullopt;
  return (nobody ? "no agent has" : listed("carrier", late) + (late.size() == 1 ? " has" : " have")) +
         " said that it is known there, and it may be forgotten with this coordinator";
}

std::optional<std::string> Leading::obstacle(LocalTime now, bool departs) const {
  if (swarm_.silent(now).size() == swarm_.carriers.size()) {
    return "no agent is heard: check the network between them and here";
  }
  if (const auto gone = swarm_.why_out_of_touch(now)) {
    return *gone + ", and whoever does not hear of a change flies on as before";
  }
  const PlanNumber plan = protocol::plans_of(course_).back();
  if (auto refusal = swarm_.refusal_of(plan)) return refusal;
  // In motion it is too late to be choosy: whatever a person asks for then is better than what is.
  if (!departs) return std::nullopt;
  if (auto twice = swarm_.why_claimed_twice(now)) return twice;
  if (auto complaint = swarm_.readiness.complaint(now)) return complaint;
  for (const CarrierId id : swarm_.carriers) {
    if (const auto off_m = paths_.off_m(now, id); off_m && *off_m > kAway_m) {
      return text("carrier %u is %.2f m from its place", id, *off_m);
    }
  }
  if (const auto missing = swarm_.not_accepted(now, plan); !missing.empty()) {
    return listed("carrier", missing) + (missing.size() == 1 ? " has" : " have") + " not accepted the plan yet";
  }
  return plan_obstacle(now, plan);
}

std::optional<std::string> Leading::plan_obstacle(LocalTime now, const PlanNumber& plan) const {
  if (auto refusal = swarm_.refusal_of(plan)) return refusal;
  if (const auto gone = swarm_.why_out_of_touch(now)) return *gone + ", and cannot say whether it can be flown";
  protocol::Course alone;
  alone.base.number = plan;
  return beyond_budget(swarm_.skew(now), skew_budget(alone));
}

// ------------------------------------------------------------------------------------------------------------ wishes

/// What is to be flown now; absent: what is.
std::optional<Wish> Leading::pending_wish(LocalTime now) {
  const Wish& wish = course_.wish;
  if (shutting_down_) return Wish{0.0, false, Wisher::kPerson};
  if (options_.engage_when_ready && wish.by == Wisher::kNobody) {
    if (!departure_is_due(now)) return std::nullopt;
    return Wish{1.0, false, Wisher::kStart};
  }
  if (wish.rest_when_changed && course_.transitions.empty()) return Wish{0.0, false, wish.by};
  return wish;
}

/// Everybody is ready, or one of them refuses, which is to be told. A complaint is waited for a while: discovery may
/// be late for one more.
bool Leading::departure_is_due(LocalTime now) {
  const auto ready = [this](const protocol::AgentStatus& s) {
    return std::find(s.accepted.begin(), s.accepted.end(), course_.base.number) != s.accepted.end() &&
           s.state == protocol::AgentState::kReady;
  };
  if (swarm_.refusal_of(course_.base.number)) return true;
  if (!swarm_.fleet.missing(now, ready).empty()) return false;
  if (!swarm_.readiness.complaint(now)) {
    not_ready_since_.reset();
  } else if (!not_ready_since_) {
    not_ready_since_ = now;
  }
  return !not_ready_since_ || now - *not_ready_since_ >= options_.patience;
}

// ------------------------------------------------------------------------------------------------------------ telling

void Leading::offer_plans(Outputs& out) {
  const auto numbers = plans_in_use();
  const auto& carriers = swarm_.carriers;
  ++offers_;
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    protocol::PlanOffer offer{carriers[i], term_, offers_, plans_.told(carriers[i], numbers), {}};
    if (carriers.size() > 1) offer.neighbour = plans_.told(carriers[(i + 1) % carriers.size()], numbers);
    out.offers.push_back(std::move(offer));
  }
}

std::optional<std::string> Leading::complaint(LocalTime now) const {
  const std::vector<CarrierId> silent = swarm_.silent(now);
  if (silent.size() == swarm_.carriers.size()) return "no agent is heard";
  if (auto twice = swarm_.why_claimed_twice(now)) return twice;
  auto gone = swarm_.why_out_of_touch(now);
  if (!silent.empty()) {
    // Silence is not loss: who is seen on his path is there.
    const bool seen = std::all_of(silent.begin(), silent.end(), [&](CarrierId id) { return paths_.on_path(now, id); });
    return *gone + (seen ? ", and seen on its path" : "");
  }
  if (const auto lost = without_plan(now); !lost.empty()) {
    return "nobody knows the plan in force for " + listed("carrier", lost) +
           ": engage, and all go over to the mission's";
  }
  if (gone) return gone;
  return beyond_budget(swarm_.skew(now), budget_in_force_);
}

protocol::CoordinatorStatus Leading::status(LocalTime now) const {
  protocol::CoordinatorStatus s;
  s.term = term_;
  s.swarm_time = swarm_time(now);
  // Until a retune is agreed, and all were seen to follow, the mission in force is the one before it.
  s.mission = mission_in_force().name.substr(0, protocol::kMaxTextBytes);
  s.plan = before_retune_ ? before_retune_->plan : plan_;
  s.skew_budget = budget_in_force_;
  s.skew = swarm_.skew(now);
  s.carriers = swarm_.carriers;
  s.silent = swarm_.silent(now);
  s.news = news_.latest.substr(0, protocol::kMaxTextBytes);
  return s;
}

}  // namespace gyre::coordinator
