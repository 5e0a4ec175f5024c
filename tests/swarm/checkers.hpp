#pragma once
// Judges of a flight who stand outside of it: they know true time and see every setpoint, and believe nobody.
//
//   rule          what has to hold                                                                  bound
//   equilibrium   |sum of wrenches − w| of the forces the setpoints imply, at every instant          explained below
//   continuity    no step in position or velocity of any agent's setpoints                          acceleration · dt
//   return        the first setpoint after a silence is where the vehicle has got to meanwhile       40 ms of motion
//   swarm time    at an agent never runs backwards, never jumps                                      slew + drift
//   clocks        two agents' swarm times differ by no more than both say they may                  published
//   half applied  how much of a transition some fly and others do not                               half_applied_bound
//   terms         never go back at an agent
//
// Equilibrium: with all agents on one course the forces are those of one mixture, evaluated at times that differ by the
// clocks' disagreement D. Then the residual is at most (D/2) · sum max|df_i| (mechanics/skew.hpp), where df_i counts
// the transition's own pace too. Agents that hold different courses add at most (share that is half applied) ·
// (greatest change of forces between any two plans). Nothing else may contribute: that is the check.

#include <string>
#include <vector>

#include "agent/core/agent.hpp"
#include "tests/swarm/scenario.hpp"

namespace gyre::swarm {

struct Finding {
  enum class Kind { kSafety, kLiveness };
  Kind kind = Kind::kSafety;
  TrueTime at{};
  std::string rule;
  std::string text;
};

/// How much of a flight was judged, and how close to the bounds it came.
struct Extremes {
  std::uint64_t setpoints = 0;
  std::uint64_t instants = 0;   ///< at which the equilibrium was judged
  std::uint64_t merging = 0;    ///< agent-instants on the way back to the plan
  double merging_m = 0.0;       ///< furthest of them from where the plan has the carrier
  double residual_share = 0.0;  ///< of the weight
  double residual_of_bound = 0.0;
  double half_applied = 0.0;          ///< ever
  double half_applied_in_calm = 0.0;  ///< with everybody there and at most 30 % loss
  double disagreement_s = 0.0;
  double step_of_bound = 0.0;
};

class Checkers {
 public:
  Checkers(const LoadWithMotions& load, const Scenario& scenario);

  /// `vehicle`: where the carrier was when this came; `course`: what the agent flew when it sent this.
  void setpoint(std::size_t agent, TrueTime now, const protocol::Setpoint& setpoint,
                const protocol::CarrierState& vehicle, const protocol::Course& course);
  void status(std::size_t agent, TrueTime now, const protocol::AgentStatus& status);
  /// The process of this agent begins a new life: what it says is held against nothing it said before.
  void begins(std::size_t agent);
  void ends(std::size_t agent);
  /// Somebody died, hung, was cut off, or the weather is bad: the bounds that hold in calm do not for a while.
  void disturbed(TrueTime until) {
    calm_ = false;
    calm_from_ = std::max(calm_from_, until);
  }
  void lies_told() { lies_ = true; }
  /// All that lives is looked at together.
  void instant(TrueTime now);

  void report(Finding::Kind kind, TrueTime at, const std::string& rule, const std::string& text);
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }
  [[nodiscard]] const Extremes& extremes() const { return extremes_; }
  /// Greatest disagreement of the agents' swarm times now; absent when not all of them fly.
  [[nodiscard]] std::optional<Duration> disagreement() const { return disagreement_; }
  [[nodiscard]] bool anybody_merging() const { return merging_now_; }

 private:
  struct Sample {
    TrueTime at{};
    protocol::Setpoint setpoint;
  };
  struct Agent {
    bool lives = false;
    std::optional<Sample> last, before;
    std::uint64_t term = 0;
    TrueTime term_since{};
    Duration uncertainty = Duration::max();
    protocol::Course flown;
    double changed = 0.0;  ///< of the motion, from the setpoint before to the last one, by taking up another course
  };
  struct Moment;

  void check_continuity(TrueTime now, const Agent& agent, const Sample& before, const Sample& last);
  void check_return(TrueTime now, const protocol::Setpoint& setpoint, const protocol::CarrierState& vehicle);
  void check_clocks(const Moment& moment);
  void check_equilibrium(const Moment& moment, double half_applied, double pace_per_s);

  std::vector<Agent> agents_;
  std::vector<Eigen::Vector3d> attachments_w_m_, arms_w_m_;
  double weight_n_ = 0.0, arm_m_ = 0.0;
  double rate_n_per_s_ = 0.0;    ///< residual per second of disagreement, of any motion
  double change_n_ = 0.0;        ///< sum over carriers of the greatest change of force between two plans
  double curvature_n_s2_ = 0.0;  ///< sum over carriers of the greatest second derivative of force
  double acceleration_m_s2_ = 0.0;
  double shortest_transition_s_ = 1.0;
  TrueTime calm_from_{};
  bool calm_ = false;  ///< all have flown the same since the last disturbance: from then on they have to
  bool lies_ = false;
  bool merging_now_ = false;
  std::optional<Duration> disagreement_;
  std::vector<Finding> findings_;
  Extremes extremes_;
};

/// The share of a transition of this duration that may be half applied in calm: somebody misses its start, and the
/// coordinator sees it after start_check and turns back within turning_back, beginning go_margin later.
[[nodiscard]] double half_applied_bound(double duration_s);

/// The greatest share of any plan by which two courses differ at `now`, 0 when they are the same motion.
[[nodiscard]] double difference(const protocol::Course& a, const protocol::Course& b, SwarmTime now);

}  // namespace gyre::swarm
