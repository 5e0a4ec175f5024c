#pragma once
// The swarm's conductor: owns the plans, keeps swarm time, beacons the phase, and agrees changes with the agents.
//
// step(now, event) -> outputs; it reads no clock and performs nothing. It sends nothing per vehicle per tick: the
// beacon goes to all, plans go out when they change.
//
// It is in one of two states. It *listens*: a swarm may fly already, and then everything is learned from the agents
// (recovery.hpp). And it *leads* (leading.hpp).
//
// Duties of whoever performs the outputs: send the time reply first and at once, it carries the moment of this step;
// offers go out before the beacon that refers to them.

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/protocol/counting.hpp"
#include "coordinator/core/leading.hpp"
#include "coordinator/core/recovery.hpp"

namespace gyre::coordinator {

struct Tick {};
/// What tells the time tells it of when it arrived: until the next beat it waits for up to 20 ms.
struct StatusArrived {
  protocol::AgentStatus status;
  LocalTime arrived{};
};
struct TimeRequestArrived {
  protocol::TimeRequest request;
  LocalTime arrived{};
};
/// End the flight: to rest, then finish.
struct Shutdown {};
using Event = std::variant<Tick, StatusArrived, protocol::HeldPlans, TimeRequestArrived, protocol::Command, Retune,
                           protocol::Beacon, protocol::Health, protocol::CarrierState, Shutdown>;

class Coordinator {
 public:
  Coordinator(const Job& job, const CoordinatorOptions& options);
  Coordinator(const Coordinator&) = delete;  // who leads refers to the swarm beside it
  Coordinator& operator=(const Coordinator&) = delete;

  Outputs step(LocalTime now, const Event& event);

  /// 0 while it listens.
  [[nodiscard]] std::uint64_t term() const { return leading_ ? leading_->term() : 0; }
  /// While it leads.
  [[nodiscard]] const protocol::Course& course() const { return leading_ ? leading_->course() : kNoCourse; }
  [[nodiscard]] const protocol::DropCounts& dropped() const { return dropped_; }
  /// What keeps it from its work: who is not heard, or clocks that may disagree too far. Absent: nothing does.
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  void on(LocalTime now, const Tick& tick, Outputs& out);
  void on(LocalTime now, const StatusArrived& event, Outputs& out);
  void on(LocalTime now, const protocol::HeldPlans& held, Outputs& out);
  void on(LocalTime now, const TimeRequestArrived& arrived, Outputs& out);
  void on(LocalTime now, const protocol::Command& command, Outputs& out);
  void on(LocalTime now, const Retune& retune, Outputs& out);
  void on(LocalTime now, const protocol::Beacon& beacon, Outputs& out);
  void on(LocalTime now, const protocol::Health& health, Outputs& out);
  void on(LocalTime now, const protocol::CarrierState& state, Outputs& out);
  void on(LocalTime now, const Shutdown& shutdown, Outputs& out);

  void listen(LocalTime now, Outputs& out);
  /// For swarm time, or for its plan.
  [[nodiscard]] bool somebody_waits(LocalTime now) const;
  void stand_down(const std::string& why, Outputs& out);
  /// Of somebody who has heard of a later term, or leads in one; false: that is nonsense as yet, and counted.
  [[nodiscard]] bool believes(std::uint64_t term);

  static const protocol::Course kNoCourse;

  /// What is known while it listens; gone as soon as it leads.
  struct Listening {
    Recovery recovery;
    std::optional<LocalTime> since;
    std::optional<LocalTime> recovering_since;  ///< the first word of a swarm that flies
    LocalTime looked{};                         ///< when it last did, since then
  };

  Job job_;
  CoordinatorOptions options_;
  Swarm swarm_;
  protocol::TermJudge terms_;
  News news_;
  std::optional<Listening> listening_ = Listening{};  // either this
  std::optional<Leading> leading_;                    // or that
  LocalTime next_tick_ = LocalTime::min();            // a clock may well begin below zero
  bool hurries_ = false;
  protocol::DropCounts dropped_;
};

}  // namespace gyre::coordinator
