#pragma once
// Where two straight pieces come closest: segments, rays and points.
//
//   x(s) = start + s · along,   0 <= s <= reach          reach 1: a segment; infinite: a ray; along = 0: a point
//
// |x(s) − y(t)|² is convex in (s, t), so the least is found by minimising over one and clamping the other.
// Reference: C. Ericson, Real-Time Collision Detection, section 5.1.9.

#include <Eigen/Core>
#include <algorithm>

namespace gyre::mechanics {

struct Segment {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  double reach = 1.0;

  [[nodiscard]] Eigen::Vector3d at(double s) const { return start + s * along; }
};

struct ClosestPoints {
  double s = 0.0, t = 0.0;                          ///< along the first and along the second
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();  ///< from the second to the first
};

/// At most one of them endless. Of parallels any of the closest pairs.
[[nodiscard]] inline ClosestPoints closest_points(const Segment& x, const Segment& y) {
  const Eigen::Vector3d r = x.start - y.start;
  const double a = x.along.squaredNorm();
  const double e = y.along.squaredNorm();
  const double b = x.along.dot(y.along);
  const double c = x.along.dot(r);
  const double f = y.along.dot(r);
  ClosestPoints out;
  const double denominator = a * e - b * b;
  // Of parallels the denominator is rounding: any s is as good as another.
  if (denominator > 1e-14 * a * e) out.s = std::clamp((b * f - c * e) / denominator, 0.0, x.reach);
  if (e > 0.0) out.t = std::clamp((b * out.s + f) / e, 0.0, y.reach);
  if (a > 0.0) out.s = std::clamp((b * out.t - c) / a, 0.0, x.reach);
  out.apart = x.at(out.s) - y.at(out.t);
  return out;
}

}  // namespace gyre::mechanics
