#include "common/protocol/pace.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/ensure.hpp"
#include "common/mechanics/quintic.hpp"

namespace gyre::protocol {
namespace {

/// Whatever ramp somebody may tell: no plan time gets so far off by it that sums would overflow (kLongest).
Duration bounded(double ns, double longest) {
  const double most = longest * static_cast<double>(kLongest.count());
  return Duration(std::llround(std::clamp(ns, -most, most)));
}

/// To the nanosecond; at a pace of 1 exactly the time that has passed.
Duration scaled(double pace, Duration elapsed) {
  return bounded(pace * static_cast<double>(elapsed.count()), 2.5);
}

}  // namespace

PlanMoment Ramp::at(SwarmTime time) const {
  const Duration elapsed = time - start;
  if (elapsed < Duration::zero()) return {from.at + scaled(from.pace, elapsed), from.pace, 0.0, 0.0};
  const double elapsed_s = seconds(elapsed);
  const double length_s = seconds(duration);
  const double fade_s = seconds(std::min(duration, kSlopeFades));
  const double gap = from.pace - target;
  const double slope = from.rate_1_s * fade_s;
  const double bend = from.curvature_1_s2 * fade_s * fade_s;
  // At the end, and not only close to it, x and y are 1: whoever looks later gains the same.
  const bool complete = elapsed >= duration;
  const double x = complete ? 1.0 : elapsed_s / length_s;
  const double y = complete || elapsed_s >= fade_s ? 1.0 : elapsed_s / fade_s;
  // On the target's pace.
  const Duration gained = bounded(
      1e9 * (length_s * gap * mechanics::value_left_integral(x) +
             fade_s * (slope * mechanics::slope_left_integral(y) + bend * mechanics::curvature_left_integral(y))),
      0.1);
  const PlanTime at = from.at + scaled(target, elapsed) + gained;
  if (complete) return {at, target, 0.0, 0.0};
  const mechanics::Taylor<double> by_x = mechanics::progress(elapsed_s, length_s);
  const mechanics::Taylor<double> by_y = mechanics::progress(elapsed_s, fade_s);
  const mechanics::Taylor<double> left =
      gap * mechanics::value_left(by_x) + slope * mechanics::slope_left(by_y) + bend * mechanics::curvature_left(by_y);
  return {at, target + left.value, left.first, left.second};
}

bool operator==(const Ramp& a, const Ramp& b) {
  return a.start == b.start && a.duration == b.duration && a.from.at == b.from.at && a.from.pace == b.from.pace &&
         a.from.rate_1_s == b.from.rate_1_s && a.from.curvature_1_s2 == b.from.curvature_1_s2 && a.target == b.target;
}

RampPeaks peaks(const Ramp& ramp, double speed_max_m_s, double acceleration_max_m_s2) {
  RampPeaks out{std::max(std::abs(ramp.from.pace), std::abs(ramp.target)),
                ramp.target * ramp.target * acceleration_max_m_s2};
  if (ramp.duration <= Duration::zero()) return out;
  const double length_s = seconds(ramp.duration);
  const Duration fades = std::min(ramp.duration, kSlopeFades);
  const double fade_s = seconds(fades);
  const double gap = std::abs(ramp.from.pace - ramp.target);
  const double slope = std::abs(ramp.from.rate_1_s);
  const double bend = std::abs(ramp.from.curvature_1_s2);
  // While the slope fades, and after that.
  const auto look = [&](Duration begin, Duration end, double of_slope) {
    constexpr int kCells = 256;
    double pace = 0.0;
    double acceleration = 0.0;
    for (int i = 0; i <= kCells; ++i) {
      const PlanMoment there = ramp.at(ramp.start + begin + (end - begin) * i / kCells);
      pace = std::max(pace, std::abs(there.pace));
      acceleration = std::max(
          acceleration, there.pace * there.pace * acceleration_max_m_s2 + std::abs(there.rate_1_s) * speed_max_m_s);
    }
    // Between two points h apart a function exceeds both by h²/8 max|f''| at most; here are the greatest of |pace'|,
    // |pace''| and |pace'''|, by those of v, s and c.
    const double first = 1.875 * gap / length_s + of_slope * (slope + 0.1 * bend * fade_s);
    const double second = 5.78 * gap / (length_s * length_s) + of_slope * (3.95 * slope / fade_s + bend);
    const double third =
        60.0 * gap / std::pow(length_s, 3) + of_slope * (36.0 * slope / (fade_s * fade_s) + 9.0 * bend / fade_s);
    const double h_s = seconds(end - begin) / kCells;
    const double hidden = h_s * h_s / 8.0;
    pace += hidden * second;
    acceleration += hidden * (2.0 * (first * first + pace * second) * acceleration_max_m_s2 + third * speed_max_m_s);
    out.pace = std::max(out.pace, pace);
    out.acceleration_m_s2 = std::max(out.acceleration_m_s2, acceleration);
  };
  look(Duration::zero(), fades, 1.0);
  if (ramp.duration > fades) look(fades, ramp.duration, 0.0);
  return out;
}

PlanMoment Pace::at(SwarmTime time) const {
  GYRE_ENSURE(!ramps.empty(), "a pace axis has a beginning");
  const auto passing =
      std::find_if(ramps.rbegin(), std::prev(ramps.rend()), [time](const Ramp& r) { return r.start <= time; });
  return passing->at(time);
}

Pace Pace::with_ramp(SwarmTime start, Duration duration, double target) const {
  Pace out = *this;
  while (out.ramps.size() > 1 && out.ramps.back().start >= start) out.ramps.pop_back();
  const PlanMoment from = out.at(start);
  if (out.ramps.back().start >= start) out.ramps.pop_back();
  out.ramps.push_back({start, duration, from, target});
  return out;
}

bool Pace::settle(SwarmTime now) {
  std::size_t passing = ramps.size() - 1;
  while (passing > 0 && ramps[passing].start > now) --passing;
  ramps.erase(ramps.begin(), ramps.begin() + static_cast<std::ptrdiff_t>(passing));
  bool changed = passing > 0;
  Ramp& first = ramps.front();
  if (first.duration > Duration::zero() && now >= first.end()) {
    const PlanMoment there = first.at(first.end());
    first = {first.end(), Duration::zero(), there, first.target};
    changed = true;
  }
  return changed;
}

}  // namespace gyre::protocol
