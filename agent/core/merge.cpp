#include "agent/core/merge.hpp"

#include <algorithm>
#include <cmath>

namespace gyre::agent {
namespace {

using mechanics::constant;
using Number = mechanics::Taylor<double>;

/// Below this nobody could measure a step: rounding of the same reference computed twice.
constexpr double kNothing_m = 1e-9;
constexpr double kShortest_s = 1.0;
/// Peaks of the fading quintic of a unit gap: 15/8 of the mean rate, 10/√3 of gap / T².
constexpr double kRatePeak = 1.875;
constexpr double kAccelerationPeak = 5.7735;

double time_for(double gap, double rate, double rate_limit, double acceleration_limit) {
  const double by_rate = kRatePeak * gap / rate_limit;
  const double by_acceleration = std::sqrt(kAccelerationPeak * gap / acceleration_limit);
  const double to_stop = 2.0 * kRatePeak * rate / acceleration_limit;
  return std::max({kShortest_s, by_rate, by_acceleration, to_stop});
}

}  // namespace

void Merge::begin(SwarmTime now, const Command& flown, const Command& reference) {
  start_ = now;
  duration_ = Duration::zero();
  gap_.position_w_m = flown.position_w_m - reference.position_w_m;
  gap_.winch_m = flown.winch_m - reference.winch_m;
  const double position = gap_.position_w_m.value.norm();
  const double speed = gap_.position_w_m.first.norm();
  const double length = std::abs(gap_.winch_m.value);
  const double rate = std::abs(gap_.winch_m.first);
  if (std::max(position, length) < kNothing_m && std::max(speed, rate) < kNothing_m) return;
  // Half of each limit: the other half is for the plan that goes on meanwhile.
  duration_ =
      from_seconds(std::max(time_for(position, speed, 0.5 * limits_.speed_m_s, 0.5 * limits_.acceleration_m_s2),
                            time_for(length, rate, 0.5 * limits_.winch_rate_m_s, 0.5 * limits_.acceleration_m_s2)));
}

Command Merge::apply(SwarmTime now, const Command& reference) const {
  if (!under_way(now)) return reference;
  const double t = seconds(duration_);
  const Number x{seconds(now - start_) / t, 1.0 / t, 0.0};
  const Number x2 = x * x;
  const Number x3 = x2 * x;
  const Number value = constant(1.0) - x3 * (constant(10.0) - 15.0 * x + 6.0 * x2);
  const Number slope = t * (x - x3 * (constant(6.0) - 8.0 * x + 3.0 * x2));
  const Number curvature = (0.5 * t * t) * (x2 - x3 * (constant(3.0) - 3.0 * x + x2));

  const auto& p = gap_.position_w_m;
  const auto& l = gap_.winch_m;
  Command out = reference;
  out.position_w_m = out.position_w_m + value * Eigen::Vector3d(p.value) + slope * Eigen::Vector3d(p.first) +
                     curvature * Eigen::Vector3d(p.second);
  out.winch_m = out.winch_m + l.value * value + l.first * slope + l.second * curvature;
  return out;
}

}  // namespace gyre::agent
