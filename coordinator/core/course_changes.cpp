// How the course changes: what the coordinator wants next, and each transition on its way to being flown.

#include <algorithm>

#include "common/base/text.hpp"
#include "common/mechanics/frozen_slice.hpp"
#include "common/mechanics/skew.hpp"
#include "common/protocol/course.hpp"
#include "coordinator/core/coordinator.hpp"

namespace gyre::coordinator {

using protocol::AgentLoss;
using protocol::PlanNumber;
using protocol::Stage;
using protocol::Transition;

namespace {

std::vector<CarrierId> without(std::vector<CarrierId> carriers, const std::vector<CarrierId>& these) {
  const auto among = [&these](CarrierId c) { return std::find(these.begin(), these.end(), c) != these.end(); };
  carriers.erase(std::remove_if(carriers.begin(), carriers.end(), among), carriers.end());
  return carriers;
}

}  // namespace

PlanNumber Coordinator::destination() const {
  return course_.transitions.empty() ? course_.base.number : course_.transitions.back().to.number;
}

bool Coordinator::moves(const PlanNumber& plan) const {
  const auto slices = plans_.slices(plan);
  return std::any_of(slices.begin(), slices.end(), [](const auto& slice) { return mechanics::moves(slice); });
}

bool Coordinator::moving() const {
  const auto numbers = protocol::plans_of(course_);
  return std::any_of(numbers.begin(), numbers.end(), [this](const PlanNumber& plan) { return moves(plan); });
}

/// Room for one more and for turning it back.
bool Coordinator::room_for_transition() const {
  return course_.transitions.size() + 2 <= protocol::kMaxTransitions;
}

std::vector<mechanics::TimedLayer> Coordinator::layers(CarrierId carrier, const protocol::Course& course,
                                                       SwarmTime origin) const {
  return protocol::layers(course, origin, [&](const PlanNumber& number) { return plans_.slice(number, carrier); });
}

std::vector<PlanNumber> Coordinator::plans_in_use() const {
  std::vector<PlanNumber> numbers = protocol::plans_of(course_);  // first: these must never be left out
  if (agreement_) numbers.push_back(agreement_->intent().to);
  numbers.push_back(motion_);
  numbers.push_back(rest_);
  return numbers;
}

void Coordinator::offer_plans(Outputs& out) const {
  const auto numbers = plans_in_use();
  for (const CarrierId id : carriers_) out.offers.push_back(plans_.offer(term_, id, numbers));
}

std::vector<CarrierId> Coordinator::unconfirmed(LocalTime now) const {
  const std::uint64_t id = agreement_->transition().id;
  const auto confirmed = [&](const protocol::AgentStatus& s) { return s.term == term_ && s.confirmed >= id; };
  // Who was lost before cannot be asked: whether to fly on without it was decided by the mission's policy, or by a
  // person. Who is lost while this is agreed may be alive, and has not said whether it can fly it.
  // Nor can one be that does not know the plan in force: it follows when the transition is complete.
  const std::vector<CarrierId> back = without(not_asked_, lost(now));
  return without(without(fleet_.missing(now, confirmed), without(not_asked_, back)), without_base(now));
}

/// Whom this coordinator hears of and cannot tell the plan in force.
std::vector<CarrierId> Coordinator::without_base(LocalTime now) const {
  std::vector<CarrierId> out;
  for (const CarrierId id : carriers_) {
    if (!fleet_.silent(now, id) && plans_.slice(course_.base.number, id) == nullptr) out.push_back(id);
  }
  return out;
}

std::optional<std::string> Coordinator::refusal_of(const PlanNumber& plan) const {
  for (const CarrierId id : carriers_) {
    const protocol::AgentStatus* status = fleet_.status(id);
    if (status != nullptr && status->refused == plan) return status->refusal;
  }
  return std::nullopt;
}

Duration Coordinator::skew_budget(const PlanNumber& plan) const {
  const double budget_s =
      mechanics::skew_budget_s(plans_.slices(plan), job_.plan.load.mass_kg * job_.plan.gravity_m_s2);
  constexpr double kForever_s = 1e6;
  return budget_s < kForever_s ? from_seconds(budget_s) : Duration::zero();
}

std::optional<std::string> Coordinator::obstacle(LocalTime now, const PlanNumber& to) const {
  if (const auto refusal = refusal_of(to)) return "refused: " + *refusal;
  if (!room_for_transition()) return "too many transitions are under way; wait until they are complete";
  const std::vector<CarrierId> gone = lost(now);
  if (gone.size() == carriers_.size()) return "no agent is heard: check the network between them and here";
  if (!gone.empty() && job_.on_agent_loss == AgentLoss::kFreeze && moves(to)) {
    return listed("carrier", gone) + (gone.size() == 1 ? " is" : " are") +
           " lost, and the mission flies with all or not at all";
  }
  // In motion it is too late to be choosy: whatever a person asks for then is better than what is.
  if (const auto complaint = readiness_.complaint(now); complaint && moves(to) && !moving()) return complaint;
  const Duration budget = skew_budget(to);
  if (budget > Duration::zero() && skew(now) > budget) {
    return text("the clocks may disagree by %.3g ms, the plan allows %.3g ms", 1e3 * seconds(skew(now)),
                1e3 * seconds(budget));
  }
  return std::nullopt;
}

Intent Coordinator::intent_to(const PlanNumber& to, std::optional<std::uint64_t> command) const {
  Intent intent;
  intent.to = to;
  intent.duration = job_.transition.value_or(options_.shortest_transition);
  intent.may_slow_down = !job_.transition;
  intent.command = command;
  return intent;
}

// ---------------------------------------------------------------------------------------------------------- wanting

void Coordinator::drive(LocalTime now, Outputs& out) {
  if (lost(now).empty()) frozen_for_loss_ = false;
  if (agreement_) return pursue(now, out);
  if (now < retry_at_ || !room_for_transition()) return;

  const std::vector<CarrierId> baseless = without_base(now);
  if (!baseless.empty() && now - term_since_ > options_.listening && destination() != rest_) {
    // What it knew of it died with a coordinator and an agent; all there is to offer is another plan.
    tell(out, Notice::Level::kError,
         "nobody knows the plan in force for " + listed("carrier", baseless) + ": going to rest");
    Intent intent = intent_to(rest_, std::nullopt);
    intent.rehearsed = false;
    return begin(now, intent);
  }
  const std::vector<CarrierId> gone = lost(now);
  const bool some_gone = !gone.empty() && !cut_off(now);
  if (some_gone && !frozen_for_loss_ && moving() && job_.on_agent_loss == AgentLoss::kFreeze && !shutting_down_) {
    tell(out, Notice::Level::kError, "lost " + listed("carrier", gone) + ": freezing where it stopped");
    engage_ = false;
    frozen_for_loss_ = true;
    const auto last = fleet_.last_heard(gone.front());
    return freeze(now, swarm_time(last.value_or(now)) + options_.coasting, false, std::nullopt, out);
  }
  if (shutting_down_) {
    if (course_.transitions.empty() && !moving()) {
      out.finished = Outcome{true, "the flight has ended at rest"};
    } else if (release_failures_ >= options_.release_attempts) {
      out.finished = Outcome{false, "the flight could not be brought to rest: agents do not answer"};
    } else if (destination() != rest_ && moving()) {
      Intent intent = intent_to(rest_, std::nullopt);
      intent.may_slow_down = true;  // a flight must be able to end, however short its transitions were meant to be
      begin(now, intent);
    }
    return;
  }
  if (!engage_ || destination() != rest_) return;
  const auto ready = [this](const protocol::AgentStatus& s) {
    return std::find(s.accepted.begin(), s.accepted.end(), motion_) != s.accepted.end() &&
           s.state == protocol::AgentState::kReady;
  };
  if (!refusal_of(motion_) && !fleet_.missing(now, ready).empty()) return;
  if (!readiness_.complaint(now)) {
    not_ready_since_.reset();
  } else if (!not_ready_since_) {
    not_ready_since_ = now;
  }
  if (not_ready_since_ && now - *not_ready_since_ < options_.patience) return;
  if (const auto why = obstacle(now, motion_)) {
    const std::string told = "the motion does not begin: " + *why;
    if (told != news_) tell(out, Notice::Level::kWarning, told);
    retry_at_ = now + options_.agreement.lead;
    return;
  }
  begin(now, intent_to(motion_, std::nullopt));
}

void Coordinator::freeze(LocalTime now, SwarmTime moment, bool rehearsed, std::optional<std::uint64_t> command,
                         Outputs& out) {
  Slices still;
  for (const CarrierId id : carriers_) {
    const auto stack = layers(id, course_, moment);
    if (!stack.empty()) still.emplace(id, mechanics::frozen_slice(stack, 0.0));
  }
  Intent intent;
  intent.to = plans_.add(term_, std::move(still), "frozen");
  intent.duration = options_.freezing;
  intent.may_slow_down = true;
  intent.rehearsed = rehearsed;
  intent.command = command;
  begin(now, intent);
  offer_plans(out);
}

void Coordinator::begin(LocalTime now, Intent intent) {
  not_asked_ = lost(now);
  agreement_.emplace(++last_transition_, intent, options_.agreement);
  agreement_->schedule(swarm_time(now), carriers_.size());
}

// ------------------------------------------------------------------------------------------------------- transitions

void Coordinator::pursue(LocalTime now, Outputs& out) {
  const auto rehearse = [this] {
    const Transition& t = agreement_->transition();
    protocol::Course rehearsed = course_;
    rehearsed.transitions.push_back(t);
    rehearsed.transitions.back().stage = Stage::kGo;
    std::vector<std::vector<mechanics::TimedLayer>> stacks;
    for (const CarrierId id : carriers_) {
      auto stack = layers(id, rehearsed, t.start);
      if (!stack.empty()) stacks.push_back(std::move(stack));
    }
    agreement_->rehearse(Rehearsal(std::move(stacks), job_.plan.limits));
  };
  const std::vector<CarrierId> gone = lost(now);
  if (!gone.empty() && job_.on_agent_loss == AgentLoss::kFreeze && moves(agreement_->intent().to)) {
    return give_up(now, "lost " + listed("carrier", gone), out);
  }
  if (agreement_->needs_rehearsal()) {
    const auto knows_base = [this](CarrierId id) { return plans_.slice(course_.base.number, id) != nullptr; };
    if (std::none_of(carriers_.begin(), carriers_.end(), knows_base)) {
      return give_up(now, "no agent has told yet what it flies", out);
    }
    rehearse();
  }
  const bool was_proposed = agreement_->proposed();
  switch (agreement_->step(swarm_time(now), was_proposed ? unconfirmed(now) : std::vector<CarrierId>{})) {
    case Agreement::Step::kWait:
      break;
    case Agreement::Step::kAgain:
      agreement_->schedule(swarm_time(now), carriers_.size());
      break;
    case Agreement::Step::kPropose:
      course_.transitions.push_back(agreement_->transition());
      ++course_.revision;
      offer_plans(out);
      break;
    case Agreement::Step::kGo:
      go(out);
      break;
    case Agreement::Step::kGiveUp:
      give_up(now, agreement_->why(), out);
      break;
  }
}

void Coordinator::go(Outputs& out) {
  const Transition& t = agreement_->transition();
  course_.transitions.back() = t;
  ++course_.revision;
  const std::string told =
      text("transition to the %s plan is go and takes %.3g s", plans_.name(t.to.number), seconds(t.duration));
  tell(out, Notice::Level::kInfo, told);
  if (agreement_->intent().command) answer(*agreement_->intent().command, true, told, out);
  // A freeze is never turned back: holding still is where one would turn to.
  if (agreement_->intent().rehearsed) starting_ = t.id;
  if (t.to.number == motion_) engage_ = false;
  release_failures_ = 0;
  before_retune_.reset();
  agreement_.reset();
  plans_.keep(plans_in_use());
}

void Coordinator::undo_retune() {
  if (!before_retune_) return;
  job_ = before_retune_->job;
  rest_ = before_retune_->rest;
  motion_ = before_retune_->motion;
  before_retune_.reset();
}

void Coordinator::give_up(LocalTime now, const std::string& why, Outputs& out) {
  const Agreement& agreement = *agreement_;
  if (agreement.proposed()) {
    course_.transitions.pop_back();
    ++course_.revision;
  }
  const auto refusal = refusal_of(agreement.intent().to);
  const std::string told = text("transition to the %s plan given up: %s", plans_.name(agreement.intent().to),
                                refusal ? ("refused: " + *refusal).c_str() : why.c_str());
  tell(out, Notice::Level::kWarning, told);
  if (agreement.intent().command) answer(*agreement.intent().command, false, told, out);
  if (shutting_down_) ++release_failures_;
  if (!agreement.intent().rehearsed) frozen_for_loss_ = false;  // try again: the load is still not held
  undo_retune();
  retry_at_ = now + options_.agreement.lead;
  agreement_.reset();
  plans_.keep(plans_in_use());
  offer_plans(out);
}

void Coordinator::check_start(LocalTime now, Outputs& out) {
  if (!starting_) return;
  const auto is_starting = [id = *starting_](const Transition& t) { return t.id == id; };
  auto found = std::find_if(course_.transitions.begin(), course_.transitions.end(), is_starting);
  if (found == course_.transitions.end()) {
    starting_.reset();
    return;
  }
  if (swarm_time(now) < found->start + options_.start_check || cut_off(now)) return;
  const auto follows = [&](const protocol::AgentStatus& s) {
    const auto& theirs = s.course.transitions;
    if (s.term != term_) return false;
    return s.course.base.number == found->to.number ||
           std::any_of(theirs.begin(), theirs.end(),
                       [&](const Transition& t) { return t.id == found->id && t.stage == Stage::kGo; });
  };
  const std::vector<CarrierId> missing = without(fleet_.missing(now, follows), lost(now));
  starting_.reset();
  if (missing.empty() || shutting_down_) return;
  tell(out, Notice::Level::kWarning,
       listed("carrier", missing) + (missing.size() == 1 ? " does" : " do") +
           " not follow the transition that began: turning back");
  // It was wanted, and still is: nobody has to ask for it again.
  engage_ = engage_ || found->to.number == motion_;
  retry_at_ = now + options_.turning_back;
  if (agreement_) {  // it was to lie on what is turned back now
    give_up(now, "the transition before it is turned back", out);
    found = std::find_if(course_.transitions.begin(), course_.transitions.end(), is_starting);
  }
  // The plan below is known to everybody: no need to ask. Who never began stays where the turn leads.
  const auto index = static_cast<std::size_t>(found - course_.transitions.begin());
  Transition back;
  back.id = ++last_transition_;
  back.to = index == 0 ? course_.base : course_.transitions[index - 1].to;
  back.start = swarm_time(now) + options_.agreement.go_margin;
  back.duration = options_.turning_back;
  back.stage = Stage::kGo;
  course_.transitions.push_back(back);
  ++course_.revision;
}

}  // namespace gyre::coordinator
