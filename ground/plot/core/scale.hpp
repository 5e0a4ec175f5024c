#pragma once
// From figures to px, and the round figures an axis shows.

#include <cmath>
#include <string>
#include <vector>

#include "common/base/text.hpp"
#include "common/mechanics/range.hpp"

namespace gyre::ground {

/// A straight line through two pairs: `shown.min` is drawn at `at_min`, `shown.max` at `at_max`.
struct Scale {
  mechanics::Range shown;
  double at_min = 0.0, at_max = 1.0;

  [[nodiscard]] double operator()(double figure) const {
    return at_min + (figure - shown.min) / shown.span() * (at_max - at_min);
  }
};

inline const std::string kMinus = "\u2212";

struct Tick {
  double figure;
  std::string words;
};

/// Multiples of 1, 2 or 5 times a power of ten, at most `most` of them.
[[nodiscard]] inline std::vector<Tick> ticks(const mechanics::Range& shown, int most) {
  const double least_step = shown.span() / most;
  const double power = std::pow(10.0, std::floor(std::log10(least_step)));
  const double step = (least_step <= power         ? 1.0
                       : least_step <= 2.0 * power ? 2.0
                       : least_step <= 5.0 * power ? 5.0
                                                   : 10.0) *
                      power;
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step * (1.0 + 1e-9)))));
  const double first = std::ceil(shown.min / step - 1e-9);
  std::vector<Tick> out;
  for (int k = 0; k <= most && (first + k) * step <= shown.max + 1e-9 * step; ++k) {
    const double figure = (first + k) * step;
    const bool below_zero = figure < -0.5 * step;
    out.push_back({figure, (below_zero ? kMinus : "") + text("%.*f", decimals, std::abs(figure))});
  }
  return out;
}

}  // namespace gyre::ground
