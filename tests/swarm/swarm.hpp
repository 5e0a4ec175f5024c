#pragma once
// A whole swarm in one process: real cores of coordinators and agents, on virtual time, over a virtual wire.
//
// Nothing here decides anything for a core; it performs what the mains perform: it brings messages, calls at next_tick,
// and sends what comes out, in the order the cores ask for. True time only moves from one happening to the next.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/core/agent.hpp"
#include "coordinator/core/coordinator.hpp"
#include "tests/swarm/checkers.hpp"
#include "tests/swarm/network.hpp"
#include "tests/swarm/scenario.hpp"
#include "tests/swarm/vehicle.hpp"

namespace gyre::swarm {

/// How many of each fault really happened, beside the packets' own counts.
struct FaultCounts {
  PacketCounts packets;
  std::uint64_t agents_killed = 0, coordinators_killed = 0, killed_in_change = 0, suspended = 0, stalled = 0;
  std::uint64_t partitions = 0, second_coordinators = 0, stood_down = 0, stood_down_alone = 0;
  std::uint64_t commands = 0, retunes = 0, unflyable = 0;
  std::uint64_t twins = 0, rivals_unheard = 0, second_worlds = 0;
  std::uint64_t late_verdicts = 0;
  std::uint64_t losses_named = 0, leases_ended = 0, stuck = 0, turned_back = 0, clock_stops = 0, clock_leaps = 0,
                found_anew = 0;
};

/// Ways to break a swarm on purpose, to see that the judges notice. Empty ones change nothing.
struct Sabotage {
  std::function<void(std::size_t agent, TrueTime, agent::Event&)> agent_hears;
  std::function<void(std::size_t agent, TrueTime, agent::Outputs&)> agent_says;
  std::function<void(std::size_t coordinator, TrueTime, coordinator::Outputs&)> coordinator_says;
  std::function<bool(std::size_t coordinator)> coordinator_is_deaf;  ///< to other coordinators' beacons
  std::function<Duration(std::size_t process, TrueTime)> clock_error;
  bool vehicles_follow_anybody = false;
  bool vehicles_do_not_tell_whom = false;
  std::optional<double> vehicles_lag_by_s;  ///< whatever their agents know
};

struct Process;
struct Message;
struct Happening;
struct Channel;

class Swarm {
 public:
  using Trace = std::function<void(TrueTime, const std::string&)>;

  Swarm(const Scenario& scenario, const Sabotage& sabotage, Trace trace);
  ~Swarm();

  /// Everything up to this moment.
  void run_until(TrueTime until);
  [[nodiscard]] TrueTime now() const { return now_; }

  /// From the ground, to whichever coordinators live; reliable.
  void command(protocol::CommandKind kind);
  void shut_down();
  /// As a person would who reads what the coordinator complains of, where only a person may.
  void do_as_told();

  // What an observer may ask.
  [[nodiscard]] std::size_t coordinators_alive() const;
  [[nodiscard]] const coordinator::Coordinator* coordinator() const;  ///< the one that lives, if one does
  [[nodiscard]] bool agrees(Duration clock_bound, std::string* why) const;
  [[nodiscard]] bool at_rest() const;
  [[nodiscard]] bool merged() const { return !checkers_.anybody_merging(); }
  /// Whether the wire is good and everybody there, so that a loss has to be named in time.
  [[nodiscard]] bool untroubled() const;
  [[nodiscard]] std::optional<coordinator::Outcome> last_outcome() const { return last_outcome_; }
  [[nodiscard]] const std::vector<protocol::CommandReply>& replies() const { return replies_; }

  [[nodiscard]] Checkers& checkers() { return checkers_; }
  [[nodiscard]] FaultCounts faults() const;

 private:
  using MessagePointer = std::shared_ptr<const Message>;

  [[nodiscard]] bool is_agent(std::size_t process) const { return process >= kCoordinators; }
  /// One more agent, of any of the carriers, which lives only by mistake: the last process.
  [[nodiscard]] std::size_t twin() const { return kCoordinators + load_.size(); }
  [[nodiscard]] std::size_t vehicle_of(std::size_t process) const;
  [[nodiscard]] std::size_t channel(std::size_t kind, std::size_t coordinator, std::size_t agent) const {
    return (kind * kCoordinators + coordinator) * (load_.size() + 1) + agent - kCoordinators;
  }
  [[nodiscard]] std::size_t process_of(CarrierId carrier) const { return process_of_[carrier]; }
  void schedule(Happening happening);
  void happen(const Happening& happening);
  void act(const Action& action);
  void observe();

  void start(std::size_t process);
  void kill(std::size_t process);
  void joined(std::size_t process);
  void hold(std::size_t process, Duration length, bool suspended);
  void release(std::size_t process);
  void wake(std::size_t process);

  void send(std::size_t from, std::size_t to, const MessagePointer& message);
  void send_broken(std::size_t from, std::size_t to, const Message& message);
  void write(std::size_t channel, const MessagePointer& message);
  void attempt(std::size_t channel, bool again);
  void arrive(std::size_t process, const Message& message);
  void hand_over(std::size_t process, const Message& message, LocalTime stamped);
  void step_agent(std::size_t process, agent::Event event);
  void step_coordinator(std::size_t process, const coordinator::Event& event);
  void perform(std::size_t process, const agent::Outputs& out);
  void perform(std::size_t process, const coordinator::Outputs& out);
  void watch_course(std::size_t process);
  void watch_losses();
  void tell_vehicle_states();
  void show_to_coordinators(std::size_t process);
  void tell_of_the_second_world();
  void hear_notice(const std::string& notice);
  [[nodiscard]] Duration clock_error(std::size_t process) const;
  [[nodiscard]] LocalTime local(std::size_t process);
  [[nodiscard]] coordinator::Job job(std::size_t motion) const;
  [[nodiscard]] protocol::CarrierState vehicle_state(std::size_t agent);
  template <class T>
  void say(T&& what) {
    if (trace_) trace_(now_, what());
  }

  Scenario scenario_;
  const LoadWithMotions& load_;
  Sabotage sabotage_;
  Trace trace_;
  Network network_;
  Checkers checkers_;
  int beginnings_ = 0;  ///< of the flight, by any coordinator
  FaultCounts faults_;
  TrueTime now_{};
  std::uint64_t happenings_made_ = 0;
  std::vector<Happening> heap_;
  std::vector<Process> processes_;
  std::vector<Channel> channels_;
  std::vector<Vehicle> vehicles_;
  std::vector<std::size_t> process_of_;  ///< by carrier id
  std::vector<protocol::CommandReply> replies_;
  std::optional<coordinator::Outcome> last_outcome_;
  std::optional<Duration> kill_after_start_;
  std::uint64_t last_watched_revision_ = 0;
  std::uint64_t commands_sent_ = 0;
  TrueTime second_world_until_{};
  bool healed_ = false;
  bool ending_ = false;
  RandomStream chores_;
  RandomStream judging_;
  TrueTime troubled_until_{};  ///< packets that were held back still arrive
  struct Loss {
    std::size_t process = 0;
    TrueTime at{};
  };
  std::optional<Loss> loss_;  ///< that is to be named
};

}  // namespace gyre::swarm
