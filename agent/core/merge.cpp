#include "agent/core/merge.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "common/mechanics/quintic.hpp"

namespace gyre::agent {
namespace {

using mechanics::curvature_left;
using mechanics::paced;
using mechanics::slope_left;
using mechanics::value_left;
using Number = mechanics::Taylor<double>;

/// Below this nobody could measure a step: rounding of the same reference computed twice.
constexpr double kNothing_m = 1e-9;
constexpr double kShortest_s = 1.0;
/// A load swings on cables of some metres within one to three seconds. Pushed by a gap that closes faster than that, it
/// goes on swinging: nothing but air damps it. Gaps below a millimetre push nobody.
constexpr double kUnpushed_s = 3.0;
constexpr double kUnnoticed_m = 1e-3;
/// Peaks of a gap that fades: in rate, of gap / T, in acceleration, of gap / T²; and of a rate that fades, of rate / T.
constexpr double kRatePeak = mechanics::kStepSlopePeak;
constexpr double kAccelerationPeak = mechanics::kStepCurvaturePeak;
constexpr double kStopPeak = mechanics::kSlopeLeftCurvaturePeak;

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
  return mechanics::progress(seconds(elapsed), seconds(duration));
}

/// A delay that fades in 15/8 of itself doubles the pace of the motion at most. The time that a carrier loses until it
/// has the motion's speed is made up for, too: by another half.
Duration delay_time(double delay_s) {
  return from_seconds(std::max(kUnpushed_s, kRatePeak * std::abs(delay_s)));
}
constexpr double kMadeUp = mechanics::kSlopeLeftReturnPeak;
/// A shorter gap is not worth the way along the path; and who lies further beside the path than this share of his gap
/// has not just fallen behind.
constexpr double kWorthIt_m = 0.01;
constexpr double kBeside = 0.5;

double distance_m(const Command& a, const Command& b) {
  return std::hypot((a.position_w_m.value - b.position_w_m.value).norm(), a.winch_m.value - b.winch_m.value);
}

/// The wire, and a beat on either side.
constexpr double kOnItsWay_s = 0.025;

/// Whoever is further ahead on a path that repeats is behind by the rest of it. What lies ahead is known only until the
/// lease ends, and that is told anew ten times a second; what is left of it when it is not extended any more is more.
constexpr double kMostAhead_s = 0.5;

/// What a motion asks for at most, and the delay [s] with which it comes nearest to a place.
struct Look {
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double winch_rate_m_s = 0.0;
  double nearest_s = 0.0;
};
Look look_along(const Path& path, SwarmTime now, const Command& place) {
  constexpr int kMoments = 64;
  const double step_s = seconds(*path.period) / kMoments;
  const double most_ahead_s = std::min(kMostAhead_s, 0.5 * seconds(*path.period));
  Look look;
  double least_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMoments; ++i) {
    const double delay_s = step_s * i - most_ahead_s;
    const Command c = path.at(now - from_seconds(delay_s));
    look.speed_m_s = std::max(look.speed_m_s, c.position_w_m.first.norm());
    look.acceleration_m_s2 = std::max(look.acceleration_m_s2, c.position_w_m.second.norm());
    look.winch_rate_m_s = std::max(look.winch_rate_m_s, std::abs(c.winch_m.first));
    if (const double m = distance_m(place, c); m < least_m) {
      least_m = m;
      look.nearest_s = delay_s;
    }
  }
  const auto squared_m2 = [&](double delay_s) {
    const double m = distance_m(place, path.at(now - from_seconds(delay_s)));
    return m * m;  // smooth where the place lies on the path
  };
  constexpr int kBits = 30;
  look.nearest_s = boost::math::tools::brent_find_minima(squared_m2, std::max(look.nearest_s - step_s, -most_ahead_s),
                                                         look.nearest_s + step_s, kBits)
                       .first;
  return look;
}

}  // namespace

std::optional<Merge::Delay> Merge::behind(SwarmTime now, const Command& flown, const Path& path) const {
  if (!path.period) return std::nullopt;
  const double straight_m = distance_m(flown, path.at(now));
  if (straight_m < kWorthIt_m) return std::nullopt;
  const Look look = look_along(path, now, flown);
  const Command there = path.at(now - from_seconds(look.nearest_s));
  if (distance_m(flown, there) > kBeside * straight_m) return std::nullopt;

  const Eigen::Vector3d& velocity = there.position_w_m.first;
  const double share = velocity.dot(flown.position_w_m.first) / velocity.squaredNorm();
  const double lost = std::isfinite(share) ? 1.0 - std::clamp(share, 0.0, 1.0) : 0.0;
  const double time_s = seconds(delay_time(look.nearest_s));
  const double pace = 1.0 + kRatePeak * std::abs(look.nearest_s) / time_s + kMadeUp * lost;
  const double change = (kAccelerationPeak * std::abs(look.nearest_s) / time_s + kStopPeak * lost) / time_s;
  const bool can = pace * look.speed_m_s <= limits_.speed_m_s && pace * look.winch_rate_m_s <= limits_.winch_rate_m_s &&
                   pace * pace * look.acceleration_m_s2 + change * look.speed_m_s <= limits_.acceleration_m_s2;
  if (!can) return std::nullopt;
  return Delay{look.nearest_s, lost};
}

