#pragma once
// The swarm's conductor: owns the plans, keeps swarm time, beacons the phase, and agrees transitions with the agents.
//
// step(now, event) -> outputs; it reads no clock and performs nothing. It sends nothing per vehicle per tick: the
// beacon goes to all, plans go out when they change.
//
// How a change is agreed. A plan is offered; every agent certifies its slice and accepts. A transition to it is
// rehearsed (rehearsal.hpp), then proposed in the beacon with its start; every agent confirms; the beacon says go until
// it starts. Whoever has not confirmed in time: the proposal is gone from the beacon, and nothing has happened.
//
// Duties of whoever performs the outputs: send the time reply first and at once, it carries the moment of this step;
// offers go out before the beacon that refers to them.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/notice.hpp"
#include "common/mechanics/carrier_slice.hpp"
#include "common/protocol/messages.hpp"
#include "coordinator/core/fleet.hpp"
#include "coordinator/core/rehearsal.hpp"

namespace gyre::coordinator {

/// What is to be flown.
struct Job {
  std::string name;
  mechanics::Plan plan;
  std::optional<Duration> transition;  ///< absent: the shortest that keeps all limits
};

struct CoordinatorOptions {
  std::uint64_t nonce = 0;         ///< random; makes the terms of two coordinators differ
  bool engage_when_ready = false;  ///< start the motion as soon as every agent has accepted
  Duration beacon_period = std::chrono::milliseconds(20);
  Duration agent_timeout = std::chrono::milliseconds(450);
  Duration listening = std::chrono::milliseconds(1500);  ///< for a swarm that already flies
  Duration lead = std::chrono::milliseconds(600);        ///< from proposal to start
  Duration go_margin = std::chrono::milliseconds(150);   ///< before the start nothing is decided any more
  Duration rehearsal_per_carrier = std::chrono::milliseconds(40);
  Duration shortest_transition = std::chrono::seconds(5);
  int slower_attempts = 4;   ///< a transition that breaks a limit is tried at twice the duration
  int release_attempts = 5;  ///< at shutdown, with agents that do not answer
};

struct Tick {};
struct TimeRequestArrived {
  protocol::TimeRequest request;
  LocalTime arrived{};
};
/// End the flight: back to rest, then finish.
struct Shutdown {};
using Event =
    std::variant<Tick, protocol::AgentStatus, TimeRequestArrived, protocol::Command, protocol::Beacon, Shutdown>;

struct Outcome {
  bool clean = true;
  std::string text;
};

struct Outputs {
  std::optional<protocol::TimeReply> time_reply;
  std::vector<protocol::PlanOffer> offers;
  std::optional<protocol::Beacon> beacon;
  std::vector<protocol::CommandReply> replies;
  Notices notices;
  std::optional<Outcome> finished;  ///< nothing more to do; the process may end
  LocalTime next_tick{};
};

class Coordinator {
 public:
  Coordinator(const Job& job, const CoordinatorOptions& options);

  Outputs step(LocalTime now, const Event& event);

  [[nodiscard]] const protocol::Course& course() const { return course_; }
  [[nodiscard]] std::uint64_t term() const { return term_; }
  [[nodiscard]] const protocol::DropCounts& dropped() const { return dropped_; }

 private:
  /// A change on its way: rehearsed, then proposed, until it is go or given up.
  struct Pending {
    protocol::Transition transition;
    std::optional<Rehearsal> rehearsal;  ///< absent once proposed
    int attempt = 0;
    std::optional<std::uint64_t> command;  ///< to be answered
  };

  void on(LocalTime now, const Tick& tick, Outputs& out);
  void on(LocalTime now, const protocol::AgentStatus& status, Outputs& out);
  void on(LocalTime now, const TimeRequestArrived& arrived, Outputs& out);
  void on(LocalTime now, const protocol::Command& command, Outputs& out);
  void on(LocalTime now, const protocol::Beacon& beacon, Outputs& out);
  void on(LocalTime now, const Shutdown& shutdown, Outputs& out);

  void open(LocalTime now, Outputs& out);
  void take_term(LocalTime now, std::uint64_t above, Outputs& out);
  void watch_agents(LocalTime now, Outputs& out);
  void drive(LocalTime now, Outputs& out);
  void begin(LocalTime now, const protocol::PlanNumber& to, std::optional<std::uint64_t> command);
  void rehearse(LocalTime now);
  void propose(LocalTime now, Outputs& out);
  void settle_proposal(LocalTime now, Outputs& out);
  void give_up(const std::string& why, Outputs& out);
  void offer_plans(Outputs& out) const;

  [[nodiscard]] SwarmTime swarm_time(LocalTime now) const { return SwarmTime(now.time_since_epoch() + swarm_offset_); }
  [[nodiscard]] protocol::PlanNumber destination() const;
  [[nodiscard]] std::optional<std::string> refusal_of(const protocol::PlanNumber& plan) const;
  [[nodiscard]] const char* plan_name(const protocol::PlanNumber& plan) const;

  Job job_;
  CoordinatorOptions options_;
  std::vector<CarrierId> carriers_;
  Fleet fleet_;
  Duration swarm_offset_{};  ///< swarm time − this process's clock

  std::uint64_t term_ = 0;  ///< 0 while still listening
  std::uint64_t sequence_ = 0;
  std::uint64_t last_transition_ = 0;
  protocol::PlanNumber rest_;
  protocol::PlanNumber motion_;
  std::map<protocol::PlanNumber, std::vector<mechanics::CarrierSlice>> plans_;  ///< slices in the order of carriers_
  protocol::Course course_;
  std::optional<Pending> pending_;

  std::optional<LocalTime> listening_since_;
  LocalTime next_tick_{};
  LocalTime retry_at_{};
  bool engage_ = false;
  bool shutting_down_ = false;
  int release_failures_ = 0;
  bool refusal_told_ = false;
  protocol::DropCounts dropped_;
};

}  // namespace gyre::coordinator
