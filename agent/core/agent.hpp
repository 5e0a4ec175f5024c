#pragma once
// One carrier's mind: keeps swarm time, holds its plans, and turns time into setpoints. Flies on when alone.
//
// step(now, event) -> outputs; it reads no clock and performs nothing. What it costs does not depend on n.
//
// Duties of whoever performs the outputs: send the time request first and the setpoint next, at once: both carry the
// moment of this step. Call again at `next_tick` at the latest; a call that comes late is not made up for. Judge a
// question beside that beat (plan_judge.hpp), and tell the verdict as an event, however late.

#include <cstdint>
#include <optional>
#include <variant>

#include "agent/core/clock_watch.hpp"
#include "agent/core/merge.hpp"
#include "agent/core/plan_judge.hpp"
#include "agent/core/plan_store.hpp"
#include "agent/core/step_judge.hpp"
#include "common/base/notice.hpp"
#include "common/mechanics/reference.hpp"
#include "common/protocol/age_judge.hpp"
#include "common/protocol/counting.hpp"
#include "common/protocol/incumbent.hpp"
#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"
#include "common/protocol/timekeeper.hpp"

namespace gyre::agent {

struct AgentOptions {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;  ///< differs at every start
  std::string address;            ///< where this process is, for people
  mechanics::Limits vehicle;      ///< what this vehicle can do
  Machines machines;
  Duration control_period = std::chrono::milliseconds(10);
  Duration hurry = std::chrono::milliseconds(5);  ///< instead, from the first beacon on until it knows swarm time
  Duration status_period = std::chrono::milliseconds(100);
  /// While a change is agreed, and until the coordinator has seen that all have begun it, it waits for every word: at
  /// 60 % loss one in ten agents would not be heard in time otherwise. Nor would the lease of many agents grow there.
  Duration status_period_awaited = std::chrono::milliseconds(25);
  Duration awaited = std::chrono::milliseconds(1500);  ///< since a proposal or a new course was first heard
  Duration lossy = std::chrono::milliseconds(300);  ///< since a beacon was missed: what is said here is lost as often
  Duration request_period = std::chrono::milliseconds(125);
  /// An answer waits for a beat of the coordinator and one here, 30 ms: what is not there by then was lost. At 60 %
  /// loss five of six exchanges are, and without asking again it takes half a minute to learn how the clocks drift.
  Duration request_period_unanswered = std::chrono::milliseconds(35);
  /// While it does not know swarm time, it asks on as soon as it was answered: as fast as a crowd can be answered.
  Duration request_period_unanswered_at_start = std::chrono::milliseconds(20);
  Duration coordinator_timeout = std::chrono::milliseconds(500);
  Duration beacon_age_max = std::chrono::milliseconds(300);   ///< and what this clock may be wrong by
  Duration beacon_ahead_max = std::chrono::milliseconds(50);  ///< of the time here, and what that may be wrong by
  Duration doubt = std::chrono::milliseconds(500);            ///< since a beacon that came from the future
  /// A restarted agent waits so long for its vehicle to tell where it is, rather than fly a step.
  Duration vehicle_wait = std::chrono::milliseconds(500);
  /// Who begins where his vehicle is begins where it said so that lately: a word that waited, of a vehicle that was
  /// stopped, is followed by nothing for a while.
  Duration vehicle_fresh = std::chrono::milliseconds(100);
  /// A vehicle that told where it is, and does not any more, is silent. One that never tells is flown all the same.
  Duration vehicle_timeout = std::chrono::seconds(1);
  /// When it tells again: further away than this, it was not only not heard but did not hear either.
  double vehicle_lost_m = 0.05;
  /// Without a tick for so long, it was suspended, and its vehicle may not be where the last setpoint leads any more.
  /// No shorter: on a busy machine the vehicle's states are late as well, and a short silence is bridged without a
  /// step.
  Duration stall = std::chrono::milliseconds(500);
  /// After that it listens so long before it believes where the vehicle is: old states have waited for it. And it says
  /// nothing: who hears a setpoint somewhere else after a silence does not take it for a step.
  Duration backlog = std::chrono::milliseconds(150);
  Duration complained = std::chrono::seconds(5);  ///< of a setpoint that was withheld, since the last one
  protocol::TimekeeperOptions timekeeper;
};

struct Tick {
  std::uint64_t undecodable = 0;  ///< samples that never reached the core, so that all that is dropped is counted here
};
struct TimeReplyArrived {
  protocol::TimeReply reply;
  LocalTime arrived{};
};
/// With the moment of its arrival, by which the clock here is watched. Without one it is taken as it is.
template <class Message>
struct Heard {
  Message message;
  LocalTime arrived{};
};
using Event = std::variant<Tick, protocol::Beacon, protocol::PlanOffer, TimeReplyArrived, protocol::CarrierState,
                           PlanVerdict, Heard<protocol::Beacon>, Heard<protocol::CarrierState>>;

struct Outputs {
  std::optional<protocol::TimeRequest> time_request;
  std::optional<protocol::Setpoint> setpoint;
  std::optional<protocol::AgentStatus> status;
  std::optional<protocol::HeldPlans> held;
  std::optional<PlanQuestion> question;  ///< whose verdict is to be told; never a second one before that
  Notices notices;
  LocalTime next_tick{};
};

class Agent {
 public:
  explicit Agent(const AgentOptions& options);

