#pragma once
// The swarm's conductor: owns the plans, keeps swarm time, beacons the phase, and agrees transitions with the agents.
//
// step(now, event) -> outputs; it reads no clock and performs nothing. It sends nothing per vehicle per tick: the
// beacon goes to all, plans go out when they change.
//
// Everything that ever changes is a transition to another plan (agreement.hpp): engage to the motion, release to rest,
// retune to a new motion, freeze to the static plan of one moment. A transition that turns out not to be known to
// everybody when it starts is turned back by another one on top of it: the smooth step makes that cost almost nothing.
//
// Duties of whoever performs the outputs: send the time reply first and at once, it carries the moment of this step;
// offers go out before the beacon that refers to them.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/notice.hpp"
#include "common/base/result.hpp"
#include "common/mechanics/plan.hpp"
#include "common/protocol/agent_loss.hpp"
#include "common/protocol/messages.hpp"
#include "coordinator/core/agreement.hpp"
#include "coordinator/core/fleet.hpp"
#include "coordinator/core/plan_book.hpp"
#include "coordinator/core/readiness.hpp"
#include "coordinator/core/recovery.hpp"

namespace gyre::coordinator {

/// What is to be flown; its plan is admissible (mechanics/certificate.hpp).
struct Job {
  std::string name;
  mechanics::Plan plan;
  std::optional<Duration> transition;  ///< absent: shortest_transition, doubled until it keeps all limits
  protocol::AgentLoss on_agent_loss = protocol::AgentLoss::kFreeze;
};

struct CoordinatorOptions {
  std::uint64_t nonce = 0;         ///< random; makes the terms of two coordinators differ
  bool engage_when_ready = false;  ///< start the motion as soon as every agent has accepted
  Duration beacon_period = std::chrono::milliseconds(20);
  Duration status_period = std::chrono::milliseconds(500);
  Duration agent_timeout = std::chrono::milliseconds(450);    ///< an agent is named silent
  Duration loss_timeout = std::chrono::seconds(1);            ///< a silent agent is lost, and the policy acts
  Duration listening = std::chrono::milliseconds(1500);       ///< to a swarm that already flies, since its first word
  Duration listening_least = std::chrono::milliseconds(350);  ///< to it, even when all was said: a few words of each
  Duration shortest_transition = std::chrono::seconds(5);
  Duration freezing = std::chrono::seconds(2);
  Duration turning_back = std::chrono::seconds(2);
  Duration start_check = std::chrono::milliseconds(300);  ///< after a start, to see that everybody follows
  Duration patience = std::chrono::seconds(1);            ///< with complaints that are only late, before they are told
  /// How far a vehicle goes on along its path after its last setpoint (simulator: 1 s, then 2 s to rest).
  Duration coasting = std::chrono::seconds(2);
  AgreementOptions agreement;
  int release_attempts = 5;  ///< at shutdown, with agents that do not answer
};

struct Tick {};
struct TimeRequestArrived {
  protocol::TimeRequest request;
  LocalTime arrived{};
};
/// A retune whose mission was read and certified outside: the job, or why there is none.
struct Retune {
  std::uint64_t command = 0;
  Result<Job> job;
};
/// End the flight: back to rest, then finish.
struct Shutdown {};
using Event = std::variant<Tick, protocol::AgentStatus, protocol::HeldPlans, TimeRequestArrived, protocol::Command,
                           Retune, protocol::Beacon, protocol::Health, Shutdown>;

struct Outcome {
  bool clean = true;
  std::string text;
};

struct Outputs {
  std::optional<protocol::TimeReply> time_reply;
  std::vector<protocol::PlanOffer> offers;
  std::optional<protocol::Beacon> beacon;
  std::optional<protocol::CoordinatorStatus> status;
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
  /// What keeps it from its work: who is not heard, or clocks that may disagree too far. Absent: nothing does.
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  void on(LocalTime now, const Tick& tick, Outputs& out);
  void on(LocalTime now, const protocol::AgentStatus& status, Outputs& out);
  void on(LocalTime now, const protocol::HeldPlans& held, Outputs& out);
  void on(LocalTime now, const TimeRequestArrived& arrived, Outputs& out);
  void on(LocalTime now, const protocol::Command& command, Outputs& out);
  void on(LocalTime now, const Retune& retune, Outputs& out);
  void on(LocalTime now, const protocol::Beacon& beacon, Outputs& out);
  void on(LocalTime now, const protocol::Health& health, Outputs& out);
  void on(LocalTime now, const Shutdown& shutdown, Outputs& out);

