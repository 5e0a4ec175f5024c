#include "tests/swarm/swarm.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "simulator/core/extrapolation.hpp"
#include "tests/swarm/swarm_parts.hpp"

namespace gyre::swarm {

namespace {

constexpr Duration kObservation = std::chrono::milliseconds(20);
/// A vehicle's state matters only to an agent that does not know it from its own setpoints.
constexpr Duration kLeftAlone = std::chrono::milliseconds(40);
/// Until a new process knows the others, and they it.
constexpr Duration kDiscovery = std::chrono::milliseconds(200);
/// A reader asks again for what it knows to have missed (INTEROP, heartbeat period 20 to 50 ms).
constexpr Duration kHeartbeat = std::chrono::milliseconds(35);
/// After a fault ends, the bounds that hold in calm hold again.
constexpr Duration kAftermath = std::chrono::seconds(1);
/// DESIGN section 3: an agent that falls silent is named within this time.
constexpr Duration kNamedWithin = std::chrono::milliseconds(500);
constexpr Duration kLongestHeldBack = std::chrono::seconds(3);
constexpr Duration kSupervisor = std::chrono::seconds(1);
/// More never waits of one topic at a process that does not read: the middleware keeps the newest few.
constexpr std::ptrdiff_t kWaitingOfOneKind = 4;

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
      network_(scenario.seed, kCoordinators + load_.size()),
      checkers_(load_, scenario_),
      vehicles_(load_.size()),
      process_of_(kMaxCarrierId + 1, 0),
      chores_(scenario.seed, "chores") {
  const std::size_t count = kCoordinators + load_.size();
  for (std::size_t p = 0; p < count; ++p) {
    processes_.emplace_back(VirtualClock(RandomStream(scenario.seed, text("clock %zu", p)), scenario_.clock_offsets[p],
                                         scenario_.clock_drifts[p], scenario_.clock_wander_per_sqrt_s));
    if (!is_agent(p)) continue;
    processes_[p].carrier = load_.motions.front().carriers[p - kCoordinators].id;
    process_of_[processes_[p].carrier] = p;
  }
  for (std::size_t kind = 0; kind < Channel::kKinds; ++kind) {
    for (std::size_t c = 0; c < kCoordinators; ++c) {
      for (std::size_t p = kCoordinators; p < count; ++p) {
        const bool from_agent = kind != Channel::kPlan;
        channels_.push_back({from_agent ? p : c, from_agent ? c : p, kind != Channel::kStatus, nullptr, 0});
      }
    }
  }
  const auto still = mechanics::slices(load_.rest);
  for (std::size_t i = 0; i < still.size(); ++i) {
    const mechanics::Reference r = mechanics::evaluate(still[i], 0.0);
    vehicles_[i].last.position_w_m = r.position_w_m.value;
    vehicles_[i].last.winch_length_m = r.length_m.value - r.tension_n.value / still[i].cable_stiffness_n_m;
  }
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
      if (processes_[h.index].running() && !healed_) {
        ++faults_.killed_in_transition;
        kill(h.index);
      }
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
      checkers_.disturbed(now_ + kAftermath);
      return;
    case Deed::kKill:
      if (!processes_[a.process].running()) return;
      if (is_agent(a.process) && untroubled()) loss_ = Loss{a.process, now_};
      kill(a.process);
      return;
    case Deed::kKillInTransition:
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
      kill_after_start_.reset();
      checkers_.disturbed(now_ + kAftermath);
      for (std::size_t p = kCoordinators; p < processes_.size(); ++p) {
        if (!processes_[p].running()) start(p);
      }
      if (coordinators_alive() == 0) start(0);
      return;
  }
}

void Swarm::observe() {
  schedule({now_ + kObservation, 0, Happening::kObservation, 0, 0, nullptr});
  const Weather& w = network_.weather;
  const bool bad = w.loss > 0.3 || w.bursts_per_s > 0.0 || w.overtaken > 0.0 || w.lies > 0.0 ||
                   !network_.groups.empty() || coordinators_alive() != 1;
  if (bad) checkers_.disturbed(now_ + kAftermath);
  if (bad || w.garbage > 0.0) troubled_until_ = now_ + kLongestHeldBack;
  tell_vehicle_states();
  checkers_.instant(now_);
  watch_losses();
}

// --------------------------------------------------------------------------------------------------- life and death

Duration Swarm::clock_error(std::size_t process) const {
  return sabotage_.clock_error ? sabotage_.clock_error(process, now_) : Duration::zero();
}

LocalTime Swarm::local(std::size_t process) {
  return processes_[process].clock.at(now_) + clock_error(process);
}

coordinator::Job Swarm::job(std::size_t motion) const {
  coordinator::Job job;
  job.name = text("motion %zu", motion);
  job.plan = motion < load_.motions.size() ? load_.motions[motion] : too_fast(load_.motions.front());
  if (!scenario_.rehearse) job.transition = scenario_.transition;  // a rehearsal chooses the duration itself
  job.on_agent_loss = scenario_.on_agent_loss;
  return job;
}

void Swarm::start(std::size_t process) {
  Process& p = processes_[process];
  ++p.life;
  p.joined = false;
  p.held_until = TrueTime{};
  p.inbox.clear();
  p.sends_setpoints = false;
  checkers_.disturbed(now_ + kAftermath);
  say([&] { return p.name(process) + " starts"; });
  if (is_agent(process)) {
    agent::AgentOptions options;
    options.carrier = p.carrier;
    options.incarnation = chores_.next();
    options.vehicle = load_.vehicle;
    p.agent = std::make_unique<agent::Agent>(options);
    checkers_.begins(process - kCoordinators);
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
    ++faults_.agents_killed;
    checkers_.ends(process - kCoordinators);
  } else {
    ++faults_.coordinators_killed;
  }
  checkers_.disturbed(now_ + kAftermath);
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
    if (!concerned || !channel.retained || !channel.latest) continue;
    ++channel.version;
    attempt(i, false);
  }
}

