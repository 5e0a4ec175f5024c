#pragma once
// A coordinator's journal: between what its core is made of, told and says, and the entries of
// common/protocol/journal.hpp.
//
//   kBeginning                    the mission's text and the options as JSON, so that a person can read them, too
//   kAgentStatus, kTimeRequest    when it arrived (8), and the message
//   kRetune                       the command (8), whether there is a job (1), and the mission's text, or why none
//   kTick, kShutdown              nothing
//   the others                    the message

#include <cstdint>
#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "common/protocol/journal.hpp"
#include "coordinator/core/coordinator.hpp"

namespace gyre::coordinator {

enum class JournalKind : std::uint8_t {
  kBeginning = 0,
  kTick = 1,
  kAgentStatus = 2,
  kHeldPlans = 3,
  kTimeRequest = 4,
  kCommand = 5,
  kRetune = 6,
  kBeacon = 7,
  kHealth = 8,
  kCarrierState = 9,
  kShutdown = 10,
};

/// Which outputs came of a step: JournalEntry::said.
struct Said {
  static constexpr std::uint8_t kTimeReply = 1;
  static constexpr std::uint8_t kOffers = 2;
  static constexpr std::uint8_t kBeacon = 4;
  static constexpr std::uint8_t kStatus = 8;
  static constexpr std::uint8_t kMission = 16;
  static constexpr std::uint8_t kReplies = 32;
  static constexpr std::uint8_t kFinished = 64;
};
[[nodiscard]] std::uint8_t said(const Outputs& out);

[[nodiscard]] protocol::JournalEntry beginning(LocalTime now, const Job& job, const CoordinatorOptions& options);
[[nodiscard]] protocol::JournalEntry entry_of(LocalTime now, const Event& event, const Outputs& out);

struct JournalBeginning {
  Job job;
  CoordinatorOptions options;
  std::string version;  ///< of the program that kept it
};
/// Reads and certifies its mission. An error says what is no such entry.
[[nodiscard]] Result<JournalBeginning> beginning_of(const protocol::JournalEntry& entry);
/// A retune's mission is read and certified again. Absent: not an event of a coordinator.
[[nodiscard]] std::optional<Event> event_of(const protocol::JournalEntry& entry);

}  // namespace gyre::coordinator
