#pragma once
// An agent's journal: between what its core is made of, told and says, and the entries of common/protocol/journal.hpp.
//
//   kBeginning                                         the agent's options as JSON, so that a person can read them, too
//   kTick                                              how many samples could not be decoded (8), if any
//   kTimeReply, kBeaconArrived, kCarrierStateArrived   when it arrived (8), and the message
//   kVerdict                                           nothing: it is what the core's last question leads to (judge()
//                                                      in plan_judge.hpp)
//   the others                                         the message
//
// Messages are as they cross the wire, so exactly what a node decodes.

#include <cstdint>
#include <optional>

#include "agent/core/agent.hpp"
#include "common/base/result.hpp"
#include "common/protocol/journal.hpp"

namespace gyre::agent {

enum class JournalKind : std::uint8_t {
  kBeginning = 0,
  kTick = 1,
  kBeacon = 2,
  kPlanOffer = 3,
  kTimeReply = 4,
  kCarrierState = 5,
  kVerdict = 6,
  kBeaconArrived = 7,
  kCarrierStateArrived = 8,
};

/// Which outputs came of a step: JournalEntry::said.
struct Said {
  static constexpr std::uint8_t kTimeRequest = 1;
  static constexpr std::uint8_t kSetpoint = 2;
  static constexpr std::uint8_t kStatus = 4;
  static constexpr std::uint8_t kHeldPlans = 8;
  static constexpr std::uint8_t kQuestion = 16;
};
[[nodiscard]] std::uint8_t said(const Outputs& out);

[[nodiscard]] protocol::JournalEntry beginning(LocalTime now, const AgentOptions& options);
[[nodiscard]] protocol::JournalEntry entry_of(LocalTime now, const Event& event, const Outputs& out);

struct JournalBeginning {
  AgentOptions options;
  std::string version;  ///< of the program that kept it
};
/// An error says what is no such entry.
[[nodiscard]] Result<JournalBeginning> beginning_of(const protocol::JournalEntry& entry);
/// Absent: not an event of an agent, or a verdict, which the core's question leads to.
[[nodiscard]] std::optional<Event> event_of(const protocol::JournalEntry& entry);

}  // namespace gyre::agent
