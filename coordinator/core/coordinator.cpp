// What the coordinator hears, and how it takes its term. What it does about the course is in course_changes.cpp.

#include "coordinator/core/coordinator.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/mechanics/rest_plan.hpp"
#include "common/protocol/course.hpp"
#include "common/protocol/sanity.hpp"
#include "common/protocol/term.hpp"

namespace gyre::coordinator {

using protocol::CommandKind;
using protocol::generation;

namespace {

std::vector<CarrierId> ids(const mechanics::Plan& plan) {
  std::vector<CarrierId> out;
  for (const mechanics::Carrier& carrier : plan.carriers) out.push_back(carrier.id);
  return out;
}

}  // namespace

Coordinator::Coordinator(const Job& job, const CoordinatorOptions& options)
    : job_(job),
      options_(options),
      carriers_(ids(job.plan)),
      fleet_(carriers_, options.agent_timeout),
      readiness_(carriers_),
      engage_(options.engage_when_ready) {}

Outputs Coordinator::step(LocalTime now, const Event& event) {
  Outputs out;
  std::visit([&](const auto& e) { on(now, e, out); }, event);
  out.next_tick = next_tick_;
  return out;
}

void Coordinator::tell(Outputs& out, Notice::Level level, const std::string& text) {
  news_ = text;
  out.notices.push_back({level, text});
}

void Coordinator::on(LocalTime now, const Tick& /*tick*/, Outputs& out) {
  if (now < next_tick_) return;
  // A stall is not made up for: the next beacon is one period from now, not a burst of the missed ones.
  next_tick_ += options_.beacon_period;
  if (next_tick_ <= now) next_tick_ = now + options_.beacon_period;
  watch_agents(now, out);
  if (term_ == 0) {
    listen(now, out);
    return;
  }
  const bool settled = protocol::settle(course_, swarm_time(now));
  if (settled) {
    ++course_.revision;
    tell(out, Notice::Level::kInfo, text("the load is held by the %s plan", plans_.name(course_.base.number)));
  }
  // Of n slices: not for every beacon.
  if (settled || now >= next_status_) budget_in_force_ = skew_budget(course_.base.number);
  check_start(now, out);
  drive(now, out);
  out.beacon = protocol::Beacon{term_, ++sequence_, swarm_time(now), course_, budget_in_force_};
  if (now >= next_status_) {
    next_status_ = now + options_.status_period;
    out.status = status(now);
  }
}

void Coordinator::on(LocalTime now, const protocol::AgentStatus& status, Outputs& out) {
  if (!sane(status)) {
    ++dropped_.nonsense;
    return;
  }
  switch (fleet_.take(now, status)) {
    case Fleet::Verdict::kTaken:
      break;
    case Fleet::Verdict::kStranger:
      ++dropped_.nonsense;
      return;
    case Fleet::Verdict::kDuplicate:
      ++dropped_.duplicate;
      return;
    case Fleet::Verdict::kLate:
      ++dropped_.late;
      return;
  }
  if (term_ == 0) {
    recovery_.take(now, status);
  } else if (status.term > term_) {
    stand_down(text("carrier %u follows a newer coordinator (term %llu, this one has %llu): standing down",
                    status.carrier, generation(status.term), generation(term_)),
               out);
  }
}

void Coordinator::on(LocalTime /*now*/, const protocol::HeldPlans& held, Outputs& out) {
  const bool ours = std::find(carriers_.begin(), carriers_.end(), held.carrier) != carriers_.end();
  if (!ours || !sane(protocol::PlanOffer{held.carrier, 0, held.slices})) {
    ++dropped_.nonsense;
    return;
  }
  if (term_ == 0) return recovery_.take(held);
  // Somebody who was out of reach when this coordinator recovered may still bring what nobody else knows.
  bool learned = false;
  for (const protocol::NumberedSlice& numbered : held.slices)
    learned = plans_.complete(held.carrier, numbered) || learned;
  if (learned) offer_plans(out);
}

void Coordinator::on(LocalTime now, const TimeRequestArrived& event, Outputs& out) {
  const protocol::TimeRequest& request = event.request;
  if (std::find(carriers_.begin(), carriers_.end(), request.carrier) == carriers_.end() || event.arrived > now) {
    ++dropped_.nonsense;
    return;
  }
  fleet_.heard(now, request.carrier);
  if (term_ == 0) return;  // no swarm time to give yet
  out.time_reply = protocol::TimeReply{request.carrier, request.incarnation,       request.sequence, term_,
                                       request.sent,    swarm_time(event.arrived), swarm_time(now)};
}

void Coordinator::on(LocalTime /*now*/, const protocol::Beacon& beacon, Outputs& out) {
  if (!sane(beacon)) {
    ++dropped_.nonsense;
  } else if (beacon.term < term_) {
    ++dropped_.wrong_term;
  } else if (beacon.term > term_) {
    stand_down(text("another coordinator flies this swarm (term %llu): standing down; end it first, or use another "
                    "domain",
                    generation(beacon.term)),
               out);
  }
}

void Coordinator::on(LocalTime now, const protocol::Health& health, Outputs& /*out*/) {
  readiness_.take(now, health);
}

void Coordinator::stand_down(const std::string& why, Outputs& out) {
  if (agreement_ && agreement_->intent().command) answer(*agreement_->intent().command, false, why, out);
  agreement_.reset();
  out.finished = Outcome{false, why};
}

bool Coordinator::heard_before(std::uint64_t command, Outputs& out) {
  if (last_command_ != command) {
    last_command_ = command;
    last_reply_.reset();
    return false;
  }
  if (last_reply_) out.replies.push_back(*last_reply_);  // the answer was lost on its way
  return true;
}

void Coordinator::answer(std::uint64_t command, bool done, const std::string& text, Outputs& out) {
  const protocol::CommandReply reply{command, done, text.substr(0, protocol::kMaxTextBytes)};
  if (last_command_ == command) last_reply_ = reply;
  out.replies.push_back(reply);
}

void Coordinator::on(LocalTime now, const protocol::Command& command, Outputs& out) {
  if (heard_before(command.id, out)) return;
  const auto refuse = [&](const std::string& why) { answer(command.id, false, why, out); };
  if (term_ == 0) return refuse("the coordinator is still listening for a swarm that already flies; try again in 2 s");
  if (shutting_down_) return refuse("the flight is ending");
  if (agreement_) return refuse("a transition is being agreed; try again when it is done");
  switch (command.kind) {
    case CommandKind::kFreeze:
      if (!moving()) return refuse("nothing moves");
      if (!room_for_transition()) return refuse("too many transitions are under way; wait until they are complete");
      engage_ = false;
      return freeze(now, swarm_time(now) + options_.agreement.lead, true, command.id, out);
    case CommandKind::kEngage:
    case CommandKind::kRelease:
      break;
    case CommandKind::kRetune:
      return refuse("a retune needs its mission read first");
  }
  // Whoever wants rest does not want the motion that is still waited for.
  if (command.kind == CommandKind::kRelease) engage_ = false;
  const protocol::PlanNumber to = command.kind == CommandKind::kEngage ? motion_ : rest_;
  if (destination() == to) return refuse(text("already there: the %s plan", plans_.name(to)));
  if (const auto why = obstacle(now, to)) return refuse(*why);
  engage_ = false;
  begin(now, intent_to(to, command.id));
}

void Coordinator::on(LocalTime now, const Retune& retune, Outputs& out) {
  if (heard_before(retune.command, out)) return;
  const auto refuse = [&](const std::string& why) { answer(retune.command, false, "cannot retune: " + why, out); };
  if (term_ == 0 || shutting_down_ || agreement_) return refuse("the coordinator is busy; try again");
  if (!retune.job) return refuse(retune.job.error().text);
  if (!room_for_transition()) return refuse("too many transitions are under way; wait until they are complete");
  if (const auto why = retune_obstacle(job_.plan, retune.job.value().plan)) return refuse(*why);
  if (const auto gone = lost(now); !gone.empty())
    return refuse(listed("carrier", gone) + " cannot say whether it can be flown: lost");
  const bool at_rest = !moves(destination());
  before_retune_ = Mission{job_, rest_, motion_};
  job_ = retune.job.value();
  rest_ = plans_.add(term_, by_carrier(mechanics::slices(mechanics::rest_plan(job_.plan))), "rest");
  motion_ = plans_.add(term_, by_carrier(mechanics::slices(job_.plan)), "motion");
  const protocol::PlanNumber to = at_rest ? rest_ : motion_;
  if (const auto why = obstacle(now, to)) {
    undo_retune();
    return refuse(*why);
  }
  offer_plans(out);
  // The agents see the plan and the proposal in the same moment; the lead is theirs to accept and confirm.
  begin(now, intent_to(to, retune.command));
}

void Coordinator::on(LocalTime /*now*/, const Shutdown& /*shutdown*/, Outputs& out) {
  if (term_ == 0) {
    out.finished = Outcome{true, "ended before the flight began"};
    return;
  }
  if (!shutting_down_) tell(out, Notice::Level::kInfo, "ending the flight: back to rest");
  shutting_down_ = true;
  engage_ = false;
}

// --------------------------------------------------------------------------------------------------------- listening

void Coordinator::listen(LocalTime now, Outputs& out) {
  if (!listening_since_) {
    listening_since_ = now;
    tell(out, Notice::Level::kInfo,
         text("mission \"%s\": listening for %zu agents", job_.name.c_str(), carriers_.size()));
  }
  // A swarm begins with everybody: whoever was not heard may fly out there, by a swarm time that is not this one's.
  const std::vector<CarrierId> unheard = this->unheard();
  if (recovery_.course()) {
    if (!recovering_since_) recovering_since_ = now;
    // The first word of an agent may have been long on its way, and swarm time is as late as the freshest of them. Once
    // everybody was heard, with every plan of the course, there is nothing left to learn.
    const auto known = [this](const protocol::AgentStatus& s) { return recovery_.complete_for(s.carrier); };
    const bool complete = fleet_.missing(now, known).empty();
    if (now - *recovering_since_ < (complete ? options_.listening_least : options_.listening)) return;
  } else if (!unheard.empty()) {
    if (now - *listening_since_ < options_.listening) return;
    const std::string told = "waiting for " + listed("carrier", unheard) + ": a flight begins with all";
    if (told != news_) tell(out, Notice::Level::kInfo, told);
    return;
  }
  if (const auto stranger = recovery_.stranger_to(by_carrier(mechanics::slices(job_.plan)))) {
    out.finished = Outcome{false, text("a swarm with another load flies here: carrier %u is attached elsewhere than in "
                                       "this mission; start with the mission that is flown, or use another domain",
                                       *stranger)};
    return;
  }
  take_term(now, out);
}

std::vector<CarrierId> Coordinator::unheard() const {
  std::vector<CarrierId> out;
  for (const CarrierId id : carriers_) {
    if (fleet_.status(id) == nullptr) out.push_back(id);
  }
  return out;
}

void Coordinator::take_term(LocalTime now, Outputs& out) {
  term_ = protocol::next_term(recovery_.highest_term(), options_.nonce);
  term_since_ = now;
  last_transition_ = recovery_.last_transition();
  for (const auto& [number, slices] : recovery_.plans()) plans_.learn(number, slices);

  const auto number_of = [this](const mechanics::Plan& plan, const char* name) {
    const Slices slices = by_carrier(mechanics::slices(plan));
    const auto known = plans_.recognise(slices, name);
    return known ? *known : plans_.add(term_, slices, name);
  };
  rest_ = number_of(mechanics::rest_plan(job_.plan), "rest");
  motion_ = number_of(job_.plan, "motion");

  if (recovery_.course()) {
    swarm_offset_ = recovery_.swarm_offset();
    course_ = *recovery_.course();
    engage_ = engage_ && destination() == rest_;
    tell(out, Notice::Level::kInfo,
         text("term %llu: took over a swarm that flies; the load is held by the %s plan", generation(term_),
              plans_.name(course_.base.number)));
  } else {
    course_.base = {rest_, swarm_time(now)};
    tell(out, Notice::Level::kInfo, text("term %llu: the load is held by the rest plan", generation(term_)));
  }
  ++course_.revision;
  offer_plans(out);
}

// ---------------------------------------------------------------------------------------------------------- watching

void Coordinator::watch_agents(LocalTime now, Outputs& out) {
  for (const Fleet::Change& change : fleet_.changes(now)) {
    const char* what = change.lost ? "is silent" : change.restarted ? "was restarted" : "is here";
    tell(out, change.lost ? Notice::Level::kWarning : Notice::Level::kInfo, text("agent %u %s", change.carrier, what));
  }
  const auto silent = [&](CarrierId id) { return fleet_.silent(now, id); };
  if (std::all_of(carriers_.begin(), carriers_.end(), silent)) heard_nobody_at_ = now;
}

/// Whoever hears nobody is cut off itself: nobody would hear of a decision in time, and all would jump to it later.
/// When the first are heard again, the others are given as long as it takes to call somebody lost.
bool Coordinator::cut_off(LocalTime now) const {
  return heard_nobody_at_ && now - *heard_nobody_at_ <= options_.loss_timeout;
}

std::vector<CarrierId> Coordinator::lost(LocalTime now) const {
  std::vector<CarrierId> out;
  for (const CarrierId id : carriers_) {
    const auto last = fleet_.last_heard(id);
    if (!last || now - *last > options_.loss_timeout) out.push_back(id);
  }
  return out;
}

Duration Coordinator::skew(LocalTime now) const {
  Duration worst{};
  for (const CarrierId id : carriers_) {
    const protocol::AgentStatus* s = fleet_.status(id);
    if (s != nullptr && !fleet_.silent(now, id))
      worst = std::max(worst, std::min(s->clock_uncertainty, Duration::max() / 4));
  }
  return 2 * worst;  // one early, another late
}

std::optional<std::string> Coordinator::complaint(LocalTime now) const {
  if (term_ == 0) return news_.empty() ? "has heard nobody yet" : news_;
  const std::vector<CarrierId> silent = fleet_.missing(now, [](const protocol::AgentStatus&) { return true; });
  if (silent.size() == carriers_.size()) return "no agent is heard";
  if (!silent.empty()) return listed("carrier", silent) + (silent.size() == 1 ? " is silent" : " are silent");
  if (budget_in_force_ > Duration::zero() && skew(now) > budget_in_force_) {
    return text("the clocks may disagree by %.3g ms, the plan in force allows %.3g ms", 1e3 * seconds(skew(now)),
                1e3 * seconds(budget_in_force_));
  }
  return std::nullopt;
}

protocol::CoordinatorStatus Coordinator::status(LocalTime now) const {
  protocol::CoordinatorStatus s;
  s.term = term_;
  s.swarm_time = swarm_time(now);
  // Until a retune is agreed, the mission in force is the one before it.
  s.mission = (before_retune_ ? before_retune_->job : job_).name.substr(0, protocol::kMaxTextBytes);
  s.rest = before_retune_ ? before_retune_->rest : rest_;
  s.motion = before_retune_ ? before_retune_->motion : motion_;
  s.skew_budget = budget_in_force_;
  s.skew = skew(now);
  s.carriers = carriers_;
  for (const CarrierId id : carriers_) {
    if (fleet_.silent(now, id)) s.silent.push_back(id);
  }
  s.news = news_.substr(0, protocol::kMaxTextBytes);
  return s;
}

}  // namespace gyre::coordinator
