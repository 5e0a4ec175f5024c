#pragma once
// How strongly the cables hold the load in place while every carrier follows its reference.
//
//   symbol     meaning                                             shape   unit
//   k          cable stiffness                                     1       N/m
//   f, s, q, l force, tension, direction, length of a cable        (reference.hpp)
//   r          lever arm of its attachment                         3       m
//   J          [I, −[r]x]: attachment motion from load motion      3x6
//
//   K = sum J' [k q q' + (s/l)(I − q q')] J + (0 (+) ((f·r) I − sym(f r')))
//
// The first bracket is the cable's elasticity along q and its pendulum stiffness across; the last term is how the
// moment of a constant force changes when the load turns under it. The smallest generalised eigenvalue of K against
// (m I, R J_b R') is the square of the slowest frequency with which the load would swing if everything stood still at
// that moment; where it is negative, the load is not pulled back then. Whether a motion is stable over its period is
// another question, which neither sign answers.
//
// Reference: docs/design.md, fact 6.

#include <Eigen/Core>
#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/plan.hpp"
#include "common/mechanics/reference.hpp"

namespace gyre::mechanics {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One cable's share of K: of cable `c` as `reference` has it, its attachment `r_w_m` from the load's place.
void add_stiffness(const Cable& c, const Reference& reference, const Eigen::Vector3d& r_w_m, Matrix6d& k_load);

/// K at one moment; rows and columns are (translation, rotation), W. `t_s` since the plan's epoch. Of cables that are
/// taut and longer than nothing; not finite else.
[[nodiscard]] Matrix6d load_stiffness(const Plan& plan, const std::vector<CarrierSlice>& slices, double t_s);

/// Mass matrix (m I, R J_b R'), W.
[[nodiscard]] Matrix6d load_inertia(const Load& load);

/// The smallest generalised eigenvalue over one period [1/s²]: a grid, refined by Brent's method in its valleys.
/// Found numerically, not proven: a bound through the cables' k would be a thousand times too wide to be of use.
[[nodiscard]] double least_stiffness(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s);

}  // namespace gyre::mechanics