void Swarm::hold(std::size_t process, Duration length, bool suspended) {
  Process& p = processes_[process];
  p.held_until = now_ + length;
  p.suspended = suspended;
  checkers_.disturbed(p.held_until + kAftermath);
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

// --------------------------------------------------------------------------------------------------------- messages

void Swarm::arrive(std::size_t process, const Message& message) {
  Process& p = processes_[process];
  if (now_ >= p.held_until) return hand_over(process, message, local(process));
  const auto same = [&message](const Process::Waiting& w) {
    return w.message->content.index() == message.content.index();
  };
  if (std::count_if(p.inbox.begin(), p.inbox.end(), same) >= kWaitingOfOneKind) {
    p.inbox.erase(std::find_if(p.inbox.begin(), p.inbox.end(), same));
  }
  p.inbox.push_back({std::make_shared<const Message>(message), local(process)});
}

void Swarm::hand_over(std::size_t process, const Message& message, LocalTime stamped) {
  if (is_agent(process)) {
    if (auto event = for_agent(message, stamped)) step_agent(process, std::move(*event));
  } else {
    const bool deaf = sabotage_.coordinator_is_deaf && sabotage_.coordinator_is_deaf(process);
    if (deaf && std::holds_alternative<protocol::Beacon>(message.content)) return;
    if (auto event = for_coordinator(message, stamped)) step_coordinator(process, *event);
  }
}

void Swarm::send(std::size_t from, std::size_t to, const MessagePointer& message) {
  const Process& target = processes_[to];
  if (!target.running() || !target.joined || !processes_[from].joined) return;
  if (network_.weather.garbage > 0.0 && network_.chance(network_.weather.garbage)) send_broken(from, to, *message);
  const Network::Fate fate = network_.send(now_, from, to);
  for (int copy = 0; copy < fate.copies; ++copy) {
    schedule({now_ + fate.delays[static_cast<std::size_t>(copy)], 0, Happening::kArrival, to, target.life, message});
  }
}

void Swarm::send_broken(std::size_t from, std::size_t to, const Message& message) {
  const Network::Fate fate = network_.send(now_, from, to);
  if (fate.copies == 0) return;
  ++network_.counts.garbage;
  const auto broken = std::make_shared<const Message>(garbage(network_.random(), message));
  schedule({now_ + fate.delays[0], 0, Happening::kArrival, to, processes_[to].life, broken});
}

void Swarm::write(std::size_t channel, const MessagePointer& message) {
  channels_[channel].latest = message;
  ++channels_[channel].version;
  attempt(channel, false);
}

void Swarm::attempt(std::size_t index, bool again) {
  const Channel& channel = channels_[index];
  const Process& target = processes_[channel.to];
  if (!channel.latest || !target.running() || !target.joined || !processes_[channel.from].joined) return;
  if (again && !network_.asked_again(channel.from, channel.to)) {
    return schedule({now_ + kHeartbeat, 0, Happening::kRetry, index, channel.version, nullptr});
  }
  if (network_.weather.garbage > 0.0 && network_.chance(network_.weather.garbage))
    send_broken(channel.from, channel.to, *channel.latest);
  const Network::Fate fate = network_.send(now_, channel.from, channel.to);
  if (fate.copies == 0) return schedule({now_ + kHeartbeat, 0, Happening::kRetry, index, channel.version, nullptr});
  // The middleware drops the second copy of a reliable sample.
  schedule({now_ + fate.delays[0], 0, Happening::kArrival, channel.to, target.life, channel.latest});
}

void Swarm::command(protocol::CommandKind kind) {
  ++faults_.commands;
  const Message message{protocol::Command{++commands_sent_, kind, ""}};
  for (std::size_t c = 0; c < kCoordinators; ++c) {
    if (processes_[c].running()) arrive(c, message);
  }
}

void Swarm::shut_down() {
  ending_ = true;
  for (std::size_t c = 0; c < kCoordinators; ++c) {
    if (processes_[c].running()) arrive(c, Message{coordinator::Shutdown{}});
  }
}

// ----------------------------------------------------------------------------------------------------------- the cores

void Swarm::step_agent(std::size_t process, agent::Event event) {
  Process& p = processes_[process];
  const std::size_t index = process - kCoordinators;
  if (sabotage_.agent_hears) sabotage_.agent_hears(index, now_, event);
  agent::Outputs out = p.agent->step(local(process), event);
  if (sabotage_.agent_says) sabotage_.agent_says(index, now_, out);
  perform(process, out);
  const TrueTime tick = std::max(p.clock.when(out.next_tick - clock_error(process)), now_ + Duration(1));
  if (tick >= p.tick_at && p.tick_at > now_) return;
  p.tick_at = tick;
  schedule({tick, 0, Happening::kTick, process, p.life, nullptr});
}

void Swarm::perform(std::size_t process, const agent::Outputs& out) {
  const std::size_t index = process - kCoordinators;
  const std::size_t n = load_.size();
  if (out.time_request) {
    const auto message = std::make_shared<const Message>(Message{*out.time_request});
    for (std::size_t c = 0; c < kCoordinators; ++c) send(process, c, message);
  }
  if (out.setpoint) {
    checkers_.setpoint(index, now_, *out.setpoint, vehicle_state(index), processes_[process].agent->course());
    vehicles_[index] = {now_, *out.setpoint};
    processes_[process].sends_setpoints = true;
  }
  if (out.status) {
    checkers_.status(index, now_, *out.status);
    const auto message = std::make_shared<const Message>(Message{*out.status});
    for (std::size_t c = 0; c < kCoordinators; ++c) write((Channel::kStatus * kCoordinators + c) * n + index, message);
  }
  if (out.held) {
    const auto message = std::make_shared<const Message>(Message{*out.held});
    for (std::size_t c = 0; c < kCoordinators; ++c) write((Channel::kHeld * kCoordinators + c) * n + index, message);
  }
  for (const Notice& notice : out.notices) say([&] { return processes_[process].name(process) + ": " + notice.text; });
}

void Swarm::step_coordinator(std::size_t process, const coordinator::Event& event) {
  Process& p = processes_[process];
  coordinator::Outputs out = p.coordinator->step(local(process), event);
  if (sabotage_.coordinator_says) sabotage_.coordinator_says(process, now_, out);
  perform(process, out);
  watch_course(process);
  if (out.finished) {
    say([&] { return p.name(process) + " ends: " + out.finished->text; });
    last_outcome_ = out.finished;
    if (!out.finished->clean && !ending_) {
      ++(coordinators_alive() > 1 ? faults_.stood_down : faults_.stood_down_alone);
      schedule({now_ + kSupervisor, 0, Happening::kSupervise, process, 0, nullptr});
    }
    kill(process);
    --faults_.coordinators_killed;
    return;
  }
  const TrueTime tick = std::max(p.clock.when(out.next_tick - clock_error(process)), now_ + Duration(1));
  if (tick >= p.tick_at && p.tick_at > now_) return;
  p.tick_at = tick;
  schedule({tick, 0, Happening::kTick, process, p.life, nullptr});
}

void Swarm::perform(std::size_t process, const coordinator::Outputs& out) {
  const std::size_t n = load_.size();
  if (out.time_reply) {
    protocol::TimeReply reply = *out.time_reply;
    if (network_.chance(network_.weather.lies)) {
      ++network_.counts.lies;
      checkers_.lies_told();
      lie(network_.random(), reply);
    }
    send(process, process_of(reply.carrier), std::make_shared<const Message>(Message{reply}));
  }
  for (const protocol::PlanOffer& offer : out.offers) {
    const std::size_t index = process_of(offer.carrier) - kCoordinators;
    write((Channel::kPlan * kCoordinators + process) * n + index, std::make_shared<const Message>(Message{offer}));
  }
  if (out.beacon) {
    const auto message = std::make_shared<const Message>(Message{*out.beacon});
    for (std::size_t p = 0; p < processes_.size(); ++p) {
      if (p != process) send(process, p, message);
    }
  }
  for (const protocol::CommandReply& reply : out.replies) {
    say([&] {
      return text("reply %llu: ", static_cast<unsigned long long>(reply.id)) + (reply.done ? "done: " : "refused: ") +
             reply.text;
    });
    replies_.push_back(reply);
  }
  for (const Notice& notice : out.notices) {
    hear_notice(notice.text);
    say([&] { return processes_[process].name(process) + ": " + notice.text; });
  }
}

void Swarm::hear_notice(const std::string& notice) {
  const auto tells = [&notice](const std::string& what) { return notice.find(what) != std::string::npos; };
  if (tells("turning back")) ++faults_.turned_back;
  if (tells("freezing where")) ++faults_.frozen_for_loss;
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

void Swarm::watch_course(std::size_t process) {
  if (!kill_after_start_) return;
  for (const protocol::Transition& t : processes_[process].coordinator->course().transitions) {
    if (t.stage != protocol::Stage::kGo || t.id == last_watched_transition_) continue;
    last_watched_transition_ = t.id;
    const SwarmTime here = SwarmTime(local(process).time_since_epoch());
    const TrueTime at = std::max(now_, now_ + (t.start - here) + *kill_after_start_);
    kill_after_start_.reset();
    return schedule({at, 0, Happening::kKill, process, 0, nullptr});
  }
}

// -------------------------------------------------------------------------------------------------------- observation

protocol::CarrierState Swarm::vehicle_state(std::size_t agent) const {
  const Vehicle& v = vehicles_[agent];
  const auto w = simulator::extrapolate(seconds(now_ - v.since));
  protocol::CarrierState s;
  s.carrier = processes_[agent + kCoordinators].carrier;
  s.position_w_m =
      v.last.position_w_m + w.by_velocity * v.last.velocity_w_m_s + w.by_acceleration * v.last.acceleration_w_m_s2;
  s.velocity_w_m_s = w.rate_by_velocity * v.last.velocity_w_m_s + w.rate_by_acceleration * v.last.acceleration_w_m_s2;
  s.winch_length_m = v.last.winch_length_m + w.by_velocity * v.last.winch_rate_m_s;
  s.winch_rate_m_s = w.rate_by_velocity * v.last.winch_rate_m_s;
  s.cable_length_m = s.winch_length_m;
  return s;
}

void Swarm::tell_vehicle_states() {
  for (std::size_t p = kCoordinators; p < processes_.size(); ++p) {
    if (!processes_[p].running() || !processes_[p].joined) continue;
    const Vehicle& vehicle = vehicles_[p - kCoordinators];
    if (processes_[p].sends_setpoints && now_ - vehicle.since < kLeftAlone) continue;
    arrive(p, Message{vehicle_state(p - kCoordinators)});
  }
}

bool Swarm::untroubled() const {
  if (now_ < troubled_until_ || network_.weather.loss > 0.0) return false;
  if (coordinators_alive() != 1 || coordinator()->term() == 0) return false;
  return std::all_of(processes_.begin(), processes_.end(), [this](const Process& p) {
    return (p.carrier == 0 || p.sends_setpoints) && now_ >= p.held_until + kNamedWithin;
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
  for (std::size_t p = kCoordinators; p < processes_.size(); ++p) {
    const protocol::Course& course = processes_[p].agent->course();
    if (course.revision != leader.course().revision || course.base.number != leader.course().base.number) {
      return no(text("agent %u flies another course", processes_[p].carrier));
    }
  }
  return leader.term() != 0 ? true : no("the coordinator has no term yet");
}

bool Swarm::at_rest() const {
  const auto still = [](const Process& p) { return p.agent && p.agent->course().transitions.empty(); };
  return std::all_of(processes_.begin() + kCoordinators, processes_.end(), still);
}

FaultCounts Swarm::faults() const {
  FaultCounts out = faults_;
  out.packets = network_.counts;
  return out;
}

}  // namespace gyre::swarm
