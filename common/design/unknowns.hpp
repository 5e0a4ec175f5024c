#pragma once
// The numbers of a plan as functions of the variables of a search, so that forces stay linear in them.
//
//   symbol            meaning                                                           unit
//   x                 variables of the search, of the order of 1                        -
//   value             a number of the plan, constant + factor · x[index]                its own
//   a_j, b_j          sine and cosine share of edge j's internal force                  N
//
//   lambda_j = offset_j + a_j sin(theta) + b_j cos(theta),   amplitude_j = √(a_j² + b_j²),  phase_j = atan2(b_j, a_j)
//
// Two sets of variables. The family of a plan keeps its shape: one factor each for all amplitudes, all offsets, all
// heights above the attachments, and the rate; so what its phases give exactly, such as circles flown at constant
// speed, it keeps exactly. The whole has every open number by itself.
//
// Source: Franchi, Landi, Gabellieri, cycle parameters. Reference: docs/design.md, fact 2.

#include <vector>

#include "common/design/requirements.hpp"

namespace gyre::design {

/// A number of the plan; index < 0: given.
struct Slot {
  int index = -1;
  double factor = 0.0;
  double constant = 0.0;

  [[nodiscard]] double at(const Eigen::VectorXd& x) const {
    return index < 0 ? constant : constant + factor * x[index];
  }
};

struct EdgeSlots {
  Slot offset_n, sine_n, cosine_n;
};
struct LawSlots {
  Slot mean_m, swing_m, phase_rad;
};

struct Unknowns {
  Slot rate_rad_s;
  std::vector<EdgeSlots> edges;  ///< of the plan's edges
  std::vector<LawSlots> laws;    ///< of the plan's carriers
  Eigen::VectorXd start, lower, upper;
};

/// What a search may never leave, where nothing was given.
struct Bounds {
  double rate_min_rad_s, rate_max_rad_s;
  double force_n;                         ///< of |offset|, |a|, |b|
  double altitude_min_m, altitude_max_m;  ///< W
  double length_max_m;
};

/// `plan` is whole, and says where to start; both of its shape.
[[nodiscard]] Unknowns family_of(const mechanics::Plan& plan, const Open& open, const Bounds& bounds);
[[nodiscard]] Unknowns whole_of(const mechanics::Plan& plan, const Open& open, const Bounds& bounds);

/// `plan` with the numbers that x stands for.
[[nodiscard]] mechanics::Plan plan_at(const mechanics::Plan& plan, const Unknowns& unknowns, const Eigen::VectorXd& x);

}  // namespace gyre::design
