#include "common/mechanics/separation.hpp"

#include <algorithm>
#include <cmath>

#include "common/mechanics/reference.hpp"

namespace gyre::mechanics {
namespace {

/// Of the squared distance: half of it is the relative tolerance of the distance.
constexpr double kTolerance = 2e-7;

/// A sphere that holds a whole orbit: most pairs of a large swarm are told apart by these alone.
struct Sphere {
  Eigen::Vector3d centre;
  double radius;
};

Sphere enclose(const CarrierSlice& slice, double speed_max_m_s, double period_s) {
  constexpr int kSamples = 64;
  std::vector<Eigen::Vector3d> points;
  points.reserve(kSamples);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
  for (int i = 0; i < kSamples; ++i) {
    points.push_back(evaluate(slice, period_s * i / kSamples).position_w_m.value);
    low = low.cwiseMin(points.back());
    high = high.cwiseMax(points.back());
  }
  Sphere sphere{0.5 * (low + high), 0.0};
  for (const Eigen::Vector3d& p : points) sphere.radius = std::max(sphere.radius, (p - sphere.centre).norm());
  sphere.radius += 0.5 * speed_max_m_s * period_s / kSamples;  // the way to the nearest sample
  return sphere;
}

class Pair {
 public:
  Pair(const CarrierSlice& a, const CarrierSlice& b, double speeds_m_s, double accelerations_m_s2)
      : a_(a), b_(b), speeds_(speeds_m_s), accelerations_(accelerations_m_s2) {}

  /// Lowers `least_square` where this pair comes closer.
  void search(double t, double h, double& least_square) const {
    const Reference a = evaluate(a_, t);
    const Reference b = evaluate(b_, t);
    const Eigen::Vector3d d = a.position_w_m.value - b.position_w_m.value;
    const Eigen::Vector3d rate = a.position_w_m.first - b.position_w_m.first;
    const double square = d.squaredNorm();
    least_square = std::min(least_square, square);
    const double reach = std::sqrt(square) + speeds_ * h;
    const double bound = square - 2.0 * std::abs(d.dot(rate)) * h - reach * accelerations_ * h * h;
    if (bound >= least_square * (1.0 - kTolerance)) return;
    if (speeds_ * h <= 1e-9) return;  // carriers that touch: no relative tolerance of zero can be met
    search(t - 0.5 * h, 0.5 * h, least_square);
    search(t + 0.5 * h, 0.5 * h, least_square);
  }

 private:
  const CarrierSlice& a_;
  const CarrierSlice& b_;
  double speeds_;
  double accelerations_;
};

}  // namespace

Separation separation(const std::vector<CarrierSlice>& slices, const std::vector<CarrierFigures>& figures,
                      double period_s) {
  Separation result;
  for (const CarrierFigures& f : figures) {
    if (slices.size() < 2) return result;
    if (!std::isfinite(f.acceleration_max_m_s2)) return {0.0, f.id, f.id};
  }
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    spheres.push_back(enclose(slices[i], figures[i].speed_m_s.max, period_s));
  }
  struct Candidate {
    double gap;
    std::size_t i, j;
  };
  std::vector<Candidate> pairs;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    for (std::size_t j = i + 1; j < slices.size(); ++j) {
      const double gap = (spheres[i].centre - spheres[j].centre).norm() - spheres[i].radius - spheres[j].radius;
      pairs.push_back({gap, i, j});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Candidate& a, const Candidate& b) { return a.gap < b.gap; });

  double least_square = std::numeric_limits<double>::infinity();
  for (const auto& [gap, i, j] : pairs) {
    if (gap > 0.0 && gap * gap >= least_square) break;  // sorted: no later pair can come closer
    const Pair pair(slices[i], slices[j], figures[i].speed_m_s.max + figures[j].speed_m_s.max,
                    figures[i].acceleration_max_m_s2 + figures[j].acceleration_max_m_s2);
    const double before = least_square;
    constexpr int kCells = 64;
    for (int c = 0; c < kCells; ++c) {
      pair.search(period_s * (c + 0.5) / kCells, 0.5 * period_s / kCells, least_square);
    }
    if (least_square < before) {
      result.first = slices[i].id;
      result.second = slices[j].id;
    }
  }
  result.min_m = std::sqrt(least_square * (1.0 - kTolerance));
  return result;
}

}  // namespace gyre::mechanics
