#include "ground/swarm/core/load_gauge.hpp"

#include <algorithm>
#include <utility>

#include "common/base/angle.hpp"

namespace gyre::ground {

void LoadWindow::include(const LoadWindow& next) {
  if (next.displacement_max_m > displacement_max_m) displaced_w_m = next.displaced_w_m;
  displacement_max_m = std::max(displacement_max_m, next.displacement_max_m);
  rotation_max_deg = std::max(rotation_max_deg, next.rotation_max_deg);
  residual_max = std::max(residual_max, next.residual_max);
  samples += next.samples;
}

LoadGauge::LoadGauge(const mechanics::Plan& plan) : load_(plan.load), gravity_m_s2_(plan.gravity_m_s2) {
  for (const mechanics::Carrier& carrier : plan.carriers) arm_m_ = std::max(arm_m_, carrier.attachment_b_m.norm());
}

void LoadGauge::see(const protocol::LoadState& load) {
  const Eigen::Vector3d displaced_w_m = load.position_w_m - load_.position_w_m;
  displacement_now_m_ = displaced_w_m.norm();
  rotation_now_deg_ = degrees(load.orientation_w_b.angularDistance(load_.orientation_w_b));
  // Not newer: it was restarted, or the wire changed the order.
  const bool newer = last_ && load.stamp > last_->stamp;
  window_.include({displacement_now_m_, rotation_now_deg_, newer ? residual(*last_, load) : 0.0, displaced_w_m, 1});
  last_ = load;
}

LoadWindow LoadGauge::take() {
  return std::exchange(window_, {});
}

double LoadGauge::residual(const protocol::LoadState& before, const protocol::LoadState& after) const {
  const double dt_s = seconds(after.stamp - before.stamp);
  const Eigen::Vector3d acceleration = (after.velocity_w_m_s - before.velocity_w_m_s) / dt_s;
  const Eigen::Vector3d spin = after.angular_velocity_b_rad_s;
  const Eigen::Vector3d spin_up = (spin - before.angular_velocity_b_rad_s) / dt_s;
  const double weight_n = load_.mass_kg * gravity_m_s2_;
  // F = m dv/dt      M = J dw/dt + w x J w
  const double force_n = load_.mass_kg * acceleration.norm();
  const double moment_n_m = (load_.inertia_b_kg_m2 * spin_up + spin.cross(load_.inertia_b_kg_m2 * spin)).norm();
  return std::max(force_n, arm_m_ > 0.0 ? moment_n_m / arm_m_ : 0.0) / weight_n;
}

}  // namespace gyre::ground
