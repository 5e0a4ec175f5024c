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
/// A load swings on cables of some metres within one to three seconds. Pushed by a gap that closes faster than that, it
/// goes on swinging: nothing but air damps it. Gaps below a millimetre push nobody.
constexpr double kUnpushed_s = 3.0;
constexpr double kUnnoticed_m = 1e-3;
/// Peaks of the fading quintics: of a unit gap, 15/8 of gap / T and 10/√3 of gap / T²; of a unit rate, 3.95 of rate /
/// T.
constexpr double kRatePeak = 1.875;
constexpr double kAccelerationPeak = 5.7735;
constexpr double kStopPeak = 3.95;

/// Gap and rate share what the merge may use of the acceleration.
Duration gap_time(double gap, double rate_limit, double acceleration_limit, double shortest_s) {
  const double by_rate = kRatePeak * gap / rate_limit;
  const double by_acceleration = std::sqrt(kAccelerationPeak * gap / (0.5 * acceleration_limit));
  return from_seconds(std::max({shortest_s, by_rate, by_acceleration}));
}
Duration rate_time(double rate, double acceleration_limit, double shortest_s) {
  return from_seconds(std::max(shortest_s, kStopPeak * rate / (0.5 * acceleration_limit)));
}

/// Where a fade that takes `duration` is.
Number progress(Duration elapsed, Duration duration) {
  if (elapsed >= duration) return constant(1.0);
  return {seconds(elapsed) / seconds(duration), 1.0 / seconds(duration), 0.0};
}

}  // namespace

void Merge::begin(SwarmTime now, const Command& flown, const Command& reference) {
  start_ = now;
  gap_.position_w_m = flown.position_w_m - reference.position_w_m;
  gap_.winch_m = flown.winch_m - reference.winch_m;
  const double position = gap_.position_w_m.value.norm();
  const double speed = gap_.position_w_m.first.norm();
  const double length = std::abs(gap_.winch_m.value);
  const double rate = std::abs(gap_.winch_m.first);
  under_way_ = std::max(position, length) >= kNothing_m || std::max(speed, rate) >= kNothing_m;
  // Half of each limit: the other half is for the plan that goes on meanwhile.
  const double acceleration = 0.5 * limits_.acceleration_m_s2;
  const double shortest_s = std::max(position, length) > kUnnoticed_m ? kUnpushed_s : kShortest_s;
  value_time_ = std::max(gap_time(position, 0.5 * limits_.speed_m_s, acceleration, shortest_s),
                         gap_time(length, 0.5 * limits_.winch_rate_m_s, acceleration, shortest_s));
  rate_time_ = rate_time(std::max(speed, rate), acceleration, shortest_s);
}

Command Merge::apply(SwarmTime now, const Command& reference) const {
  if (!under_way(now)) return reference;
  const Duration elapsed = now - start_;
  const Number one = constant(1.0);
  const Number x = progress(elapsed, value_time_);
  const Number value = one - x * x * x * (constant(10.0) - 15.0 * x + 6.0 * (x * x));
  const Number y = progress(elapsed, rate_time_);
  const Number slope = seconds(rate_time_) * (y - y * y * y * (constant(6.0) - 8.0 * y + 3.0 * (y * y)));
  const Number z = progress(elapsed, from_seconds(kShortest_s));
  const Number curvature = (0.5 * kShortest_s * kShortest_s) * (z * z * (one - z * (constant(3.0) - 3.0 * z + z * z)));

  const auto& p = gap_.position_w_m;
  const auto& l = gap_.winch_m;
  Command out = reference;
  out.position_w_m = out.position_w_m + value * Eigen::Vector3d(p.value) + slope * Eigen::Vector3d(p.first) +
                     curvature * Eigen::Vector3d(p.second);
  out.winch_m = out.winch_m + l.value * value + l.first * slope + l.second * curvature;
  return out;
}

}  // namespace gyre::agent
