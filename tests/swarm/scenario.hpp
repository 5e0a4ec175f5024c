#pragma once
// What happens to a swarm and when, all of it decided by a seed before the flight begins, and readable.
//
// A flight has three parts: it starts; then faults come and go; at `heal` every fault ends and every dead process is
// started again, and from then on the swarm has to find together.

#include <cstdint>
#include <string>
#include <vector>

#include "coordinator/core/coordinator.hpp"
#include "tests/swarm/missions.hpp"
#include "tests/swarm/network.hpp"

namespace gyre::swarm {

/// Processes by number: the coordinators first, then the agents in the plan's order.
inline constexpr std::size_t kCoordinators = 2;  // the second one is a mistake, where there is one

enum class Deed {
  kWeather,           ///< `weather` from now on
  kPartition,         ///< `groups` from now on; empty: whole again
  kKill,              ///< SIGKILL of `process`
  kKillInTransition,  ///< SIGKILL of the coordinator `offset` after the start of the next transition that is go
  kStart,             ///< `process` starts (again)
  kSuspend,           ///< SIGSTOP of `process` for `length`: it neither runs nor reads its clock
  kStall,             ///< the main loop of `process` hangs for `length`; what arrives is stamped
  kCommand,           ///< from the ground
  kRetune,            ///< to motion number `motion`; one past the last: to one that no vehicle can fly
  kHeal,
};
[[nodiscard]] const char* name(Deed deed);

struct Action {
  TrueTime at{};
  Deed deed = Deed::kHeal;
  std::size_t process = 0;
  Duration length{};
  Duration offset{};
  Weather weather;
  std::vector<int> groups;
  protocol::CommandKind command = protocol::CommandKind::kEngage;
  std::size_t motion = 0;
};

struct Scenario {
  std::uint64_t seed = 0;
  std::size_t load = 0;  ///< index into loads()
  std::vector<Duration> clock_offsets;
  std::vector<double> clock_drifts;
  double clock_wander_per_sqrt_s = 0.0;
  protocol::AgentLoss on_agent_loss = protocol::AgentLoss::kFreeze;
  Duration transition{};
  bool engage_when_ready = false;
  bool rehearse = false;
  std::vector<Action> actions;  ///< in order of time
  TrueTime heal{};
};

[[nodiscard]] Scenario scenario(std::uint64_t seed);
/// Nothing goes wrong: start, engage, retune, release.
[[nodiscard]] Scenario calm_scenario(std::uint64_t seed, std::size_t load);
/// One line for a person.
[[nodiscard]] std::string describe(const Action& action);

}  // namespace gyre::swarm
