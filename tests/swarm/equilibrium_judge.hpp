#pragma once
// Whether the load is held, by somebody who knows nothing but what each carrier was last commanded and what the load
// weighs. No course, no clock, no excuse: |sum f_i − w|, and the moment over the longest arm, as a share of the weight.
//
//   f_i   the commanded tension along the line from the attachment to the commanded place
//
// Commands come every 10 ms at moments of their own; between two of them a force is drawn as a line.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/protocol/messages.hpp"
#include "tests/swarm/missions.hpp"
#include "tests/swarm/virtual_clock.hpp"

namespace gyre::swarm {

class EquilibriumJudge {
 public:
  explicit EquilibriumJudge(const LoadWithMotions& load);

  /// `carrier` by its place in the plan; whoever commands it, its agent or the vehicle itself.
  void commanded(std::size_t carrier, TrueTime at, const protocol::Setpoint& setpoint);

  /// At the last moment by which all were commanded; absent before.
  [[nodiscard]] std::optional<double> residual_share() const;

 private:
  struct Command {
    TrueTime at{};
    Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();
  };
  struct Carrier {
    Eigen::Vector3d attachment_w_m, arm_w_m;
    std::optional<Command> before, last;
  };
  std::vector<Carrier> carriers_;
  double weight_n_ = 0.0, arm_m_ = 0.0;
};

}  // namespace gyre::swarm
