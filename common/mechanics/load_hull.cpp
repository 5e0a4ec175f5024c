#include "common/mechanics/load_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gyre::mechanics {
namespace {

/// Of the hull's size: corners this near to a plane are in it.
constexpr double kRounding = 1e-9;

/// From the nearest point of the ray along `direction` (unit) to x.
Eigen::Vector3d off_ray(const Eigen::Vector3d& x, const Eigen::Vector3d& direction) {
  return x - std::max(0.0, x.dot(direction)) * direction;
}

}  // namespace

std::vector<Eigen::Vector3d> hull_w(const Load& load) {
  std::vector<Eigen::Vector3d> out;
  out.reserve(load.hull_b_m.size());
  for (const Eigen::Vector3d& corner : load.hull_b_m) {
    out.emplace_back(load.position_w_m + load.orientation_w_b * corner);
  }
  return out;
}

std::optional<LoadCone> LoadCone::seen_from(const Eigen::Vector3d& attachment_w_m,
                                            const std::vector<Eigen::Vector3d>& hull_w_m) {
  double size = 0.0;
  for (const Eigen::Vector3d& corner : hull_w_m) size = std::max(size, (corner - attachment_w_m).norm());
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3d& corner : hull_w_m) {
    const Eigen::Vector3d seen = corner - attachment_w_m;
    if (seen.norm() > kRounding * size) corners.emplace_back(seen);
  }
  LoadCone cone;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      const Eigen::Vector3d a = corners[i].normalized();
      const Eigen::Vector3d b = corners[j].normalized();
      Eigen::Vector3d normal = a.cross(b);
      if (normal.norm() <= kRounding) continue;  // along each other
      normal.normalize();
      double low = 0.0;
      double high = 0.0;
      for (const Eigen::Vector3d& corner : corners) {
        low = std::min(low, normal.dot(corner));
        high = std::max(high, normal.dot(corner));
      }
      if (high <= kRounding * size) cone.faces_.push_back({normal, a, b});
      if (low >= -kRounding * size) cone.faces_.push_back({-normal, a, b});
    }
  }
  if (cone.faces_.empty()) return std::nullopt;
  return cone;
}

Eigen::Vector3d LoadCone::off(const Eigen::Vector3d& place_m) const {
  Eigen::Vector3d nearest = place_m;  // the apex
  bool inside = true;
  const auto take = [&nearest](const Eigen::Vector3d& candidate) {
    if (candidate.squaredNorm() < nearest.squaredNorm()) nearest = candidate;
  };
  for (const Face& face : faces_) {
    const double height = face.normal.dot(place_m);
    if (height > 0.0) inside = false;
    // Is the foot between the face's two corners?  foot = alpha a + beta b
    const Eigen::Vector3d foot = place_m - height * face.normal;
    const double ab = face.a.dot(face.b);
    const double alpha = foot.dot(face.a) - ab * foot.dot(face.b);
    const double beta = foot.dot(face.b) - ab * foot.dot(face.a);
    if (alpha >= 0.0 && beta >= 0.0) {
      take(height * face.normal);
    } else {
      take(off_ray(place_m, face.a));
      take(off_ray(place_m, face.b));
    }
  }
  return inside ? Eigen::Vector3d::Zero() : nearest;
}

}  // namespace gyre::mechanics