  Outputs step(LocalTime now, const Event& event);

  [[nodiscard]] const protocol::DropCounts& dropped() const { return dropped_; }
  [[nodiscard]] const protocol::Course& course() const { return course_; }  ///< what it flies
  /// What keeps it from its work: nobody to follow, a clock beyond the plan's budget, a vehicle that went silent.
  /// Absent: nothing does.
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  /// A course of so many changes later is believed at once, and an offer's number remembered: more are not agreed in
  /// the seconds that anybody misses.
  static constexpr std::uint64_t kFurthestRevision = 16;
  static constexpr std::uint64_t kFurthestOffer = 100;

  void on(LocalTime now, const Tick& tick, Outputs& out);
  void on(LocalTime now, const protocol::Beacon& beacon, Outputs& out);
  void on(LocalTime now, const protocol::PlanOffer& offer, Outputs& out);
  void on(LocalTime now, const TimeReplyArrived& arrived, Outputs& out);
  void on(LocalTime now, const protocol::CarrierState& state, Outputs& out);
  void on(LocalTime now, const PlanVerdict& verdict, Outputs& out);
  void on(LocalTime now, const Heard<protocol::Beacon>& heard, Outputs& out);
  void on(LocalTime now, const Heard<protocol::CarrierState>& heard, Outputs& out);

  /// Whether what the clock here shows may be wrong by a leap: then nothing is done by it that cannot be undone.
  [[nodiscard]] bool doubts_clock(LocalTime now) const;
  /// What this clock is suspected to have leapt by, of an exchange that can tell.
  [[nodiscard]] std::optional<Duration> suspected_before(const protocol::Exchange& exchange) const;
  /// Whether swarm time, as it was read here when the reply `arrived`, is what the exchange says.
  [[nodiscard]] static bool refutes(const protocol::Exchange& exchange, SwarmTime arrived, Duration leap);
  void leapt(LocalTime now, Duration by, const std::optional<Command>& flown, Outputs& out);
  [[nodiscard]] Duration request_period(LocalTime now) const;
  [[nodiscard]] bool accepts_term(std::uint64_t term, Outputs& out);
  void send(LocalTime now, const protocol::Setpoint& setpoint, Outputs& out);
  void take_early_offer(LocalTime now, Outputs& out);
  void tell_plans(LocalTime now, Outputs& out);
  void adopt(LocalTime now, Outputs& out);
  /// Whether to fly `course` from now on; it begins where the carrier is.
  [[nodiscard]] bool merge_to(LocalTime now, const protocol::Course& course);
  /// Another agent of this carrier is believed: this one follows nothing, until that one is gone.
  void give_way();
  [[nodiscard]] bool back_at_the_vehicle(LocalTime now);
  [[nodiscard]] Duration age_of(const protocol::CarrierState& state, LocalTime now, bool after_silence,
                                bool of_another);
  /// Says nothing until it has heard anew where the vehicle is.
  void listen(LocalTime now);
  void begin_at_the_vehicle(LocalTime now, const Path& path);
  /// Whether the vehicle says that it follows another agent.
  [[nodiscard]] bool led_by_another(LocalTime now) const;
  /// Whether the vehicle is too far from what it was asked for to have heard it.
  [[nodiscard]] bool is_lost(LocalTime now) const;
  /// Of a course whose plans are held; lives no longer than the course.
  [[nodiscard]] Path path(const protocol::Course& course) const;
  [[nodiscard]] bool confirms(const protocol::Course& proposal) const;
  [[nodiscard]] std::optional<mechanics::Reference> reference(const protocol::Course& course, SwarmTime now) const;
  [[nodiscard]] protocol::Setpoint setpoint(SwarmTime now, const mechanics::Reference& reference);
  [[nodiscard]] protocol::AgentStatus status(LocalTime now);
  [[nodiscard]] protocol::AgentState state(LocalTime now) const;
  [[nodiscard]] std::optional<SwarmTime> swarm_time(LocalTime now) const;

