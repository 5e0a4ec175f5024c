#pragma once
// A line through fewer points that looks the same.

#include <vector>

#include "ground/plot/core/svg.hpp"

namespace gyre::ground {

/// Every point of the old line is within `tolerance` of the new one, whose points are among the old ones; both ends
/// stay (Douglas and Peucker).
[[nodiscard]] std::vector<Point> simplified(const std::vector<Point>& points, double tolerance);

}  // namespace gyre::ground
