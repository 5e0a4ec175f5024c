#pragma once
// The extremes over all time of a quotient of trigonometric polynomials, found through its critical points.
//
//   F = N · prod D_i^(p_i / 2),  D_i > 0          F' = prod D_i^(p_i/2 − 1) · T
//   T = N' prod D_i + N sum (p_i / 2) D_i' prod_{j != i} D_j                                     (critical polynomial)
//
// The naive way samples F and hopes. Here every root of T is found (roots.hpp), but where F cannot change across a cell
// by more than rounding: all along, when F is constant (a carrier that flies a circle).
//
// Reference: docs/design.md, fact 1.

#include <initializer_list>
#include <vector>

#include "common/mechanics/range.hpp"
#include "common/mechanics/trig_polynomial.hpp"

namespace gyre::mechanics {

/// D^(half_power / 2), with D positive for every psi and `range` its extremes.
struct Factor {
  const TrigPolynomial* base;
  Range range;
  int half_power;
};

/// Outward of the true extremes by rounding (1e-13 of the greatest magnitude) at most, and by nothing where F is
/// constant.
[[nodiscard]] Range extremes(const TrigPolynomial& numerator, std::initializer_list<Factor> factors = {});

}  // namespace gyre::mechanics
