#pragma once
// The extremes over all time of a quotient of trigonometric polynomials, found through its critical points.
//
//   F = N · prod D_i^(p_i / 2),  D_i > 0          F' = prod D_i^(p_i/2 − 1) · T
//   T = N' prod D_i + N sum (p_i / 2) D_i' prod_{j != i} D_j                                     (critical polynomial)
//
// The naive way samples F and hopes; eigenvalues of a companion matrix find the roots of T but say little when two of
// them meet, and nothing when F is constant (a carrier that flies a circle). Here the circle is cut into cells, and
// each cell is settled by a proof from the coefficients of T: it holds no root; or it holds at most one, which Newton
// finds; or F cannot change across it by more than rounding. What is left is halved.
//
// Reference: docs/design.md, fact 1; Newton's condition is Kantorovich's.

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
