#pragma once
// How still the load hangs: how far it is from its pose, and what the cables leave unbalanced, peak by window.
//
//   symbol     meaning                                                          unit
//   v, w       the load's velocity (W) and angular velocity (B)                 m/s, rad/s
//   F = m dv/dt, M = J dw/dt + w x J w      what the cables leave unbalanced     N, N m
//   residual   max(|F|, |M| / r) / (m g), r the longest attachment arm          1
//
// The residual is Newton's: it is taken from the load alone and trusts nobody's word of what he pulls. A load that
// hangs still, or drifts steadily, has none. Derivatives are differences between samples, by the stamps of whoever
// measures.
//
// A window runs from one take() to the next, so that no peak is lost between two of them however seldom one looks.

#include <cstdint>
#include <optional>

#include "common/mechanics/plan.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

/// How the load was in a window; all zero without a sample.
struct LoadWindow {
  double displacement_max_m = 0.0;  ///< from the mission's pose
  double rotation_max_deg = 0.0;
  double residual_max = 0.0;                                ///< share of the weight
  Eigen::Vector3d displaced_w_m = Eigen::Vector3d::Zero();  ///< where to, when it was furthest
  std::uint64_t samples = 0;

  /// Of two windows that follow each other.
  void include(const LoadWindow& next);
};

class LoadGauge {
 public:
  explicit LoadGauge(const mechanics::Plan& plan);

  /// `load` is believed (swarm_view.hpp).
  void see(const protocol::LoadState& load);

  [[nodiscard]] double displacement_now_m() const { return displacement_now_m_; }
  [[nodiscard]] double rotation_now_deg() const { return rotation_now_deg_; }
  [[nodiscard]] const LoadWindow& window() const { return window_; }
  /// Ends the window.
  LoadWindow take();

 private:
  [[nodiscard]] double residual(const protocol::LoadState& before, const protocol::LoadState& after) const;

  mechanics::Load load_;
  double gravity_m_s2_;
  double arm_m_ = 0.0;
  std::optional<protocol::LoadState> last_;
  double displacement_now_m_ = 0.0;
  double rotation_now_deg_ = 0.0;
  LoadWindow window_;
};

}  // namespace gyre::ground
