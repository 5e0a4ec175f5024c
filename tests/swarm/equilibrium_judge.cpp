#include "tests/swarm/equilibrium_judge.hpp"

#include <algorithm>

namespace gyre::swarm {

EquilibriumJudge::EquilibriumJudge(const LoadWithMotions& load) {
  const mechanics::Plan& plan = load.motions.front();
  weight_n_ = plan.load.mass_kg * plan.gravity_m_s2;
  for (const Eigen::Vector3d& arm : lever_arms(plan)) {
    carriers_.push_back({plan.load.position_w_m + arm, arm, std::nullopt, std::nullopt});
    arm_m_ = std::max(arm_m_, arm.norm());
  }
}

void EquilibriumJudge::commanded(std::size_t carrier, TrueTime at, const protocol::Setpoint& setpoint) {
  Carrier& c = carriers_[carrier];
  const Eigen::Vector3d direction = (setpoint.position_w_m - c.attachment_w_m).normalized();
  if (c.last && c.last->at >= at) return;
  c.before = c.last;
  c.last = Command{at, setpoint.tension_n * direction};
}

std::optional<double> EquilibriumJudge::residual_share() const {
  TrueTime at = TrueTime::max();
  for (const Carrier& c : carriers_) {
    if (!c.before) return std::nullopt;
    at = std::min(at, c.last->at);
  }
  Eigen::Vector3d force(0.0, 0.0, -weight_n_);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Carrier& c : carriers_) {
    const double x = seconds(at - c.before->at) / seconds(c.last->at - c.before->at);
    const Eigen::Vector3d f = c.before->force_w_n + x * (c.last->force_w_n - c.before->force_w_n);
    force += f;
    moment += c.arm_w_m.cross(f);
  }
  return std::max(force.norm(), moment.norm() / arm_m_) / weight_n_;
}

}  // namespace gyre::swarm
