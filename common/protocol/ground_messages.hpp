#pragma once
// What people and their tools say to a swarm and are told by it, as plain data (units and times as in messages.hpp).

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/protocol/course.hpp"

namespace gyre::protocol {

inline constexpr std::size_t kMaxTextBytes = 255;
inline constexpr std::size_t kMaxMissionBytes = 32768;
/// Of a journal in one piece: with all headers it stays within one datagram of any network.
inline constexpr std::size_t kMaxJournalBytes = 1000;

/// What was dropped, and why; in every process that listens.
struct DropCounts {
  std::uint64_t late = 0;
  std::uint64_t duplicate = 0;
  std::uint64_t wrong_term = 0;
  std::uint64_t nonsense = 0;
};

enum class CommandKind : std::uint8_t { kEngage = 1, kRelease = 2, kFreeze = 3, kRetune = 4, kPace = 5 };

/// Topics command and command_reply, ground to coordinator and back.
struct Command {
  std::uint64_t id = 0;  ///< chosen by the sender, echoed in the reply
  CommandKind kind = CommandKind::kEngage;
  double pace = 1.0;                ///< kPace: 0 .. 1
  std::optional<double> phase_rad;  ///< kRelease: where to stop; absent: at the next moment
  std::string mission;              ///< kRetune: the text of a mission file; at most kMaxMissionBytes
};

struct CommandReply {
  std::uint64_t id = 0;
  bool done = false;
  std::string text;
};

/// Topic coordinator/status, coordinator to ground.
struct CoordinatorStatus {
  std::uint64_t term = 0;
  SwarmTime swarm_time{};
  std::string mission;              ///< its name; at most kMaxTextBytes
  PlanNumber plan;                  ///< the plan of the mission in force
  Duration skew_budget{};           ///< clock disagreement the plans in force allow; 0: any
  Duration skew{};                  ///< the greatest disagreement the agents' uncertainties leave possible
  std::vector<CarrierId> carriers;  ///< of the mission; at most kMaxCarrierId
  std::vector<CarrierId> silent;    ///< at most kMaxCarrierId
  std::string news;                 ///< the latest of what it has to tell; at most kMaxTextBytes
};

/// Topic mission, coordinator to ground: the mission in force, so that who joins knows its load and limits.
struct MissionText {
  std::uint64_t term = 0;
  PlanNumber plan;   ///< as CoordinatorStatus names it
  std::string text;  ///< at most kMaxMissionBytes; empty: longer than that
};

/// Topic health, every process to ground and coordinator: whether it does its work, what it dropped, and why.
struct Health {
  std::string process;    ///< "agent 3"; at most kMaxTextBytes
  std::string complaint;  ///< what keeps it from its work; empty: nothing does. At most kMaxTextBytes
  DropCounts dropped;
  std::uint64_t undecodable = 0;  ///< samples that were no such message
  std::uint64_t unsendable = 0;   ///< messages the wire refused
  std::uint64_t overrun = 0;      ///< messages the main loop came too late for
  Duration late_max{};            ///< how late its main loop woke from a sleep, the worst since the last report
};

enum class DisturbanceKind : std::uint8_t { kLosePackets = 1, kShiftClock = 2, kPushLoad = 3 };

/// Topic laboratory, ground to processes that were started with --laboratory; nobody else listens (disturbance.hpp).
struct Disturbance {
  std::string process;  ///< "agent 3"; at most kMaxTextBytes
  DisturbanceKind kind = DisturbanceKind::kLosePackets;
  double share = 0.0;                                   ///< kLosePackets: of the packets, in and out alike; 0: none
  Duration shift{};                                     ///< kShiftClock: added to the process's clock
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();  ///< kPushLoad: at the centre of mass
  Duration duration{};                                  ///< kPushLoad; kLosePackets: 0: until told otherwise
};

/// Topic journal, every process that keeps one to recorders: what its core was told, in order (journal.hpp). The pieces
/// of one life of a process, laid end to end, are its journal.
struct JournalPiece {
  std::string process;  ///< "agent 3"; at most kMaxTextBytes
  std::uint64_t incarnation = 0;
  std::uint64_t offset = 0;         ///< of the first byte, in the whole journal
  std::vector<std::uint8_t> bytes;  ///< at most kMaxJournalBytes
};

}  // namespace gyre::protocol
