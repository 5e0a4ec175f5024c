#include "ground/plot/core/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gyre::ground {
namespace {

double distance(Point p, Point from, Point to) {
  const double x = to.x - from.x, y = to.y - from.y;
  const double length2 = x * x + y * y;
  const double along = length2 > 0.0 ? std::clamp(((p.x - from.x) * x + (p.y - from.y) * y) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - from.x - along * x, p.y - from.y - along * y);
}

}  // namespace

std::vector<Point> simplified(const std::vector<Point>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> stays(points.size(), false);
  stays.front() = stays.back() = true;
  // Not by recursion: a line may be as many points deep.
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t furthest = from;
    double most = tolerance;
    for (std::size_t k = from + 1; k < to; ++k) {
      const double off = distance(points[k], points[from], points[to]);
      if (off <= most) continue;
      most = off;
      furthest = k;
    }
    if (furthest == from) continue;
    stays[furthest] = true;
    open.emplace_back(from, furthest);
    open.emplace_back(furthest, to);
  }
  std::vector<Point> out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (stays[k]) out.push_back(points[k]);
  }
  return out;
}

}  // namespace gyre::ground