  AgentOptions options_;
  protocol::Timekeeper clock_;
  ClockWatch watch_;
  PlanStore plans_;
  std::uint64_t offers_taken_ = 0;                  ///< the newest offer of this term
  std::optional<protocol::PlanOffer> early_offer_;  ///< of a term that is not believed yet: none is said twice
  std::vector<protocol::NumberedSlice> neighbour_;  ///< kept for the carrier after this one
  Merge merge_;
  StepJudge steps_;
  struct Withheld {
    LocalTime at;
    std::string why;
  };
  std::optional<Withheld> withheld_;  ///< the last setpoint that was not sent
  protocol::Liveness coordinator_;

  std::uint64_t term_ = 0;
  protocol::TermJudge terms_;
  protocol::SequenceJudge beacons_;  ///< of this term
  protocol::LeapJudge revisions_{kFurthestRevision};
  std::optional<protocol::Beacon> heard_;  ///< the newest beacon of this term: what the coordinator wants
  protocol::Course course_;                ///< what is flown
  std::uint64_t confirmed_ = 0;
  LocalTime awaited_until_ = LocalTime::min();
  bool believed_ = true;  ///< to be the agent of this carrier, by the coordinator
  std::string rival_;     ///< where another one is; empty: there is none
  protocol::Incumbent vehicles_;
  std::optional<protocol::CarrierState> vehicle_;  ///< where the carrier really is
  LocalTime vehicle_heard_{};
  LocalTime vehicle_held_{};  ///< when it was there
  protocol::AgeJudge vehicle_ages_;
  std::optional<LocalTime> unfollowed_since_;  ///< the vehicle says that it follows another agent
  std::optional<LocalTime> wants_vehicle_since_;
  std::optional<LocalTime> stepped_at_;
  std::optional<LocalTime> flown_at_;     ///< the last setpoint, or where the vehicle was when it began
  std::optional<LocalTime> awake_since_;  ///< after it was stopped, or not followed: the vehicle has gone on
  bool seems_lost_ = false;               ///< and that is all that keeps it from speaking
  std::optional<LocalTime> doubted_at_;
  bool contradicted_ = false;  ///< by the last exchange

  std::uint64_t setpoints_ = 0;
  std::uint64_t statuses_ = 0;
  std::uint64_t requests_ = 0;
  std::uint64_t requests_answered_ = 0;
  std::optional<LocalTime> requested_at_;
  std::uint64_t beacons_received_ = 0;
  std::uint64_t beacons_missed_ = 0;
  std::uint64_t undecodable_ = 0;
  protocol::DropCounts dropped_;

  LocalTime next_tick_ = LocalTime::min();  // a clock may well begin below zero
  LocalTime next_status_ = LocalTime::min();
  bool alone_ = false;
};

}  // namespace gyre::agent