  [[nodiscard]] bool heard_before(std::uint64_t command, Outputs& out);
  void answer(std::uint64_t command, bool done, const std::string& text, Outputs& out);
  void listen(LocalTime now, Outputs& out);
  void take_term(LocalTime now, Outputs& out);
  [[nodiscard]] std::vector<CarrierId> unheard() const;
  void watch_agents(LocalTime now, Outputs& out);
  void check_start(LocalTime now, Outputs& out);
  void drive(LocalTime now, Outputs& out);
  void freeze(LocalTime now, SwarmTime moment, bool rehearsed, std::optional<std::uint64_t> command, Outputs& out);
  void begin(LocalTime now, Intent intent);
  void pursue(LocalTime now, Outputs& out);
  void go(Outputs& out);
  void give_up(LocalTime now, const std::string& why, Outputs& out);
  void undo_retune();
  void stand_down(const std::string& why, Outputs& out);

  [[nodiscard]] SwarmTime swarm_time(LocalTime now) const { return SwarmTime(now.time_since_epoch() + swarm_offset_); }
  [[nodiscard]] protocol::PlanNumber destination() const;
  [[nodiscard]] std::vector<mechanics::TimedLayer> layers(CarrierId carrier, const protocol::Course& course,
                                                          SwarmTime origin) const;
  [[nodiscard]] std::vector<CarrierId> lost(LocalTime now) const;
  [[nodiscard]] bool cut_off(LocalTime now) const;
  [[nodiscard]] std::vector<CarrierId> unconfirmed(LocalTime now) const;
  [[nodiscard]] std::vector<CarrierId> without_base(LocalTime now) const;
  [[nodiscard]] std::optional<std::string> refusal_of(const protocol::PlanNumber& plan) const;
  [[nodiscard]] std::optional<std::string> obstacle(LocalTime now, const protocol::PlanNumber& to) const;
  [[nodiscard]] Duration skew_budget(const protocol::PlanNumber& plan) const;
  [[nodiscard]] Duration skew(LocalTime now) const;
  [[nodiscard]] bool moves(const protocol::PlanNumber& plan) const;
  [[nodiscard]] bool moving() const;
  [[nodiscard]] bool room_for_transition() const;
  [[nodiscard]] Intent intent_to(const protocol::PlanNumber& to, std::optional<std::uint64_t> command) const;
  [[nodiscard]] std::vector<protocol::PlanNumber> plans_in_use() const;
  [[nodiscard]] protocol::CoordinatorStatus status(LocalTime now) const;
  void offer_plans(Outputs& out) const;
  void tell(Outputs& out, Notice::Level level, const std::string& text);

  Job job_;
  CoordinatorOptions options_;
  std::vector<CarrierId> carriers_;
  Fleet fleet_;
  Readiness readiness_;
  Recovery recovery_;
  PlanBook plans_;
  Duration swarm_offset_{};     ///< swarm time − this process's clock
  Duration budget_in_force_{};  ///< clock disagreement that the plan in force allows; 0: any

  std::uint64_t term_ = 0;  ///< 0 while still listening
  std::uint64_t sequence_ = 0;
  std::uint64_t last_transition_ = 0;
  protocol::PlanNumber rest_;
  protocol::PlanNumber motion_;
  struct Mission {
    Job job;
    protocol::PlanNumber rest, motion;
  };
  std::optional<Mission> before_retune_;  ///< what is flown again if the retune that is being agreed is given up
  protocol::Course course_;
  std::optional<Agreement> agreement_;
  std::vector<CarrierId> not_asked_;       ///< lost when the agreement began
  std::optional<std::uint64_t> starting_;  ///< transition whose start is still to be checked

  std::optional<LocalTime> listening_since_;
  std::optional<LocalTime> recovering_since_;  ///< the first word of a swarm that flies
  std::optional<LocalTime> heard_nobody_at_;   ///< the last time that everybody was silent
  LocalTime term_since_{};
  LocalTime next_tick_ = LocalTime::min();  // a clock may well begin below zero
  LocalTime next_status_ = LocalTime::min();
  LocalTime retry_at_ = LocalTime::min();
  std::optional<LocalTime> not_ready_since_;  ///< all agents are, and somebody complains
  bool engage_ = false;
  bool frozen_for_loss_ = false;  ///< the loss that there is has been acted on
  bool shutting_down_ = false;
  int release_failures_ = 0;
  std::string news_;
  std::optional<std::uint64_t> last_command_;  ///< senders say a command again until it is answered
  std::optional<protocol::CommandReply> last_reply_;
  protocol::DropCounts dropped_;
};

/// Why a flight of `flown` cannot be retuned to `wanted`: another load, other carriers. Absent: it can.
[[nodiscard]] std::optional<std::string> retune_obstacle(const mechanics::Plan& flown, const mechanics::Plan& wanted);

}  // namespace gyre::coordinator
