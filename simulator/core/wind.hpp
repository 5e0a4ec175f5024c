#pragma once
// Wind as a force on the load's centre of mass: a constant part and gusts that come and go.
//
//   F(t) = rise(t) F_mean + g(t)        g' = −g / T + σ √(2 / T) · white noise      (Ornstein-Uhlenbeck, per axis)
//
// g is drawn once per tick by its exact discretisation and is linear in between; deviation σ and correlation time T
// after the start. Both begin at zero, because the flight begins in equilibrium: the constant part rises over
// kWindRise_s by a smooth step (a sudden one would make the load swing, and little damps a swing), the gusts grow from
// nothing by themselves. The same seed gives the same wind.

#include <Eigen/Core>
#include <cstdint>

#include "common/base/random_stream.hpp"

namespace gyre::simulator {

inline constexpr double kWindRise_s = 10.0;

struct WindSettings {
  Eigen::Vector3d mean_force_w_n = Eigen::Vector3d::Zero();
  double gust_deviation_n = 0.0;   ///< σ; 0: no gusts
  double gust_time_scale_s = 2.0;  ///< T
};

class Wind {
 public:
  Wind(const WindSettings& settings, std::uint64_t seed, double tick_s);

  /// Draws the gust at the end of the tick that begins now; once per tick, in order.
  void tick(double now_s);

  /// At any time within the tick.
  [[nodiscard]] Eigen::Vector3d force_w_n(double t_s) const;

 private:
  WindSettings settings_;
  RandomStream random_;
  double tick_s_;
  double since_s_ = 0.0;
  Eigen::Vector3d begin_w_n_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_w_n_ = Eigen::Vector3d::Zero();
};

}  // namespace gyre::simulator
