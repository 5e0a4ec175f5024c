#pragma once
// How far the carriers' clocks may disagree before the load notices.
//
//   symbol    meaning                                                    unit
//   e_i       clock error of carrier i against swarm time                s
//   df_i      rate of change of its force                                N/s
//   r_i       its attachment, from the load's centre of mass             m
//   K         load stiffness (stiffness.hpp)
//
//   residual force = |sum df_i e_i|,  moment = |sum r_i × df_i e_i|,  displacement = |K^-1 sum J_i' df_i e_i|
//
// A common shift moves nobody out of equilibrium (sum df_i = 0), so only disagreement counts. With all errors within an
// interval of width e they can be taken as at most e/2 from its middle, and |f_i(t + e_i) − f_i(t)| <= max|df_i| |e_i|
// for every t: the residual is at most (e/2) sum max|df_i|. That is a proof; the displacement is its linear
// consequence, found on a grid.
//
// The moment needs no budget of its own. Measured by the weight at the greatest lever arm, the share of it that is left
// is no greater than that of the force: |sum r_i × df_i e_i| <= max|r_i| (e/2) sum max|df_i|.
//
// While a plan B comes in over A, f = (1 − w) f_A + w f_B changes by df = (1 − w) df_A + w df_B + w' (f_B − f_A), so
//
//   |df| <= max(|df_A|, |df_B|) + 15/8 / duration · max|f_B − f_A|
//
// and of transitions on top of others, one after the other: what lies below is a mixture, and no further from f_B than
// the furthest of what it is mixed from. Where two plans have one rate, their forces' difference is an ellipse as well.
// Transitions run on plan time, which passes no faster than swarm time but for a moment; so do clock errors.
//
// Reference: docs/design.md, facts 3, 4 and 6.

#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/plan.hpp"
#include "common/mechanics/transition.hpp"

namespace gyre::mechanics {

struct SkewBudget {
  double residual_n_per_s = 0.0;      ///< residual force per second of disagreement, at most
  double displacement_m_per_s = 0.0;  ///< of the load, per second that one carrier's clock is off, at its worst
  double budget_s = 0.0;              ///< disagreement that keeps the residual under kSkewShare of the weight
  double holdover_s = 0.0;            ///< until clocks kHoldoverDrift apart have used the budget up
  double residual_n_m_per_s = 0.0;    ///< residual moment per second of disagreement, at most
};

inline constexpr double kSkewShare = 0.01;
inline constexpr double kHoldoverDrift = 20e-6;

/// Infinite budget and holdover for a plan that does not move. `period_s` as in the certificate.
[[nodiscard]] SkewBudget skew_budget(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s);

/// The budget alone, from slices and the weight they carry together; what a coordinator needs of any plan.
[[nodiscard]] double skew_budget_s(const std::vector<CarrierSlice>& slices, double weight_n);

/// ... while transitions are under way, or before they begin; one stack for each carrier, as for evaluate_course.
[[nodiscard]] double skew_budget_s(const std::vector<std::vector<TimedLayer>>& stacks, double weight_n);

}  // namespace gyre::mechanics
