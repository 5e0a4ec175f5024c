#pragma once
// Whether a setpoint may be flown: finite, for a carrier there is, plausible, and newer than the last one.
//
// Plausible means: no further from the load than kReachFactor times the longest way from load to carrier at rest (and
// a few metres for the smallest rigs), and no faster or harder accelerated than anything that flies with a load. The
// bounds keep nonsense out; whether a motion is wise is the certificate's business, not the simulator's.
//
// A stamp contradicts when it is further from this clock, by a second, than that of the setpoint before: flown, it
// would make those after it old.
//
// Two agents may claim one carrier, and only the vehicle hears both: it flies those of one of them, until that one
// falls silent (common/protocol/incumbent.hpp).
//
// Newer is judged by swarm time, which survives a restart of the agent (its sequence does not). A carrier whose last
// accepted setpoint is older than the extrapolation horizon takes any time: the swarm may have started anew.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/protocol/incumbent.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::simulator {

/// A stamp that is so far from where the last ones were, against the clock here, is believed when this many in a row
/// agree on it: a swarm that starts anew, or a clock that was found anew. By then a vehicle has not yet gone on by
/// itself (onward.hpp).
inline constexpr Duration kContradiction = std::chrono::seconds(1);
inline constexpr int kAgreeing = 4;

inline constexpr double kReachFactor = 10.0;
inline constexpr double kReachMargin_m = 10.0;
inline constexpr double kAbsurdSpeed_m_s = 340.0;
inline constexpr double kAbsurdAcceleration_m_s2 = 1000.0;

class SetpointJudge {
 public:
  /// `longest_rest_m`: the longest way from the load's centre of mass to a carrier at rest.
  SetpointJudge(const mechanics::Plan& plan, double longest_rest_m);

  /// Absent: fly it. Otherwise why not, in words; the drop is counted.
  [[nodiscard]] std::optional<std::string> objection(const protocol::Setpoint& setpoint, LocalTime arrived);

  /// Whether a swarm's clock may show this.
  [[nodiscard]] static bool has_plausible_stamp(const protocol::Setpoint& setpoint);

  /// Whether the last one that is flown was stamped by another clock than those before.
  [[nodiscard]] bool began_anew(CarrierId carrier) const { return last_.at(carrier).began_anew; }

  /// The agent whose setpoints are flown; 0: none are.
  [[nodiscard]] std::uint64_t follows(CarrierId carrier, LocalTime now) const;
  /// Carriers that get setpoints of two agents.
  [[nodiscard]] std::vector<CarrierId> contested(LocalTime now) const;

  [[nodiscard]] const protocol::DropCounts& dropped() const { return dropped_; }

 private:
  struct Last {
    protocol::Incumbent agent{protocol::kSucceeded, Duration::zero()};
    bool any = false;
    SwarmTime swarm_time{};
    LocalTime arrived{};
    bool began_anew = false;
    Duration contradicting{};  ///< delay of the last one that did
    int agreeing = 0;          ///< of those, in a row
  };
  enum class Stamp { kGoesOn, kBeginsAnew, kContradicts };
  /// `fresh_start`: after a silence that nothing contradicts.
  [[nodiscard]] static Stamp judge_stamp(Last& last, SwarmTime stamp, LocalTime arrived, bool fresh_start);

  [[nodiscard]] std::optional<std::string> nonsense(const protocol::Setpoint& setpoint) const;

  std::map<CarrierId, Last> last_;
  Eigen::Vector3d load_position_w_m_;
  double reach_m_;
  protocol::DropCounts dropped_;
};

}  // namespace gyre::simulator
