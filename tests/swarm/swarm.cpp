#include "tests/swarm/swarm.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/protocol/follow.hpp"
#include "tests/swarm/swarm_parts.hpp"

namespace gyre::swarm {

namespace {

/// Until a new process knows the others, and they it.
constexpr Duration kDiscovery = std::chrono::milliseconds(200);

struct LaterFirst {
  template <class H>
  bool operator()(const H& a, const H& b) const {
    return a.at != b.at ? a.at > b.at : a.order > b.order;
  }
};

}  // namespace

Swarm::Swarm(const Scenario& scenario, const Sabotage& sabotage, Trace trace)
    : scenario_(scenario),
      load_(loads()[scenario.load]),
      sabotage_(sabotage),
      trace_(std::move(trace)),
      network_(scenario.seed, kCoordinators + load_.size() + 1),
      checkers_(load_, scenario_),
      vehicles_(load_.size()),
      process_of_(kMaxCarrierId + 1, 0),
      chores_(scenario.seed, "chores"),
      judging_(scenario.seed, "judging") {
  for (std::size_t p = 0; p < twin(); ++p) {
    processes_.emplace_back(VirtualClock(RandomStream(scenario.seed, text("clock %zu", p)), scenario_.clock_offsets[p],
                                         scenario_.clock_drifts[p], scenario_.clock_wander_per_sqrt_s));
    if (!is_agent(p)) continue;
    processes_[p].carrier = load_.motions.front().carriers[p - kCoordinators].id;
    process_of_[processes_[p].carrier] = p;
  }
  processes_.emplace_back(VirtualClock(RandomStream(scenario.seed, "clock of the twin"), std::chrono::hours(7), 0.0,
                                       scenario_.clock_wander_per_sqrt_s));
  for (std::size_t kind = 0; kind < Channel::kKinds; ++kind) {
    for (std::size_t c = 0; c < kCoordinators; ++c) {
      for (std::size_t p = kCoordinators; p <= twin(); ++p) {
        const bool from_agent = kind != Channel::kPlan;
        channels_.push_back({from_agent ? p : c, from_agent ? c : p, nullptr, 0});
      }
    }
  }
  const auto still = mechanics::slices(load_.motions.front());
  for (std::size_t i = 0; i < still.size(); ++i) {
    const mechanics::Reference r = mechanics::evaluate(still[i], 0.0);
    protocol::Setpoint rest;
    rest.position_w_m = r.position_w_m.value;
    rest.tension_n = r.tension_n.value;
    rest.winch_length_m = mechanics::paid_out(r, still[i].cable_stiffness_n_m).value;
    vehicles_[i].place(rest);
    vehicles_[i].lags(still[i].winch_lag_s, sabotage_.vehicles_lag_by_s.value_or(still[i].vehicle_lag_s));
  }
  for (const std::size_t agent : scenario_.holding) vehicles_[agent].holds();
  for (std::size_t i = 0; i < scenario_.actions.size(); ++i)
    schedule({scenario_.actions[i].at, 0, Happening::kAction, i, 0, nullptr});
  schedule({TrueTime(kObservation), 0, Happening::kObservation, 0, 0, nullptr});
}

Swarm::~Swarm() = default;

void Swarm::schedule(Happening happening) {
  happening.order = ++happenings_made_;
  heap_.push_back(std::move(happening));
  std::push_heap(heap_.begin(), heap_.end(), LaterFirst{});
}

void Swarm::run_until(TrueTime until) {
  while (!heap_.empty() && heap_.front().at <= until) {
    std::pop_heap(heap_.begin(), heap_.end(), LaterFirst{});
    const Happening happening = std::move(heap_.back());
    heap_.pop_back();
    now_ = happening.at;
    happen(happening);
  }
  now_ = until;
}

void Swarm::happen(const Happening& h) {
  switch (h.kind) {
    case Happening::kAction:
      return act(scenario_.actions[h.index]);
    case Happening::kObservation:
      return observe();
    case Happening::kTick: {
      Process& p = processes_[h.index];
      if (p.running() && h.number == p.life && h.at == p.tick_at) {
        p.tick_at = TrueTime::max();
        if (now_ >= p.held_until) wake(h.index);
      }
      return;
    }
    case Happening::kJoin:
      if (processes_[h.index].running() && processes_[h.index].life == h.number) joined(h.index);
      return;
    case Happening::kArrival: {
      const Process& p = processes_[h.index];
      if (p.running() && p.life == h.number) arrive(h.index, *h.message);
      return;
    }
    case Happening::kRetry:
      if (channels_[h.index].version == h.number) attempt(h.index, true);
      return;
    case Happening::kRelease:
      if (processes_[h.index].running() && processes_[h.index].life == h.number) release(h.index);
      return;
    case Happening::kKill:
      if (!processes_[h.index].running() || healed_) return;
      if (h.index == twin()) {
        if (processes_[h.index].life == h.number) kill(h.index);
        return;
      }
      ++faults_.killed_in_change;
      kill(h.index);
      return;
    case Happening::kSupervise:
      if (!processes_[h.index].running() && coordinators_alive() == 0 && !ending_) start(h.index);
      return;
  }
}

void Swarm::act(const Action& a) {
  if (a.deed != Deed::kCommand && a.deed != Deed::kRetune) loss_.reset();  // from here on nobody promises anything
  say([&] { return "* " + describe(a); });
  switch (a.deed) {
    case Deed::kWeather:
      network_.weather = a.weather;
      return;
    case Deed::kPartition:
      network_.groups = a.groups;
      if (!a.groups.empty()) ++faults_.partitions;
      return;
    case Deed::kKill:
      if (!processes_[a.process].running()) return;
      if (is_agent(a.process) && untroubled() && !processes_[twin()].running()) loss_ = Loss{a.process, now_};
      kill(a.process);
      return;
    case Deed::kKillInChange:
      kill_after_start_ = a.offset;
      return;
    case Deed::kStart:
      if (processes_[a.process].running()) return;
      if (a.process == 1) ++faults_.second_coordinators;
      return start(a.process);
    case Deed::kSuspend:
    case Deed::kStall:
      if (!processes_[a.process].running() || now_ < processes_[a.process].held_until) return;
      ++(a.deed == Deed::kSuspend ? faults_.suspended : faults_.stalled);
      return hold(a.process, a.length, a.deed == Deed::kSuspend);
    case Deed::kClockStop:
      if (!processes_[a.process].running() || now_ < processes_[a.process].held_until) return;
      ++faults_.clock_stops;
      checkers_.clock_stopped(is_agent(a.process) ? std::optional(a.process - kCoordinators) : std::nullopt);
      hold(a.process, a.length, true);
      processes_[a.process].jumped -= a.length;
      return;
    case Deed::kClockLeap: {
      Process& p = processes_[a.process];
      if (!p.running() || now_ < p.held_until) return;
      ++faults_.clock_leaps;
      checkers_.clock_stopped(a.process - kCoordinators);
      checkers_.found_anew(a.process - kCoordinators, now_);  // nobody knows of it before it shows
      p.jumped += a.length;
      // What it waits for is due sooner.
      p.tick_at = std::max(now_ + Duration(1), p.tick_at - a.length);
      schedule({p.tick_at, 0, Happening::kTick, a.process, p.life, nullptr});
      return;
    }
    case Deed::kTwin:
      if (processes_[twin()].running()) return;
      ++faults_.twins;
      processes_[twin()].carrier = processes_[a.process].carrier;
      for (std::size_t c = 0; c < kCoordinators; ++c) {
        channels_[channel(Channel::kPlan, c, twin())].latest = channels_[channel(Channel::kPlan, c, a.process)].latest;
      }
      start(twin());
      schedule({now_ + a.length, 0, Happening::kKill, twin(), processes_[twin()].life, nullptr});
      return;
    case Deed::kSecondWorld:
      ++faults_.second_worlds;
      second_world_until_ = now_ + a.length;
      return tell_vehicle_states();
    case Deed::kCut:
      network_.cuts = a.cuts;
      return;
    case Deed::kCommand:
      return command(a.command);
    case Deed::kRetune: {
      ++(a.motion < load_.motions.size() ? faults_.retunes : faults_.unflyable);
      const auto message =
          std::make_shared<const Message>(Message{coordinator::Retune{++commands_sent_, job(a.motion)}});
      for (std::size_t c = 0; c < kCoordinators; ++c) {
        if (processes_[c].running()) arrive(c, *message);
      }
      return;
    }
    case Deed::kHeal:
      healed_ = true;
      network_.weather = Weather{};
      network_.groups.clear();
      network_.cuts.clear();
      kill_after_start_.reset();
      if (processes_[twin()].running()) kill(twin());
      second_world_until_ = TrueTime{};
      for (std::size_t p = kCoordinators; p < twin(); ++p) {
        if (!processes_[p].running()) start(p);
      }
      if (coordinators_alive() == 0) start(0);
      return;
  }
}

// --------------------------------------------------------------------------------------------------- life and death

Duration Swarm::clock_error(std::size_t process) const {
  return processes_[process].jumped + (sabotage_.clock_error ? sabotage_.clock_error(process, now_) : Duration::zero());
}

LocalTime Swarm::local(std::size_t process) {
  return processes_[process].clock.at(now_) + clock_error(process);
}

coordinator::Job Swarm::job(std::size_t motion) const {
  coordinator::Job job;
  job.name = text("motion %zu", motion);
  job.plan = motion < load_.motions.size() ? load_.motions[motion] : too_fast(load_.motions.front());
  if (!scenario_.rehearse) job.transition = scenario_.transition;  // a rehearsal chooses the duration itself
  job.silence = scenario_.silence;
  return job;
}

void Swarm::start(std::size_t process) {
  Process& p = processes_[process];
  ++p.life;
  p.joined = false;
  p.held_until = TrueTime{};
  p.inbox.clear();
  p.sends_setpoints = p.known = false;
  say([&] { return p.name(process) + " starts"; });
  if (is_agent(process)) {
    agent::AgentOptions options;
    options.carrier = p.carrier;
    options.incarnation = p.incarnation = chores_.next();
    options.vehicle = load_.vehicle;
    p.agent = std::make_unique<agent::Agent>(options);
    if (process != twin()) checkers_.begins(process - kCoordinators);
  } else {
    coordinator::CoordinatorOptions options;
    options.nonce = chores_.next();
    options.engage_when_ready = scenario_.engage_when_ready && !healed_;
    options.agreement.rehearse = scenario_.rehearse;
    p.coordinator = std::make_unique<coordinator::Coordinator>(job(0), options);
  }
  p.tick_at = now_;
  schedule({now_, 0, Happening::kTick, process, p.life, nullptr});
  const Duration discovery = kDiscovery + from_seconds(0.2 * chores_.uniform());
  schedule({now_ + discovery, 0, Happening::kJoin, process, p.life, nullptr});
}

void Swarm::kill(std::size_t process) {
  Process& p = processes_[process];
  say([&] { return p.name(process) + " is dead"; });
  ++p.life;
  p.agent.reset();
  p.coordinator.reset();
  p.inbox.clear();
  if (is_agent(process)) {
    if (process == twin()) loss_.reset();  // who was killed before it may be replaced by it
    if (process != twin()) ++faults_.agents_killed;
    if (vehicles_[vehicle_of(process)].follows(now_) == p.incarnation) checkers_.ends(vehicle_of(process));
    if (process == twin()) p.carrier = 0;
  } else {
    ++faults_.coordinators_killed;
    loss_.reset();  // nobody is left to name it
  }
  for (Channel& channel : channels_) {
    if (channel.from != process) continue;
    channel.latest.reset();
    ++channel.version;
  }
}

void Swarm::joined(std::size_t process) {
  processes_[process].joined = true;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Channel& channel = channels_[i];
    const bool concerned = channel.to == process || channel.from == process;
    if (!concerned || !channel.latest) continue;
    ++channel.version;
    attempt(i, false);
  }
}

void Swarm::hold(std::size_t process, Duration length, bool suspended) {
  Process& p = processes_[process];
  p.held_until = now_ + length;
  p.suspended = suspended;
  schedule({p.held_until, 0, Happening::kRelease, process, p.life, nullptr});
}

void Swarm::release(std::size_t process) {
  Process& p = processes_[process];
  const std::uint64_t life = p.life;
  std::deque<Process::Waiting> waiting;
  waiting.swap(p.inbox);
  for (const Process::Waiting& w : waiting) {
    if (!p.running() || p.life != life) return;
    // A suspended process stamps what waited for it when it reads it at last.
    hand_over(process, *w.message, p.suspended ? local(process) : w.stamped);
  }
  if (p.running() && p.life == life) wake(process);
}

void Swarm::wake(std::size_t process) {
  if (is_agent(process)) {
    step_agent(process, agent::Tick{});
  } else {
    step_coordinator(process, coordinator::Tick{});
  }
}

}  // namespace gyre::swarm
