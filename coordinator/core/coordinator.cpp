#include "coordinator/core/coordinator.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/protocol/sanity.hpp"
#include "common/protocol/term.hpp"

namespace gyre::coordinator {

using protocol::generation;

namespace {

std::vector<CarrierId> ids(const mechanics::Plan& plan) {
  std::vector<CarrierId> out;
  for (const mechanics::Carrier& carrier : plan.carriers) out.push_back(carrier.id);
  return out;
}

}  // namespace

const protocol::Course Coordinator::kNoCourse;

Coordinator::Coordinator(const Job& job, const CoordinatorOptions& options)
    : job_(job), options_(options), swarm_(ids(job.plan), options.agent_timeout) {}

Outputs Coordinator::step(LocalTime now, const Event& event) {
  Outputs out;
  std::visit([&](const auto& e) { on(now, e, out); }, event);
  out.next_tick = hurries_ ? std::min(next_tick_, now + options_.hurry) : next_tick_;
  return out;
}

void Coordinator::on(LocalTime now, const Tick& /*tick*/, Outputs& out) {
  if (now < next_tick_) return;
  // A stall is not made up for: the next beacon is one period from now, not a burst of the missed ones.
  const Duration period = listening_ ? options_.hurry : options_.beacon_period;
  next_tick_ += period;
  if (next_tick_ <= now) next_tick_ = now + period;
  for (const Fleet::Change& change : swarm_.fleet.changes(now)) {
    const char* what = change.lost ? "is silent" : change.restarted ? "was restarted" : "is here";
    news_.tell(out, change.lost ? Notice::Level::kWarning : Notice::Level::kInfo,
               text("agent %u %s", change.carrier, what));
  }
  if (leading_) {
    leading_->tick(now, out);
  } else {
    listen(now, out);
  }
  hurries_ = leading_ && somebody_waits(now);
}

bool Coordinator::somebody_waits(LocalTime now) const {
  return std::any_of(swarm_.carriers.begin(), swarm_.carriers.end(), [&](CarrierId id) {
    const protocol::AgentStatus* status = swarm_.fleet.status(id);
    return status != nullptr && !swarm_.fleet.silent(now, id) && status->state == protocol::AgentState::kWaiting;
  });
}

void Coordinator::on(LocalTime now, const StatusArrived& event, Outputs& out) {
  const protocol::AgentStatus& status = event.status;
  if (!sane(status) || event.arrived > now) {
    ++dropped_.nonsense;
    return;
  }
  const auto& carriers = swarm_.carriers;
  const bool ours = std::find(carriers.begin(), carriers.end(), status.carrier) != carriers.end();
  if (ours && !believes(status.term)) return;
  switch (swarm_.fleet.take(now, status)) {
    case Fleet::Verdict::kTaken:
      break;
    case Fleet::Verdict::kStranger:
    case Fleet::Verdict::kLeap:
      ++dropped_.nonsense;
      return;
    case Fleet::Verdict::kDuplicate:
    case Fleet::Verdict::kRival:
      ++dropped_.duplicate;
      return;
    case Fleet::Verdict::kLate:
      ++dropped_.late;
      return;
  }
  if (listening_) {
    listening_->recovery.take(event.arrived, status);
  } else if (status.term > leading_->term()) {
    stand_down(text("carrier %u follows a newer coordinator (term %llu, this one has %llu): standing down",
                    status.carrier, generation(status.term), generation(leading_->term())),
               out);
  } else {
    leading_->heard(event.arrived, status, out);
  }
}

void Coordinator::on(LocalTime /*now*/, const protocol::HeldPlans& held, Outputs& out) {
  if (!swarm_.has(held.carrier) || !sane(held)) {
    ++dropped_.nonsense;
    return;
  }
  if (listening_) return listening_->recovery.take(held);
  leading_->learn(held, out);
}

void Coordinator::on(LocalTime now, const TimeRequestArrived& event, Outputs& out) {
  const protocol::TimeRequest& request = event.request;
  if (!swarm_.has(request.carrier) || event.arrived > now) {
    ++dropped_.nonsense;
    return;
  }
  swarm_.fleet.heard(now, request.carrier, request.incarnation);
  if (!leading_) return;  // no swarm time to give yet
  const Fleet::Standing standing = swarm_.fleet.standing(now, request.carrier, request.incarnation);
  out.time_reply =
      protocol::TimeReply{request.carrier,           request.incarnation, request.sequence,
                          leading_->term(),          request.sent,        leading_->swarm_time(event.arrived),
                          leading_->swarm_time(now), standing.believed,   standing.rival};
}

void Coordinator::on(LocalTime /*now*/, const protocol::Beacon& beacon, Outputs& out) {
  if (!sane(beacon)) {
    ++dropped_.nonsense;
  } else if (beacon.term < term()) {
    ++dropped_.wrong_term;
  } else if (beacon.term > term() && believes(beacon.term)) {
    stand_down(text("another coordinator flies this swarm (term %llu): standing down; end it first, or use another "
                    "domain",
                    generation(beacon.term)),
               out);
  }
}

void Coordinator::on(LocalTime now, const protocol::Health& health, Outputs& /*out*/) {
  swarm_.readiness.take(now, health);
}

void Coordinator::on(LocalTime now, const protocol::CarrierState& state, Outputs& out) {
  if (!swarm_.has(state.carrier) || !sane(state)) {
    ++dropped_.nonsense;
    return;
  }
  if (!swarm_.fleet.believes(now, state)) {
    ++dropped_.duplicate;
    return;
  }
  if (leading_) leading_->seen(now, state, out);
}

void Coordinator::on(LocalTime now, const protocol::Command& command, Outputs& out) {
  if (leading_) return leading_->command(now, command, out);
  // Not remembered: said again in a moment, it is heard by a coordinator that leads.
  out.replies.push_back(
      {command.id, false, "the coordinator is still listening for a swarm that already flies; try again in 2 s"});
}

void Coordinator::on(LocalTime now, const Retune& retune, Outputs& out) {
  if (leading_) return leading_->retune(now, retune, out);
  out.replies.push_back({retune.command, false, "cannot retune: the coordinator is still listening; try again in 2 s"});
}

void Coordinator::on(LocalTime /*now*/, const Shutdown& /*shutdown*/, Outputs& out) {
  if (leading_) return leading_->shut_down(out);
  out.finished = Outcome{true, "ended before the flight began"};
}

bool Coordinator::believes(std::uint64_t term) {
  const std::uint64_t known = leading_ ? leading_->term() : listening_->recovery.highest_term();
  if (term <= known || terms_.believes(known, term)) return true;
  ++dropped_.nonsense;
  return false;
}

void Coordinator::stand_down(const std::string& why, Outputs& out) {
  if (leading_) leading_->stand_down(why, out);
  out.finished = Outcome{false, why};
}

void Coordinator::listen(LocalTime now, Outputs& out) {
  Listening& heard = *listening_;
  if (!heard.since) {
    heard.since = now;
    news_.tell(out, Notice::Level::kInfo,
               text("mission \"%s\": listening for %zu agents", job_.name.c_str(), swarm_.carriers.size()));
  }
  // A swarm begins with everybody: whoever was not heard may fly out there, by a swarm time that is not this one's.
  std::vector<CarrierId> unheard;
  for (const CarrierId id : swarm_.carriers) {
    if (swarm_.fleet.status(id) == nullptr) unheard.push_back(id);
  }
  if (heard.recovery.course()) {
    // What waited while this process hung is old, too: it listens anew.
    const bool hung = now - heard.looked > options_.listening_least;
    if (!heard.recovering_since || hung) heard.recovering_since = now;
    heard.looked = now;
    // The first word of an agent may have been long on its way, and swarm time is as late as the freshest of them. Once
    // everybody was heard, with every plan of the course, there is nothing left to learn.
    const auto known = [&heard](const protocol::AgentStatus& s) { return heard.recovery.complete_for(s.carrier); };
    const bool complete = swarm_.fleet.missing(now, known).empty();
    if (now - *heard.recovering_since < (complete ? options_.listening_least : options_.listening)) return;
  } else if (!unheard.empty()) {
    if (now - *heard.since < options_.listening) return;
    return news_.tell_once(out, Notice::Level::kInfo,
                           "waiting for " + listed("carrier", unheard) + ": a flight begins with all");
  }
  if (const auto why = heard.recovery.obstacle_to(by_carrier(mechanics::slices(job_.plan)))) {
    out.finished = Outcome{false, "a swarm with another load flies here: " + *why +
                                      "; start with the mission that is flown, or use another domain"};
    return;
  }
  Beginning beginning{protocol::next_term(heard.recovery.highest_term(), options_.nonce),
                      heard.recovery.course(),
                      {},
                      heard.recovery.plans()};
  if (beginning.course) beginning.swarm_offset = heard.recovery.swarm_offset();
  leading_.emplace(now, job_, options_, swarm_, news_, beginning, out);
  listening_.reset();
  leading_->tick(now, out);  // the first beacon at once: everybody waits for it
}

std::optional<std::string> Coordinator::complaint(LocalTime now) const {
  if (leading_) return leading_->complaint(now);
  return news_.latest.empty() ? "has heard nobody yet" : news_.latest;
}

}  // namespace gyre::coordinator
