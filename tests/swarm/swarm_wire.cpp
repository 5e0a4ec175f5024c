// How messages travel between the processes of a virtual swarm, and what the mains would do with what the cores say.

#include <algorithm>

#include "common/base/text.hpp"
#include "tests/swarm/swarm.hpp"
#include "tests/swarm/swarm_parts.hpp"

namespace gyre::swarm {

namespace {

/// A reader asks again for what it knows to have missed (docs/interop.md "Delivery").
constexpr Duration kHeartbeat = std::chrono::milliseconds(35);
constexpr Duration kSupervisor = std::chrono::seconds(1);
/// A change is agreed in less.
constexpr Duration kLate = std::chrono::milliseconds(450);
/// More never waits of one topic at a process that does not read: the middleware keeps the newest few.
constexpr std::ptrdiff_t kWaitingOfOneKind = 4;

}  // namespace

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
  const Process& source = processes_[channel.from];
  if (source.suspended && now_ < source.held_until) {
    return schedule({source.held_until, 0, Happening::kRetry, index, channel.version, nullptr});
  }
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
  protocol::Command order;
  order.id = ++commands_sent_;
  order.kind = kind;
  const Message message{order};
  for (std::size_t c = 0; c < kCoordinators; ++c) {
    if (processes_[c].running()) arrive(c, message);
  }
}

void Swarm::do_as_told() {
  for (std::size_t c = 0; c < kCoordinators; ++c) {
    if (!processes_[c].running() || processes_[c].coordinator->term() == 0) continue;
    const auto complaint = processes_[c].coordinator->complaint(local(c));
    if (complaint && complaint->find("engage, and") != std::string::npos &&
        !processes_[c].coordinator->course().wish.pace) {
      command(protocol::CommandKind::kEngage);
    }
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
  const std::size_t index = vehicle_of(process);
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
  const std::size_t index = vehicle_of(process);
  Vehicle& vehicle = vehicles_[index];
  if (out.time_request) {
    const auto message = std::make_shared<const Message>(Message{*out.time_request});
    for (std::size_t c = 0; c < kCoordinators; ++c) send(process, c, message);
  }
  using Heard = protocol::Incumbent::Verdict;
  if (out.setpoint) {
    const Heard heard = vehicle.hears(now_, *out.setpoint);
    if (heard == Heard::kRival) ++faults_.rivals_unheard;
    if (heard != Heard::kRival || sabotage_.vehicles_follow_anybody) {
      if (heard == Heard::kSucceeds) checkers_.begins(index);
      const protocol::Setpoint flown = vehicle.realised(*out.setpoint);
      checkers_.setpoint(index, now_, flown, vehicle_state(index));
      vehicle.command(now_, flown);
      processes_[process].sends_setpoints = true;
    }
  }
  if (out.status) {
    if (process != twin()) checkers_.status(index, now_, *out.status);
    vehicle.learn(now_, *out.status);
    const auto message = std::make_shared<const Message>(Message{*out.status});
    for (std::size_t c = 0; c < kCoordinators; ++c) write(channel(Channel::kStatus, c, process), message);
  }
  if (out.held) {
    vehicle.learn(*out.held);
    const auto message = std::make_shared<const Message>(Message{*out.held});
    for (std::size_t c = 0; c < kCoordinators; ++c) write(channel(Channel::kHeld, c, process), message);
  }
  if (out.question) {
    const Duration takes = from_seconds(seconds(scenario_.judging) * judging_.uniform());
    if (takes > kLate) ++faults_.late_verdicts;
    const auto verdict = std::make_shared<const Message>(Message{agent::judge(*out.question)});
    schedule({now_ + takes, 0, Happening::kArrival, process, processes_[process].life, verdict});
  }
  for (const Notice& notice : out.notices) {
    if (notice.text.find("found anew") != std::string::npos) {
      ++faults_.found_anew;
      checkers_.found_anew(index, now_);
    }
    say([&] { return processes_[process].name(process) + ": " + notice.text; });
  }
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
  const auto agents_of = [this](CarrierId carrier) {
    std::vector<std::size_t> those{process_of(carrier)};
    if (processes_[twin()].carrier == carrier) those.push_back(twin());
    return those;
  };
  if (out.time_reply) {
    protocol::TimeReply reply = *out.time_reply;
    if (network_.chance(network_.weather.lies)) {
      ++network_.counts.lies;
      checkers_.lies_told();
      lie(network_.random(), reply);
    }
    for (const std::size_t p : agents_of(reply.carrier))
      send(process, p, std::make_shared<const Message>(Message{reply}));
  }
  for (const protocol::PlanOffer& offer : out.offers) {
    for (const std::size_t p : agents_of(offer.carrier)) {
      write(channel(Channel::kPlan, process, p), std::make_shared<const Message>(Message{offer}));
    }
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

void Swarm::watch_course(std::size_t process) {
  const protocol::Course& course = processes_[process].coordinator->course();
  if (!kill_after_start_ || course.none() || course.revision == last_watched_revision_) return;
  last_watched_revision_ = course.revision;
  const SwarmTime here = SwarmTime(local(process).time_since_epoch());
  const SwarmTime start = course.pace.ramps.back().start;
  if (start <= here) return;
  const TrueTime at = std::max(now_, now_ + (start - here) + *kill_after_start_);
  kill_after_start_.reset();
  schedule({at, 0, Happening::kKill, process, 0, nullptr});
}

}  // namespace gyre::swarm