/// And what the path asks for with it.
Command Merge::find_delay(SwarmTime now, const Command& flown, const Path& path) {
  start_ = now;
  const std::optional<Delay> delay = behind(now, flown, path);
  delay_ = delay.value_or(Delay{});
  delay_time_ = delay ? delay_time(delay->delay_s) : Duration::zero();
  return delayed(now, path);
}

void Merge::begin(SwarmTime now, const Command& flown, const Path& path) {
  close(flown, find_delay(now, flown, path));
}

void Merge::begin_at_vehicle(SwarmTime now, Duration age, Command told, const Path& path) {
  const Command present = path.at(now - age);
  const Eigen::Vector3d& velocity = present.position_w_m.first;
  const auto along = [&](const Eigen::Vector3d& v) {
    const double share = velocity.dot(v) / velocity.squaredNorm();
    return std::isfinite(share) ? share : 0.0;  // a path may stand still
  };
  const double share = std::clamp(along(told.position_w_m.first), 0.0, 1.0);
  if (share > 0.5) {
    const double ahead_s = along(told.position_w_m.value - present.position_w_m.value);
    age += from_seconds(std::clamp(-ahead_s, 0.0, kOnItsWay_s));
  }
  const Command reference = find_delay(now - age, told, path);
  told.position_w_m.second = share * share * reference.position_w_m.second;
  told.winch_m.second = share * share * reference.winch_m.second;
  // What gap and delay there are have grown since then.
  told.position_w_m.value += seconds(age) * (told.position_w_m.first - reference.position_w_m.first);
  told.winch_m.value += seconds(age) * (told.winch_m.first - reference.winch_m.first);
  if (delay_time_ > Duration::zero()) {
    delay_.delay_s += seconds(age) * delay_.rate;
    delay_time_ = delay_time(delay_.delay_s);
  }
  start_ = now;
  close(told, reference);
}

/// The gap between the two, and how long it takes to close it.
void Merge::close(const Command& flown, const Command& reference) {
  gap_.position_w_m = flown.position_w_m - reference.position_w_m;
  gap_.winch_m = flown.winch_m - reference.winch_m;
  const double position = gap_.position_w_m.value.norm();
  const double speed = gap_.position_w_m.first.norm();
  const double length = std::abs(gap_.winch_m.value);
  const double rate = std::abs(gap_.winch_m.first);
  under_way_ =
      delay_time_ > Duration::zero() || std::max(position, length) >= kNothing_m || std::max(speed, rate) >= kNothing_m;
  // Half of each limit: the other half is for the plan that goes on meanwhile.
  const double acceleration = 0.5 * limits_.acceleration_m_s2;
  const double shortest_s = std::max(position, length) > kUnnoticed_m ? kUnpushed_s : kShortest_s;
  value_time_ = std::max(gap_time(position, 0.5 * limits_.speed_m_s, acceleration, shortest_s),
                         gap_time(length, 0.5 * limits_.winch_rate_m_s, acceleration, shortest_s));
  rate_time_ = rate_time(std::max(speed, rate), acceleration, shortest_s);
}

Command Merge::delayed(SwarmTime now, const Path& path) const {
  const Duration elapsed = now - start_;
  if (elapsed >= delay_time_) return path.at(now);
  const Number x = progress(elapsed, delay_time_);
  const Number delay = delay_.delay_s * value_left(x) + (delay_.rate * seconds(delay_time_)) * slope_left(x);
  Command out = path.at(now - from_seconds(delay.value));
  out.position_w_m = paced(out.position_w_m, 1.0 - delay.first, -delay.second);
  out.winch_m = paced(out.winch_m, 1.0 - delay.first, -delay.second);
  return out;
}

Command Merge::apply(SwarmTime now, const Path& path) const {
  if (!under_way(now)) return path.at(now);
  const Duration elapsed = now - start_;
  const Number value = value_left(progress(elapsed, value_time_));
  const Number slope = seconds(rate_time_) * slope_left(progress(elapsed, rate_time_));
  const Number curvature = kShortest_s * kShortest_s * curvature_left(progress(elapsed, from_seconds(kShortest_s)));

  const auto& p = gap_.position_w_m;
  const auto& l = gap_.winch_m;
  Command out = delayed(now, path);
  out.position_w_m = out.position_w_m + value * Eigen::Vector3d(p.value) + slope * Eigen::Vector3d(p.first) +
                     curvature * Eigen::Vector3d(p.second);
  out.winch_m = out.winch_m + l.value * value + l.first * slope + l.second * curvature;
  return out;
}

}  // namespace gyre::agent
