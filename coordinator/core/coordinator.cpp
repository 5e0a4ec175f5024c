#include "coordinator/core/coordinator.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/mechanics/rest_plan.hpp"
#include "common/protocol/course.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::coordinator {

using protocol::CommandKind;

using protocol::PlanNumber;
using protocol::Stage;
using protocol::Transition;

namespace {

std::vector<CarrierId> ids(const mechanics::Plan& plan) {
  std::vector<CarrierId> out;
  for (const mechanics::Carrier& carrier : plan.carriers) out.push_back(carrier.id);
  return out;
}

/// Terms count up in their upper bits; the lower ones tell apart coordinators that took the same one.
constexpr int kNonceBits = 16;

unsigned long long generation(std::uint64_t term) {
  return term >> kNonceBits;
}

}  // namespace

Coordinator::Coordinator(const Job& job, const CoordinatorOptions& options)
    : job_(job),
      options_(options),
      carriers_(ids(job.plan)),
      fleet_(carriers_, options.agent_timeout),
      engage_(options.engage_when_ready) {}

Outputs Coordinator::step(LocalTime now, const Event& event) {
  Outputs out;
  std::visit([&](const auto& e) { on(now, e, out); }, event);
  out.next_tick = next_tick_;
  return out;
}

// ---------------------------------------------------------------------------------------------------------- events

