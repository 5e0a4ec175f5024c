// What an observer sees of a virtual swarm, and the vehicles that only he and their agents see.

#include <algorithm>

#include "common/base/text.hpp"
#include "common/protocol/term.hpp"
#include "tests/swarm/swarm.hpp"
#include "tests/swarm/swarm_parts.hpp"

namespace gyre::swarm {

namespace {

/// A vehicle's state matters only to an agent that does not know it from its own setpoints.
constexpr Duration kLeftAlone = std::chrono::milliseconds(40);
/// docs/design.md "Loss table": an agent that falls silent is named within this time.
constexpr Duration kNamedWithin = std::chrono::milliseconds(500);
constexpr Duration kLongestHeldBack = std::chrono::seconds(3);
/// With more, what was said last may arrive too late for that.
constexpr Duration kCalm = std::chrono::milliseconds(5);

}  // namespace

void Swarm::observe() {
  schedule({now_ + kObservation, 0, Happening::kObservation, 0, 0, nullptr});
  const Weather& w = network_.weather;
  const bool bad = w.loss > 0.3 || w.bursts_per_s > 0.0 || w.overtaken > 0.0 || w.lies > 0.0 || w.jitter > kCalm ||
                   !network_.groups.empty() || coordinators_alive() != 1;
  if (bad || w.garbage > 0.0) troubled_until_ = now_ + kLongestHeldBack;
  tell_vehicle_states();
  checkers_.instant(now_);
  watch_losses();
}

void Swarm::hear_notice(const std::string& notice) {
  const auto tells = [&notice](const std::string& what) { return notice.find(what) != std::string::npos; };
  for (Process& p : processes_) {
    if (tells(text("agent %u is here", p.carrier)) || tells(text("agent %u was restarted", p.carrier))) p.known = true;
  }
  // Two coordinators that began at once had each a swarm time of its own.
  if (tells("the load is held by") && tells("at rest") && ++beginnings_ > 1) checkers_.clock_stopped(std::nullopt);
  if (tells("turning back")) ++faults_.turned_back;
  if (tells("all stop together")) ++faults_.leases_ended;
  if (tells("has left its path")) ++faults_.stuck;
  if (loss_ && tells(text("agent %u is silent", processes_[loss_->process].carrier))) {
    ++faults_.losses_named;
    loss_.reset();
  }
}

void Swarm::watch_losses() {
  if (!loss_ || now_ - loss_->at <= kNamedWithin) return;
  checkers_.report(Finding::Kind::kSafety, now_, "loss",
                   text("agent %u is dead for %.2f s and nobody says so", processes_[loss_->process].carrier,
                        seconds(now_ - loss_->at)));
  loss_.reset();
}

std::size_t Swarm::vehicle_of(std::size_t process) const {
  return (process == twin() ? process_of(processes_[process].carrier) : process) - kCoordinators;
}

protocol::CarrierState Swarm::vehicle_state(std::size_t agent) {
  protocol::CarrierState s = vehicles_[agent].state(now_);
  if (sabotage_.vehicles_do_not_tell_whom) s.follows = 0;
  s.carrier = processes_[agent + kCoordinators].carrier;
  s.stamp = LocalTime(now_.time_since_epoch());  // a clock that is right
  return s;
}

void Swarm::tell_vehicle_states() {
  const Process& twin_process = processes_[twin()];
  const auto tell = [this](std::size_t p, const protocol::CarrierState& state) {
    if (processes_[p].running() && processes_[p].joined) arrive(p, Message{state});
  };
  for (std::size_t p = kCoordinators; p < twin(); ++p) {
    const std::size_t index = p - kCoordinators;
    Vehicle& vehicle = vehicles_[index];
    show_to_coordinators(p);
    const bool led = processes_[p].sends_setpoints || processes_[p].carrier == twin_process.carrier;
    if (!led || now_ - vehicle.commanded_at() >= kLeftAlone) checkers_.alone(index, now_, vehicle.doing(now_));
    tell(p, vehicle_state(index));
    if (processes_[p].carrier == twin_process.carrier) tell(twin(), vehicle_state(index));
  }
  if (now_ < second_world_until_) tell_of_the_second_world();
}

void Swarm::tell_of_the_second_world() {
  const auto still = mechanics::slices(load_.motions.front());
  for (std::size_t p = kCoordinators; p < twin(); ++p) {
    protocol::CarrierState state;
    state.carrier = processes_[p].carrier;
    state.incarnation = 2;
    state.position_w_m = mechanics::evaluate(still[p - kCoordinators], 0.0).position_w_m.value;
    for (std::size_t to = 0; to < processes_.size(); ++to) {
      if (!processes_[to].running() || !processes_[to].joined) continue;
      const bool heard = is_agent(to) ? processes_[to].carrier == state.carrier : network_.send(now_, p, to).copies > 0;
      if (heard) arrive(to, Message{state});
    }
  }
}

/// By the same radio as its agent, but whether that lives or not.
void Swarm::show_to_coordinators(std::size_t p) {
  std::shared_ptr<const Message> state;
  for (std::size_t c = 0; c < kCoordinators; ++c) {
    const Process& target = processes_[c];
    if (!target.running() || !target.joined) continue;
    const Network::Fate fate = network_.send(now_, p, c);
    if (fate.copies == 0) continue;
    if (!state) state = std::make_shared<const Message>(Message{vehicle_state(p - kCoordinators)});
    schedule({now_ + fate.delays[0], 0, Happening::kArrival, c, target.life, state});
  }
}

bool Swarm::untroubled() const {
  if (now_ < troubled_until_ || network_.weather.loss > 0.0) return false;
  if (coordinators_alive() != 1 || coordinator()->term() == 0) return false;
  return std::all_of(processes_.begin(), processes_.end(), [this](const Process& p) {
    return (p.carrier == 0 || (p.sends_setpoints && p.known)) && now_ >= p.held_until + kNamedWithin;
  });
}

std::size_t Swarm::coordinators_alive() const {
  std::size_t alive = 0;
  for (std::size_t c = 0; c < kCoordinators; ++c) alive += processes_[c].running() ? 1 : 0;
  return alive;
}

const coordinator::Coordinator* Swarm::coordinator() const {
  for (std::size_t c = 0; c < kCoordinators; ++c) {
    if (processes_[c].running()) return processes_[c].coordinator.get();
  }
  return nullptr;
}

bool Swarm::agrees(Duration clock_bound, std::string* why) const {
  const auto no = [why](const std::string& reason) {
    *why = reason;
    return false;
  };
  if (coordinators_alive() != 1) return no(text("%zu coordinators live", coordinators_alive()));
  const auto disagreement = checkers_.disagreement();
  if (!disagreement) return no("not every agent flies");
  if (*disagreement > clock_bound) return no(text("the clocks differ by %.3g ms", 1e3 * seconds(*disagreement)));
  for (const Process& p : processes_) {
    if (p.running() && now_ < p.held_until) return no("somebody still hangs");
  }
  const coordinator::Coordinator& leader = *coordinator();
  for (std::size_t p = kCoordinators; p < twin(); ++p) {
    const protocol::Course& course = processes_[p].agent->course();
    if (course.term != leader.course().term || course.revision != leader.course().revision) {
      return no(text("agent %u flies course %llu.%llu, not %llu.%llu", processes_[p].carrier,
                     protocol::generation(course.term), static_cast<unsigned long long>(course.revision),
                     protocol::generation(leader.course().term),
                     static_cast<unsigned long long>(leader.course().revision)));
    }
  }
  return leader.term() != 0 ? true : no("the coordinator has no term yet");
}

bool Swarm::at_rest() const {
  const auto still = [](const Process& p) { return p.agent && p.agent->course().pace.target() == 0.0; };
  return std::all_of(processes_.begin() + kCoordinators, processes_.begin() + static_cast<std::ptrdiff_t>(twin()),
                     still);
}

FaultCounts Swarm::faults() const {
  FaultCounts out = faults_;
  out.packets = network_.counts;
  return out;
}

}  // namespace gyre::swarm
