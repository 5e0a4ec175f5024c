#pragma once
// How far the carriers' clocks may disagree before the load notices.
//
//   symbol    meaning                                                    unit
//   e_i       clock error of carrier i against swarm time                s
//   df_i      rate of change of its force                                N/s
//   K         load stiffness (stiffness.hpp)
//
//   residual force = |sum df_i e_i|,  displacement = |K^-1 sum J_i' df_i e_i|
//
// A common shift moves nobody out of equilibrium (sum df_i = 0), so only disagreement counts. With all errors within an
// interval of width e they can be taken as at most e/2 from its middle, and |f_i(t + e_i) − f_i(t)| <= max|df_i| |e_i|
// for every t: the residual is at most (e/2) sum max|df_i|. That is a proof; the displacement is its linear
// consequence, found on a grid.
//
// Reference: docs/design.md, facts 4 and 6.

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/plan.hpp"

namespace gyre::mechanics {

struct SkewBudget {
  double residual_n_per_s = 0.0;      ///< residual force per second of disagreement, at most
  double displacement_m_per_s = 0.0;  ///< of the load, per second that one carrier's clock is off, at its worst
  double budget_s = 0.0;              ///< disagreement that keeps the residual under kSkewShare of the weight
  double holdover_s = 0.0;            ///< until clocks kHoldoverDrift apart have used the budget up
};

inline constexpr double kSkewShare = 0.01;
inline constexpr double kHoldoverDrift = 20e-6;

/// Infinite budget and holdover for a plan that does not move. `period_s` as in the certificate.
[[nodiscard]] SkewBudget skew_budget(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s);

/// The budget alone, from slices and the weight they carry together; what a coordinator needs of any plan.
[[nodiscard]] double skew_budget_s(const std::vector<CarrierSlice>& slices, double weight_n);

}  // namespace gyre::mechanics
