#pragma once
// What a swarm is made of, inside.

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "common/base/text.hpp"
#include "tests/swarm/swarm.hpp"

namespace gyre::swarm {

inline constexpr Duration kObservation = std::chrono::milliseconds(20);

struct Message {
  std::variant<protocol::Beacon, protocol::PlanOffer, protocol::HeldPlans, protocol::TimeRequest, protocol::TimeReply,
               protocol::AgentStatus, protocol::CarrierState, protocol::Command, coordinator::Retune,
               coordinator::Shutdown, agent::PlanVerdict>
      content;  ///< the last ones do not cross the wire

  /// As the shells hand it to the cores; absent where no such process listens.
  [[nodiscard]] friend std::optional<agent::Event> for_agent(const Message& message, LocalTime arrived) {
    return std::visit(
        [arrived](const auto& m) -> std::optional<agent::Event> {
          using T = std::decay_t<decltype(m)>;
          if constexpr (std::is_same_v<T, protocol::TimeReply>) {
            return agent::TimeReplyArrived{m, arrived};
          } else if constexpr (std::is_same_v<T, protocol::Beacon> || std::is_same_v<T, protocol::CarrierState>) {
            return agent::Heard<T>{m, arrived};
          } else if constexpr (std::is_constructible_v<agent::Event, T>) {
            return m;
          } else {
            return std::nullopt;
          }
        },
        message.content);
  }
  [[nodiscard]] friend std::optional<coordinator::Event> for_coordinator(const Message& message, LocalTime arrived) {
    return std::visit(
        [arrived](const auto& m) -> std::optional<coordinator::Event> {
          using T = std::decay_t<decltype(m)>;
          if constexpr (std::is_same_v<T, protocol::TimeRequest>) {
            return coordinator::TimeRequestArrived{m, arrived};
          } else if constexpr (std::is_same_v<T, protocol::AgentStatus>) {
            return coordinator::StatusArrived{m, arrived};
          } else if constexpr (std::is_constructible_v<coordinator::Event, T>) {
            return m;
          } else {
            return std::nullopt;
          }
        },
        message.content);
  }
};

/// The same message, broken in a way that no honest process breaks it.
[[nodiscard]] Message garbage(RandomStream& random, const Message& message);

/// Right in form, wrong in content: timestamps that are off by microseconds up to days.
void lie(RandomStream& random, protocol::TimeReply& reply);

struct Happening {
  enum Kind { kAction, kObservation, kTick, kJoin, kArrival, kRetry, kRelease, kKill, kSupervise };
  TrueTime at{};
  std::uint64_t order = 0;
  Kind kind = kAction;
  std::size_t index = 0;     ///< of the action, process or channel
  std::uint64_t number = 0;  ///< the life of the process, or the version in the channel, that it is meant for
  std::shared_ptr<const Message> message;
};

/// A reliable topic from one process to another that keeps the newest sample, for late joiners, too.
struct Channel {
  enum Kind : std::size_t { kPlan, kHeld, kStatus, kKinds };
  std::size_t from = 0, to = 0;
  std::shared_ptr<const Message> latest;
  std::uint64_t version = 0;
};

struct Process {
  explicit Process(const VirtualClock& its_clock) : clock(its_clock) {}
  [[nodiscard]] bool running() const { return agent || coordinator; }
  [[nodiscard]] std::string name(std::size_t index) const {
    return index < kCoordinators ? text("coordinator %zu", index) : text("agent %u", carrier);
  }

  VirtualClock clock;
  Duration jumped{};  ///< by how much its clock did
  CarrierId carrier = 0;
  std::unique_ptr<agent::Agent> agent;
  std::unique_ptr<coordinator::Coordinator> coordinator;
  std::uint64_t life = 0;
  std::uint64_t incarnation = 0;  ///< of the agent
  bool joined = false;
  bool sends_setpoints = false;
  bool known = false;  ///< to a coordinator, which said so
  bool suspended = false;
  TrueTime held_until{};
  TrueTime tick_at{};
  struct Waiting {
    std::shared_ptr<const Message> message;
    LocalTime stamped{};
  };
  std::deque<Waiting> inbox;
};

}  // namespace gyre::swarm
