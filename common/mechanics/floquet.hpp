#pragma once
// How fast the solutions of a linear equation with periodic coefficients grow.
//
//   symbol   meaning                                              shape   unit
//   M        inertia, constant, positive definite                 6x6     kg, kg m²
//   K, C, N  stiffness, damping, circulation, of period T         6x6     N/m, N s/m, N/m, and the like of moments
//   p        pace: how fast the coefficients pass, 1 as given     1       -
//   Phi      what one period does to (x, x'), its monodromy       12x12
//   rho      eigenvalues of Phi, Floquet's multipliers            12      -
//
//   M x'' + C(p t) x' + (K(p t) + p N(p t)) x = 0                 growth = ln(max |rho|) / (T / p)
//
// Floquet: after every period the solution is Phi times what it was, so it dies out exactly when every |rho| < 1, and
// what it does in between does not matter.
//
// Found numerically, not proven. The equation is stiff (cables settle in microseconds, loads swing in seconds), so it
// is integrated by Radau IIA with three stages, of order five, which is stable however stiff it is. In its second order
// form: the stages' accelerations a_i are the only unknowns,
//
//   v_i = v + h sum A_ij a_j       x_i = x + c_i h v + h² sum (A²)_ij a_j       M a_i + C_i v_i + (K_i + p N_i) x_i = 0
//
// What it does to an oscillation of omega: it damps it by omega (omega h)^5 / 7200 too much [1/s].
//
// Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.5 (Radau IIA).

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/mechanics/stiffness.hpp"

namespace gyre::mechanics {

/// The coefficients at one moment.
struct LinearMoment {
  Matrix6d stiffness = Matrix6d::Zero();
  Matrix6d damping = Matrix6d::Zero();
  Matrix6d circulation = Matrix6d::Zero();
};

inline constexpr int kRadauStages = 3;

/// Where within a step its three stages lie, as parts of it; the last is its end.
[[nodiscard]] const std::array<double, kRadauStages>& radau_nodes();

/// [1/s], negative where everything dies out. `moments`: three for each of the equal steps that make up the period, at
/// the nodes, at least one step. `period_s` at pace 1. NaN of what is not finite.
[[nodiscard]] double floquet_growth(const Matrix6d& inertia, const std::vector<LinearMoment>& moments, double period_s,
                                    double pace = 1.0);

}  // namespace gyre::mechanics
