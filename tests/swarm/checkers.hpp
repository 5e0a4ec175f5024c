#pragma once
// Judges of a flight who stand outside of it: they know true time and see every setpoint, and believe nobody.
//
//   rule          what has to hold                                                                  bound
//   equilibrium   the residual of all that is commanded (equilibrium_judge.hpp), always              the scenario's
//   continuity    no step in position or velocity of any agent's setpoints                          acceleration · dt
//   return        the first setpoint after a silence is where the vehicle has got to meanwhile       40 ms of motion
//   swarm time    at an agent never runs backwards, never jumps, unless a clock did                  slew + drift
//   clocks        two agents' swarm times differ by no more than both say they may                  published
//   terms         never go back at an agent

#include <string>
#include <vector>

#include "agent/core/agent.hpp"
#include "tests/swarm/equilibrium_judge.hpp"
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
  double residual_of_budget = 0.0;
  double disagreement_s = 0.0;
  double step_of_bound = 0.0;
};

class Checkers {
 public:
  Checkers(const LoadWithMotions& load, const Scenario& scenario);

  /// `vehicle`: where the carrier was when this came.
  void setpoint(std::size_t agent, TrueTime now, const protocol::Setpoint& setpoint,
                const protocol::CarrierState& vehicle);
  /// What a vehicle does that nobody commands.
  void alone(std::size_t agent, TrueTime now, const protocol::Setpoint& doing) {
    equilibrium_.commanded(agent, now, doing);
  }
  void status(std::size_t agent, TrueTime now, const protocol::AgentStatus& status);
  /// The process of this agent begins a new life: what it says is held against nothing it said before.
  void begins(std::size_t agent);
  void ends(std::size_t agent);
  void lies_told() { lies_ = true; }
  /// A clock stood still: an agent's, who may find swarm time anew, or a coordinator's.
  void clock_stopped(std::optional<std::size_t> agent) {
    stopped_ = true;
    if (agent) agents_[*agent].last.reset();
  }
  void found_anew(std::size_t agent, TrueTime now);
  /// All that lives is looked at together.
  void instant(TrueTime now);

  void report(Finding::Kind kind, TrueTime at, const std::string& rule, const std::string& text);
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }
  [[nodiscard]] const Extremes& extremes() const { return extremes_; }
  /// Greatest disagreement of the agents' swarm times now; absent when not all of them fly.
  [[nodiscard]] std::optional<Duration> disagreement() const { return disagreement_; }
  [[nodiscard]] std::optional<double> residual_share_now() const { return equilibrium_.residual_share(); }
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
    TrueTime found_anew = TrueTime::min();
  };
  struct Moment;

  void check_continuity(TrueTime now, const Agent& agent, const Sample& before, const Sample& last);
  void check_return(TrueTime now, const protocol::Setpoint& setpoint, const protocol::CarrierState& vehicle);
  void check_clocks(const Moment& moment);
  void check_equilibrium(TrueTime now);

  std::vector<Agent> agents_;
  std::vector<Eigen::Vector3d> attachments_w_m_;
  EquilibriumJudge equilibrium_;
  double budget_share_;
  double acceleration_m_s2_ = 0.0;
  bool lies_ = false;
  bool stopped_ = false;
  bool merging_now_ = false;
  std::optional<Duration> disagreement_;
  std::vector<Finding> findings_;
  Extremes extremes_;
};

}  // namespace gyre::swarm
