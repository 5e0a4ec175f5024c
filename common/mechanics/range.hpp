#pragma once
// The least and the greatest value a figure takes.

#include <algorithm>
#include <limits>

namespace gyre::mechanics {

struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void include(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  void include(const Range& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
  }
  [[nodiscard]] double span() const { return max - min; }
};

}  // namespace gyre::mechanics
