#include "common/mechanics/separation.hpp"

#include <algorithm>
#include <cmath>

namespace gyre::mechanics {
namespace {

/// The least distance met so far, and what has to be proven to be done: nothing is closer than the floor.
class Least {
 public:
  /// True if this is a new least.
  bool include(double square) {
    if (square >= square_) return false;
    square_ = square;
    const double distance = std::sqrt(square);
    floor_ = std::max(0.0, distance - kSeparationSlack_m - 1e-9 * distance);  // the second for rounding at km
    return true;
  }
  [[nodiscard]] double square() const { return square_; }
  [[nodiscard]] double floor() const { return floor_; }

 private:
  double square_ = std::numeric_limits<double>::infinity();
  double floor_ = std::numeric_limits<double>::infinity();
};

/// A sphere that holds a whole orbit: most pairs of a large swarm are told apart by these alone.
struct Sphere {
  Eigen::Vector3d centre;
  double radius;
};

Sphere enclose(const Path& path, double begin_s, double end_s) {
  constexpr int kSamples = 64;
  const double step_s = (end_s - begin_s) / kSamples;
  std::vector<Eigen::Vector3d> points;
  points.reserve(kSamples);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  for (int i = 0; i < kSamples; ++i) {
    points.push_back(path.position_w_m(begin_s + step_s * (i + 0.5)).value);
    low = low.cwiseMin(points.back());
    high = high.cwiseMax(points.back());
  }
  Sphere sphere{0.5 * (low + high), 0.0};
  for (const Eigen::Vector3d& p : points) sphere.radius = std::max(sphere.radius, (p - sphere.centre).norm());
  sphere.radius += 0.5 * path.speed_max_m_s * step_s;  // the way to the nearest sample
  return sphere;
}

class Pair {
 public:
  Pair(const Path& a, const Path& b)
      : a_(a), b_(b), accelerations_(a.acceleration_max_m_s2 + b.acceleration_max_m_s2) {}

  /// Lowers `least` where this pair comes closer, on the cell of half width h around t; true if it did.
  bool search(double t, double h, Least& least) const {
    const TaylorVector<double> a = a_.position_w_m(t);
    const TaylorVector<double> b = b_.position_w_m(t);
    const Eigen::Vector3d d = a.value - b.value;
    const double square = d.squaredNorm();
    bool closer = least.include(square);
    if (least.floor() == 0.0) return closer;  // they touch: nothing is closer than that
    const double slope = 2.0 * std::abs(d.dot(a.first - b.first));
    // F >= F(t) − |F'(t)| h − |D(t)| (a_i + a_j) h²
    const double bound = square - slope * h - std::sqrt(square) * accelerations_ * h * h;
    if (bound >= least.floor() * least.floor()) return closer;
    closer |= search(t - 0.5 * h, 0.5 * h, least);
    closer |= search(t + 0.5 * h, 0.5 * h, least);
    return closer;
  }

 private:
  const Path& a_;
  const Path& b_;
  double accelerations_;
};

}  // namespace

std::optional<Separation> separation(const std::vector<Path>& paths, double begin_s, double end_s) {
  if (paths.size() < 2) return std::nullopt;
  std::vector<Sphere> spheres;
  for (const Path& path : paths) {
    if (!std::isfinite(path.acceleration_max_m_s2)) return std::nullopt;
    spheres.push_back(enclose(path, begin_s, end_s));
  }
  struct Candidate {
    double gap;
    std::size_t i, j;
  };
  std::vector<Candidate> pairs;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = i + 1; j < paths.size(); ++j) {
      const double gap = (spheres[i].centre - spheres[j].centre).norm() - spheres[i].radius - spheres[j].radius;
      pairs.push_back({gap, i, j});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Candidate& a, const Candidate& b) { return a.gap < b.gap; });

  Least least;
  Separation result;
  for (const auto& [gap, i, j] : pairs) {
    if (gap > 0.0 && gap * gap >= least.square()) break;  // sorted: no later pair can come closer
    const Pair pair(paths[i], paths[j]);
    constexpr int kCells = 64;
    const double h = 0.5 * (end_s - begin_s) / kCells;
    bool closer = false;
    for (int c = 0; c < kCells; ++c) closer |= pair.search(begin_s + h * (2 * c + 1), h, least);
    if (!closer) continue;
    result.first = paths[i].id;
    result.second = paths[j].id;
  }
  result.min_m = least.floor();
  return result;
}

}  // namespace gyre::mechanics
