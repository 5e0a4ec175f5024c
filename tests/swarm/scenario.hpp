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
  kWeather,       ///< `weather` from now on
  kPartition,     ///< `groups` from now on; empty: whole again
  kKill,          ///< SIGKILL of `process`
  kKillInChange,  ///< SIGKILL of the coordinator `offset` after the start of the next change that is go
  kStart,         ///< `process` starts (again)
  kSuspend,       ///< SIGSTOP of `process` for `length`: it neither runs nor reads its clock
  kStall,         ///< the main loop of `process` hangs for `length`; what arrives is stamped
  kClockStop,     ///< `process` sleeps for `length`, and so does its clock, as in a machine that is suspended
  kClockLeap,     ///< the clock of an agent leaps ahead by `length`
  kTwin,          ///< for `length` there is one more agent of the carrier of `process`
  kSecondWorld,   ///< for `length` there is a second simulator, whose carriers rest where they began
  kCut,           ///< `cuts` from now on: one direction of a link each
  kCommand,       ///< from the ground
  kRetune,        ///< to motion number `motion`; one past the last: to one that no vehicle can fly
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
  std::vector<Network::Cut> cuts;
  protocol::CommandKind command = protocol::CommandKind::kEngage;
  std::size_t motion = 0;
};

/// What a fault may cost: the share of the weight that is not held while it lasts, or after it.
namespace cost {
/// Nothing happens: clocks that agree to microseconds, and forces that are drawn as lines between two commands.
inline constexpr double kCalm = 2e-3;
/// A process hangs, or begins anew: whoever comes back finds swarm time within a millisecond or two, and merges.
inline constexpr double kProcess = 0.03;
/// The link breaks, or loses a third and more: a step of the lease may have been on its way, or a change that was go.
inline constexpr double kLink = 0.15;
/// A vehicle that holds its place loses its agent: all stop with it, and it takes a third of a second until they do.
inline constexpr double kHolding = 0.5;
/// Processes die that together knew a plan which nobody else does: all go over to another.
inline constexpr double kForgotten = 1.0;
}  // namespace cost

struct Scenario {
  std::uint64_t seed = 0;
  std::size_t load = 0;  ///< index into loads()
  std::vector<Duration> clock_offsets;
  std::vector<double> clock_drifts;
  double clock_wander_per_sqrt_s = 0.0;
  protocol::Silence silence;
  std::vector<std::size_t> holding;  ///< agents whose vehicles brake on the spot when nobody tells them anything
  /// What all the faults of this flight together may cost: the share of the weight that is not held, at any moment.
  double residual_budget = cost::kCalm;
  Duration transition{};
  /// An agent's verdict on a plan comes up to so long after the offer; by itself, within a beat.
  Duration judging = std::chrono::milliseconds(10);
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
