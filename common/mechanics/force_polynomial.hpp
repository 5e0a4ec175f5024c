#pragma once
// A carrier's force as trigonometric polynomials: what every exact figure starts from.
//
//   f(psi) = f0 + lambda_in delta + lambda_out deltabar,   theta = denominator · psi       vector, degree = denominator
//
// Source: Franchi, Landi, Gabellieri, local force; docs/design.md, fact 1 (an orbit is an ellipse).

#include <array>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/trig_polynomial.hpp"

namespace gyre::mechanics {

using PolynomialVector = std::array<TrigPolynomial, 3>;

/// `denominator` >= 1: the turns of the cycle in one of psi.
[[nodiscard]] PolynomialVector force_polynomial(const CarrierSlice& slice, int denominator);

[[nodiscard]] TrigPolynomial dot(const PolynomialVector& a, const PolynomialVector& b);
[[nodiscard]] TrigPolynomial dot(const Eigen::Vector3d& a, const PolynomialVector& b);
[[nodiscard]] PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b);

}  // namespace gyre::mechanics
