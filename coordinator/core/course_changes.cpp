// How the course becomes what is wished: each change on its way to being flown.

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/mechanics/skew.hpp"
#include "coordinator/core/leading.hpp"

namespace gyre::coordinator {

using protocol::Course;
using protocol::PlanNumber;
using protocol::Transition;
using protocol::Wish;
using protocol::Wisher;

/// The one place where the course changes without everybody's word.
void Leading::change(Course course) {
  course_ = std::move(course);
  course_.term = term_;
  course_.revision = ++last_revision_;
}

std::vector<PlanNumber> Leading::plans_in_use() const {
  std::vector<PlanNumber> numbers = protocol::plans_of(course_);  // first: these must never be left out
  numbers.push_back(plan_);
  if (start_) {
    for (const PlanNumber& number : protocol::plans_of(start_->before)) numbers.push_back(number);
  }
  if (before_retune_) numbers.push_back(before_retune_->plan);
  return numbers;
}

std::vector<CarrierId> Leading::unconfirmed(LocalTime now) const {
  const std::uint64_t revision = agreement_->proposal().revision;
  const SwarmTime soon = swarm_time(now) + options_.agreement.lead;
  const auto confirmed = [&](const protocol::AgentStatus& s) {
    // What begins after the end of a lease would be stopped at once.
    const bool leased = !course_.lease || (s.course.lease && *s.course.lease > soon);
    return s.term == term_ && s.confirmed == revision && leased;
  };
  // Who does not know the plan in force follows when the transition away from it is complete.
  return without(swarm_.fleet.missing(now, confirmed), without_plan(now));
}

// -------------------------------------------------------------------------------------------------------------- ramps

/// All that carriers may be doing while a ramp lasts: what is flown, what is about to be, and the mixture of them.
RampLimits Leading::ramp_limits() const {
  RampLimits out{job_.plan.limits, job_.plan.winch, {}};
  for (const mechanics::CarrierFigures& carrier : mixture_) out.include(carrier);
  std::vector<PlanNumber> plans = protocol::plans_of(course_);
  if (plan_ != plans.back()) plans.push_back(plan_);
  for (const PlanNumber& plan : plans) {
    for (const mechanics::CarrierFigures& carrier : plans_.figures(plan)) out.include(carrier);
  }
  return out;
}

Result<Intent> Leading::ramp_to(LocalTime now, const Wish& wish, bool at_once) const {
  Intent intent;
  intent.wish = wish;
  const RampWish asked{swarm_time(now) + options_.agreement.lead, wish.pace,
                       at_once ? options_.freezing : job_.transition.value_or(options_.shortest_transition),
                       job_.transition && !at_once};
  const Result<Duration> duration = ramp_duration(course_.pace, asked, ramp_limits(), options_.longest_ramp);
  if (!duration) return duration.error();
  intent.duration = duration.value();
  return intent;
}

Intent Leading::transition_to(const PlanNumber& plan, const Wish& wish) const {
  Intent intent;
  intent.wish = wish;
  intent.plan = plan;
  intent.duration = job_.transition.value_or(options_.shortest_transition);
  intent.may_slow_down = !job_.transition;
  return intent;
}

/// At the end of the lease the others have stopped as everybody had agreed: that is the course now, and it stays so
/// until somebody wishes otherwise.
void Leading::end_lease(SwarmTime now, Outputs& out) {
  if (!course_.lease || now <= *course_.lease) return;
  // Whoever did not begin what went go has stopped, and nothing is turned back any more: that would move him.
  if (is_unbegun(now)) {
    forget_start();
  } else if (start_) {
    before_retune_.reset();
  }
  start_.reset();
  const protocol::Pace stopped = course_.flown_pace(now);
  const bool moved = stopped.target() != course_.pace.target() || stopped.at(now).at != course_.pace.at(now).at;
  // Also of a start that was turned back: whoever began it unheard has stopped, and must not begin again by itself.
  if (!moved && course_.wish.pace == 0.0) return;
  Course course = course_;
  course.pace = stopped;
  if (course.wish.pace != 0.0) course.wish = Wish{0.0, false, Wisher::kSilence};
  change(std::move(course));
  news_.tell(out, Notice::Level::kError, "the lease ended without a word of everybody: all stop together");
  if (agreement_) give_up(LocalTime(now.time_since_epoch() - swarm_offset_), "the lease has ended", out);
}

/// The equilibrium that includes a stuck carrier is everybody's phase stopped where it got stuck (docs/design.md, fact
/// 5). Nobody is asked: every tenth of a second costs.
void Leading::stop_with(LocalTime now, const PathJudge::Stuck& stuck, Outputs& out) {
  constexpr double kAlmostRest = 0.05;
  constexpr Duration kHeardBy = std::chrono::milliseconds(20);
  const SwarmTime time = swarm_time(now);
  if (std::abs(course_.moment(time).pace) < kAlmostRest && course_.pace.target() == 0.0) return;
  const PlanTime where = course_.moment(time - stuck.lag).at;
  const SwarmTime start = time + kHeardBy;
  // To stop is always found.
  const Duration duration =
      ramp_duration(course_.pace, {start, 0.0, options_.seizing, false}, ramp_limits(), options_.longest_ramp).value();
  Course course = course_;
  course.pace = stopped_at(where, course_.pace, start, duration);
  course.wish = Wish{0.0, false, Wisher::kEvidence};
  change(std::move(course));
  if (start_) before_retune_.reset();
  start_.reset();
  if (agreement_) give_up(now, "a carrier got stuck", out);
  news_.tell(out, Notice::Level::kError, text("carrier %u has left its path: all stop at its phase", stuck.carrier));
}

// --------------------------------------------------------------------------------------------------------------
// driving

void Leading::drive(LocalTime now, Outputs& out) {
  const SwarmTime time = swarm_time(now);
  if (shutting_down_) {
    if (course_.rests(time)) {
      out.finished = Outcome{true, "at rest; the flight has ended"};
      return;
    }
    if (failures_ >= options_.release_attempts) {
      out.finished = Outcome{false, "the swarm could not be stopped: " + news_.latest + "; it flies on"};
      return;
    }
  }
  if (now < retry_at_) return;
  const std::vector<CarrierId> lost = without_plan(now);
  const bool stays = protocol::plans_of(course_).back() == plan_ || course_.wish.pace == 0.0 ||
                     course_.transitions.size() == protocol::kMaxTransitions;
  if (!lost.empty() && now - since_ > options_.hopeless && !stays) {
    // All there is to offer is another plan. At rest that waits for a person.
    news_.tell(out, Notice::Level::kError,
               "nobody knows the plan in force for " + listed("carrier", lost) + ": going over to the mission's");
    Intent intent = transition_to(plan_, Wish{1.0, true, Wisher::kSilence});
    intent.rehearsed = false;
    return begin(now, intent);
  }
  const std::optional<Wish> wish = pending_wish(now);
  if (!wish) return;
  if (wish->pace == course_.pace.target()) {
    if (*wish == course_.wish) return;
    Course course = course_;
    course.wish = *wish;
    return change(std::move(course));
  }
  const bool departs = course_.rests(time);
  const auto refuse = [&](const std::string& why) {
    news_.tell_once(out, Notice::Level::kWarning,
                    (wish->pace == 0.0 ? "the swarm does not stop: "
                     : departs         ? "the motion does not begin: "
                                       : "the pace does not change: ") +
                        why);
    retry_at_ = now + options_.agreement.lead;
    // With somebody silent, all stop at the end of the lease: that is waited for.
    if (shutting_down_ && !(course_.lease && !swarm_.out_of_touch(now).empty())) ++failures_;
  };
  if (const auto why = obstacle(now, departs)) return refuse(*why);
  const Result<Intent> intent = ramp_to(now, *wish, false);
  if (!intent) return refuse(intent.error().text);
  begin(now, intent.value());
}

// -------------------------------------------------------------------------------------------------------- agreements

void Leading::begin(LocalTime now, const Intent& intent) {
  agreement_.emplace(intent, options_.agreement);
  schedule(now);
}

void Leading::schedule(LocalTime now) {
  agreement_->schedule(swarm_time(now), swarm_.carriers.size());
  const Intent& intent = agreement_->intent();
  SwarmTime start = agreement_->start();
  Course next = course_;
  next.term = term_;
  next.revision = ++last_revision_;
  next.wish = intent.wish;
  if (intent.plan) {
    const PlanTime from = course_.moment(start).at;
    next.transitions.push_back({{*intent.plan, from}, from, agreement_->duration()});
    next.stopping = stopping_time();
  } else {
    if (const auto* slice = plans_.slice(course_.base.number, swarm_.carriers.front()); intent.phase_rad && slice) {
      // Where it would stop if it began at `start`; and so much later as the phase asked for is ahead of that.
      const protocol::Pace stopping = course_.pace.with_ramp(start, agreement_->duration(), intent.wish.pace);
      const double stops_s = seconds(stopping.at(stopping.ramps.back().end()).at - course_.base.epoch);
      const double ahead_rad = std::fmod(*intent.phase_rad - slice->rate_rad_s * stops_s, kTwoPi);
      const double pace = course_.moment(start).pace;
      if (pace > 0.0)
        start += from_seconds((ahead_rad < 0.0 ? ahead_rad + kTwoPi : ahead_rad) / (slice->rate_rad_s * pace));
    }
    next.pace = course_.pace.with_ramp(start, agreement_->duration(), intent.wish.pace);
  }
  agreement_->set_proposal(std::move(next), start);
}

/// The layers of every carrier whose plans are known, in seconds since a moment of plan time.
std::vector<std::vector<mechanics::TimedLayer>> Leading::stacks_of(const Course& course, PlanTime origin) const {
  std::vector<std::vector<mechanics::TimedLayer>> stacks;
  for (const CarrierId id : swarm_.carriers) {
    const auto slice = [&](const PlanNumber& number) { return plans_.slice(number, id); };
    auto stack = protocol::layers(course, origin, slice);
    if (!stack.empty()) stacks.push_back(std::move(stack));
  }
  return stacks;
}

/// Of the carriers whose plans are known; its transitions included.
Duration Leading::skew_budget(const Course& course) const {
  constexpr double kForever_s = 1e6;
  const double budget_s =
      mechanics::skew_budget_s(stacks_of(course, course.base.epoch), job_.plan.load.mass_kg * job_.plan.gravity_m_s2);
  return budget_s < kForever_s ? from_seconds(budget_s) : Duration::zero();
}

void Leading::pursue(LocalTime now, Outputs& out) {
  if (agreement_->needs_rehearsal()) {
    const Course& proposal = agreement_->proposal();
    std::vector<std::vector<mechanics::TimedLayer>> stacks = stacks_of(proposal, proposal.transitions.back().start);
    if (stacks.empty()) return give_up(now, "no agent has told yet what it flies", out);
    agreement_->rehearse(Rehearsal(std::move(stacks), job_.plan));
  }
  if (agreement_->proposal().pace.ramps.size() > protocol::kMaxRamps) {
    return give_up(now, "too many changes of pace are under way; wait until they are complete", out);
  }
  const bool proposed = agreement_->proposed();
  switch (agreement_->step(swarm_time(now), proposed ? unconfirmed(now) : std::vector<CarrierId>{})) {
    case Agreement::Step::kWait:
      if (!proposed && agreement_->proposed()) offer_plans(out);
      break;
    case Agreement::Step::kAgain:
      schedule(now);
      break;
    case Agreement::Step::kGo:
      // A mixture asks more of the clocks than either plan. Where nobody knows the plan in force, it goes all the same.
      if (agreement_->intent().plan && agreement_->intent().rehearsed) {
        const auto why = beyond_budget(swarm_.skew(now), skew_budget(agreement_->proposal()));
        if (why) return give_up(now, *why, out);
      }
      go(now, out);
      break;
    case Agreement::Step::kGiveUp:
      give_up(now, agreement_->why(), out);
      break;
  }
}

void Leading::go(LocalTime now, Outputs& out) {
  const Intent& intent = agreement_->intent();
  start_ = Start{agreement_->start(), agreement_->proposal().revision, course_, std::nullopt};
  const std::optional<SwarmTime> lease = course_.lease;
  course_ = agreement_->proposal();
  course_.lease = lease;
  (void)protocol::settle(course_, swarm_time(now));  // it was drawn up a moment ago
  if (intent.plan) {
    mixture_ = agreement_->figures();
    course_.stopping = stopping_time();  // of whatever stops in the middle of it
  }
  const double length_s = seconds(agreement_->duration());
  const std::string told =
      intent.plan ? text("transition to the %s plan is go and takes %.3g s", plans_.name(*intent.plan), length_s)
      : intent.wish.pace == 0.0
          ? text("the swarm comes to rest, within %.3g s", length_s)
          : text("the swarm goes to %.0f %% of its pace, within %.3g s", 100.0 * intent.wish.pace, length_s);
  news_.tell(out, Notice::Level::kInfo, told);
  if (intent.command) desk_.promise(*intent.command, {course_.wish, told, now + options_.safe_within});
  failures_ = 0;
  agreement_.reset();
  plans_.keep(plans_in_use());
}

void Leading::undo_retune() {
  if (!before_retune_) return;
  job_ = before_retune_->job;
  plan_ = before_retune_->plan;
  before_retune_.reset();
}

void Leading::give_up(LocalTime now, const std::string& why, Outputs& out) {
  const Intent intent = agreement_->intent();
  const auto refusal = intent.plan ? swarm_.refusal_of(*intent.plan) : std::nullopt;
  const std::string what =
      intent.plan ? text("transition to the %s plan", plans_.name(*intent.plan)) : std::string("change of pace");
  const std::string told = what + " given up: " + refusal.value_or(why);
  news_.tell(out, Notice::Level::kWarning, told);
  if (intent.command) desk_.answer(*intent.command, false, told, out.replies);
  if (shutting_down_) ++failures_;
  if (intent.plan) undo_retune();
  retry_at_ = now + options_.agreement.lead;
  agreement_.reset();
  plans_.keep(plans_in_use());
  offer_plans(out);
}

/// It does so, silent or not, and its vehicle does when it dies.
bool Leading::follows(CarrierId carrier, std::uint64_t revision) const {
  const protocol::AgentStatus* s = swarm_.fleet.status(carrier);
  return s != nullptr && s->course.term == term_ && s->course.revision >= revision;
}

std::vector<CarrierId> Leading::not_following(LocalTime now, std::uint64_t revision) const {
  std::vector<CarrierId> out;
  for (const CarrierId id : swarm_.carriers) {
    if (!follows(id, revision)) out.push_back(id);
  }
  return without(out, without_plan(now));
}

/// Whoever hears of a change long after it began leaps to where it has led; all of them would. So when nobody is known
/// to have begun it, it is not said any more: those who have take no older course, and say so when they are heard
/// again.
bool Leading::is_unbegun(SwarmTime now) const {
  if (!start_ || course_.revision != start_->revision || now < start_->at + options_.start_check) return false;
  return std::none_of(swarm_.carriers.begin(), swarm_.carriers.end(),
                      [this](CarrierId id) { return follows(id, start_->revision); });
}

/// What nobody has begun is as if it had never been; only the wish stays, and is pursued anew.
void Leading::forget_start() {
  Course course = start_->before;
  course.wish = course_.wish;
  course.lease = course_.lease;
  if (!(protocol::plans_of(course).back() == protocol::plans_of(course_).back())) undo_retune();
  start_.reset();
  change(std::move(course));
}

void Leading::check_start(LocalTime now, Outputs& out) {
  if (!start_) return;
  const SwarmTime time = swarm_time(now);
  const bool overtaken = course_.revision != start_->revision;
  if (!overtaken) {
    if (time < start_->at + options_.start_check) return;
    // Who hears nobody does not know who follows, and would not be heard; and then everybody has to have his say.
    if (swarm_.silent(now).size() == swarm_.carriers.size()) start_->deaf_at = now;
    if (start_->deaf_at && now - *start_->deaf_at <= options_.agent_timeout) return;
  }
  const std::vector<CarrierId> missing = not_following(now, start_->revision);
  if (overtaken || missing.empty() || (shutting_down_ && !is_unbegun(time))) {
    start_.reset();
    return before_retune_.reset();
  }
  const std::string told = listed("carrier", missing) + (missing.size() == 1 ? " does" : " do") +
                           " not follow the change that began: turning back";
  news_.tell(out, Notice::Level::kWarning, told);
  desk_.break_promises(told, out.replies);
  if (agreement_) give_up(now, "the change before it is turned back", out);
  retry_at_ = now + options_.stopping;
  if (is_unbegun(time)) {
    forget_start();
  } else {
    turn_back(time);
  }
  plans_.keep(plans_in_use());
}

void Leading::turn_back(SwarmTime now) {
  const Start start = *start_;
  start_.reset();
  const SwarmTime back_at = now + options_.agreement.go_margin;
  Course course = course_;
  if (course.transitions.size() > start.before.transitions.size()) {
    const PlanNumber abandoned = course.transitions.back().to.number;
    const PlanTime from = course.moment(back_at).at;
    const protocol::TimedPlan below =
        start.before.transitions.empty() ? start.before.base : start.before.transitions.back().to;
    course.transitions.push_back({below, from, options_.stopping});
    if (abandoned == plan_) undo_retune();
  } else {
    course.pace = course.pace.with_ramp(back_at, options_.stopping, start.before.pace.target());
  }
  change(std::move(course));
}

}  // namespace gyre::coordinator