void Coordinator::on(LocalTime now, const Tick& /*tick*/, Outputs& out) {
  if (now < next_tick_) return;
  next_tick_ = std::max(next_tick_ + options_.beacon_period, now);
  watch_agents(now, out);
  if (term_ == 0) {
    open(now, out);
    return;
  }
  if (protocol::settle(course_, swarm_time(now))) {
    ++course_.revision;
    out.notices.push_back(
        {Notice::Level::kInfo, text("the load is held by the %s plan", plan_name(course_.base.number))});
  }
  drive(now, out);
  out.beacon = protocol::Beacon{term_, ++sequence_, swarm_time(now), course_};
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
  if (term_ != 0 && status.term > term_) {
    out.finished =
        Outcome{false, text("carrier %u follows a newer coordinator (term %llu, this one has %llu): standing "
                            "down",
                            status.carrier, generation(status.term), generation(term_))};
  }
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

void Coordinator::on(LocalTime now, const protocol::Command& command, Outputs& out) {
  const auto answer = [&](const std::string& why) { out.replies.push_back({command.id, false, why}); };
  if (term_ == 0) return answer("the coordinator is still listening for a swarm that already flies; try again in 2 s");
  if (shutting_down_) return answer("the flight is ending");
  if (pending_) return answer("a transition is being agreed; try again when it is done");
  PlanNumber to;
  switch (command.kind) {
    case CommandKind::kEngage:
      to = motion_;
      break;
    case CommandKind::kRelease:
      to = rest_;
      break;
    default:
      return answer("this coordinator knows engage and release only");
  }
  if (destination() == to) return answer(text("already there: the %s plan", plan_name(to)));
  engage_ = false;
  begin(now, to, command.id);
}

void Coordinator::on(LocalTime /*now*/, const protocol::Beacon& beacon, Outputs& out) {
  if (!sane(beacon) || beacon.term == term_) return;  // our own, or nothing
  if (beacon.term < term_) {
    ++dropped_.wrong_term;
    return;
  }
  out.finished = Outcome{
      false,
      text("another coordinator flies this swarm (term %llu): standing down; end it first, or use another domain",
           generation(beacon.term))};
}

void Coordinator::on(LocalTime /*now*/, const Shutdown& /*shutdown*/, Outputs& out) {
  if (term_ == 0) {
    out.finished = Outcome{true, "ended before the flight began"};
    return;
  }
  if (!shutting_down_) out.notices.push_back({Notice::Level::kInfo, "ending the flight: back to rest"});
  shutting_down_ = true;
  engage_ = false;
}

// --------------------------------------------------------------------------------------------------------- opening

void Coordinator::open(LocalTime now, Outputs& out) {
  if (!listening_since_) {
    listening_since_ = now;
    out.notices.push_back(
        {Notice::Level::kInfo, text("mission \"%s\": listening for %zu agents", job_.name.c_str(), carriers_.size())});
  }
  std::uint64_t above = 0;
  for (const CarrierId id : carriers_) {
    if (const auto* status = fleet_.status(id)) above = std::max(above, status->term);
  }
  const bool all_heard = fleet_.missing(now, [](const auto&) { return true; }).empty();
  // Once everybody was heard and nobody has flown, there is nothing to listen for.
  if (!(all_heard && above == 0) && now - *listening_since_ < options_.listening) return;
  take_term(now, above, out);
}

void Coordinator::take_term(LocalTime now, std::uint64_t above, Outputs& out) {
  const std::uint64_t nonce = options_.nonce & ((1U << kNonceBits) - 1);
  term_ = (((above >> kNonceBits) + 1) << kNonceBits) | nonce;
  rest_ = {term_, 1};
  motion_ = {term_, 2};
  plans_[rest_] = mechanics::slices(mechanics::rest_plan(job_.plan));
  plans_[motion_] = mechanics::slices(job_.plan);
  course_.revision = 1;
  course_.base = {rest_, swarm_time(now)};
  out.notices.push_back(
      {Notice::Level::kInfo, text("term %llu: the load is held by the rest plan", generation(term_))});
  offer_plans(out);
}

void Coordinator::offer_plans(Outputs& out) const {
  for (std::size_t i = 0; i < carriers_.size(); ++i) {
    protocol::PlanOffer offer{carriers_[i], term_, {}};
    for (const auto& [number, slices] : plans_) offer.slices.push_back({number, slices[i]});
    out.offers.push_back(std::move(offer));
  }
}

// --------------------------------------------------------------------------------------------------------- driving

void Coordinator::watch_agents(LocalTime now, Outputs& out) {
  for (const Fleet::Change& change : fleet_.changes(now)) {
    const Notice::Level level = change.lost ? Notice::Level::kWarning : Notice::Level::kInfo;
    const char* what = change.lost ? "is silent" : change.restarted ? "was restarted" : "is here";
    out.notices.push_back({level, text("agent %u %s", change.carrier, what)});
  }
}

PlanNumber Coordinator::destination() const {
  return course_.transitions.empty() ? course_.base.number : course_.transitions.back().to.number;
}

std::optional<std::string> Coordinator::refusal_of(const PlanNumber& plan) const {
  for (const CarrierId id : carriers_) {
    const protocol::AgentStatus* status = fleet_.status(id);
    if (status != nullptr && status->refused == plan) return status->refusal;
  }
  return std::nullopt;
}

void Coordinator::drive(LocalTime now, Outputs& out) {
  if (pending_) {
    pending_->rehearsal ? propose(now, out) : settle_proposal(now, out);
    return;
  }
  if (now < retry_at_) return;
  if (shutting_down_) {
    if (course_.transitions.empty() && course_.base.number == rest_) {
      out.finished = Outcome{true, "the flight has ended at rest"};
    } else if (release_failures_ >= options_.release_attempts) {
      out.finished = Outcome{false, "the flight could not be brought to rest: agents do not answer"};
    } else if (destination() != rest_) {
      begin(now, rest_, std::nullopt);
    }
    return;
  }
  if (!engage_) return;
  if (const auto refusal = refusal_of(motion_)) {
    if (!refusal_told_) out.notices.push_back({Notice::Level::kError, "the motion cannot be flown: " + *refusal});
    refusal_told_ = true;
    return;
  }
  const auto has_accepted = [this](const protocol::AgentStatus& s) {
    return std::find(s.accepted.begin(), s.accepted.end(), motion_) != s.accepted.end() &&
           s.state == protocol::AgentState::kReady;
  };
  if (fleet_.missing(now, has_accepted).empty()) begin(now, motion_, std::nullopt);
}

// ------------------------------------------------------------------------------------------------------ transitions

void Coordinator::begin(LocalTime now, const PlanNumber& to, std::optional<std::uint64_t> command) {
  Pending pending;
  pending.transition.id = ++last_transition_;
  pending.transition.to.number = to;
  pending.transition.duration = job_.transition.value_or(options_.shortest_transition);
  pending.command = command;
  pending_ = std::move(pending);
  rehearse(now);
}

void Coordinator::rehearse(LocalTime now) {
  Transition& t = pending_->transition;
  const auto carriers = static_cast<Duration::rep>(carriers_.size());
  t.start = swarm_time(now) + options_.lead + options_.rehearsal_per_carrier * carriers;
  t.to.epoch = t.start;  // a motion begins at phase zero
  protocol::Course rehearsed = course_;
  rehearsed.transitions.push_back(t);
  rehearsed.transitions.back().stage = Stage::kGo;
  std::vector<std::vector<mechanics::TimedLayer>> stacks;
  for (std::size_t i = 0; i < carriers_.size(); ++i) {
    stacks.push_back(protocol::layers(rehearsed, t.start, [&](const PlanNumber& n) { return &plans_.at(n)[i]; }));
  }
  pending_->rehearsal.emplace(std::move(stacks), job_.plan.limits);
}

void Coordinator::propose(LocalTime now, Outputs& out) {
  Pending& p = *pending_;
  if (!p.rehearsal->advance()) return;
  if (!p.rehearsal->reasons().empty()) {
    if (++p.attempt > options_.slower_attempts || job_.transition) {
      give_up("the transition would break a limit: " + p.rehearsal->reasons().front().text, out);
      return;
    }
    p.transition.duration *= 2;
    rehearse(now);
    return;
  }
  // The lead is for the agents to answer in; a rehearsal that took it up begins again, for a later start.
  if (p.transition.start - swarm_time(now) < options_.lead / 2 + options_.go_margin) {
    if (++p.attempt > options_.slower_attempts) return give_up("rehearsing it takes too long on this machine", out);
    rehearse(now);
    return;
  }
  p.rehearsal.reset();
  course_.transitions.push_back(p.transition);
  ++course_.revision;
  offer_plans(out);
}

void Coordinator::settle_proposal(LocalTime now, Outputs& out) {
  const Transition& t = pending_->transition;
  const auto has_confirmed = [&](const protocol::AgentStatus& s) { return s.term == term_ && s.confirmed >= t.id; };
  const std::vector<CarrierId> missing = fleet_.missing(now, has_confirmed);
  if (missing.empty()) {
    course_.transitions.back().stage = Stage::kGo;
    ++course_.revision;
    const std::string told = text("transition to the %s plan starts in %.2f s and takes %.3g s", plan_name(t.to.number),
                                  seconds(t.start - swarm_time(now)), seconds(t.duration));
    out.notices.push_back({Notice::Level::kInfo, told});
    if (pending_->command) out.replies.push_back({*pending_->command, true, told});
    if (t.to.number == motion_) engage_ = false;
    release_failures_ = 0;
    pending_.reset();
    return;
  }
  if (t.start - swarm_time(now) >= options_.go_margin) return;
  course_.transitions.pop_back();
  ++course_.revision;
  if (const auto refusal = refusal_of(t.to.number)) {
    give_up("refused: " + *refusal, out);
  } else {
    give_up("not confirmed in time by " + list(missing), out);
  }
  retry_at_ = now + options_.lead;
}

void Coordinator::give_up(const std::string& why, Outputs& out) {
  const std::string told =
      text("transition to the %s plan given up: %s", plan_name(pending_->transition.to.number), why.c_str());
  out.notices.push_back({Notice::Level::kWarning, told});
  if (pending_->command) out.replies.push_back({*pending_->command, false, told});
  if (shutting_down_) ++release_failures_;
  pending_.reset();
}

const char* Coordinator::plan_name(const PlanNumber& plan) const {
  if (plan == rest_) return "rest";
  return plan == motion_ ? "motion" : "former";
}

}  // namespace gyre::coordinator
