#pragma once
// The certificate: what a plan does at its worst, over all time, and whether that is allowed.
//
// Intuition: with one rate every force runs on an ellipse, so every figure of the motion is a quotient of
// trigonometric polynomials, and its extremes are among the roots of another one. They are found, not sampled. Only
// the distance between carriers has no such form; it is bounded by branch and bound with a bound on its second
// derivative that follows from the exact speeds and accelerations: still a proof.
//
// The verdict is "admissible" exactly when `reasons` is empty. A reason names the paper's rule that is broken, the
// carrier, and what would cure it. Figures are given for refused plans too, as far as they exist (infinite where a
// length law has no bounded length).
//
// Reference: DESIGN section 1, the table of rules and facts 1 and 6.

#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/mechanics/range.hpp"
#include "common/mechanics/skew.hpp"

namespace gyre::mechanics {

enum class Rule {
  kOneCarrierImpossibility,
  kTwoCarrierObstruction,
  kTwoCarrierConstruction,
  kRank,
  kPlane,
  kPhaseCondition,
  kInfeasibleEquilibrium,
  kNonStop,
  kTension,
  kVerticalCosine,
  kDirectionCosine,
  kLengthBounds,
  kWinchRate,
  kSpeed,
  kAcceleration,
  kSeparation,
  kStiffness,
};

/// The rule as a person reads it, in the paper's words: "two-carrier obstruction".
[[nodiscard]] const char* name(Rule rule);

struct Reason {
  Rule rule = Rule::kTension;
  std::optional<CarrierId> carrier;
  std::string text;
};

/// Extremes over all time, outward of the true ones by rounding only.
struct CarrierFigures {
  CarrierId id = 0;
  Range tension_n;
  Range length_m;
  Range winch_rate_m_s;  ///< signed: paying out is positive
  Range speed_m_s;
  double acceleration_max_m_s2 = 0.0;
  Range altitude_m;       ///< of the carrier, W
  Range vertical_cosine;  ///< q_z
  /// min |u·q| of a projection law; absent for sine and fixed, which have no u.
  std::optional<double> direction_cosine_min;

  [[nodiscard]] double winch_rate_max_m_s() const { return std::max(winch_rate_m_s.max, -winch_rate_m_s.min); }
};

struct Separation {
  double min_m = std::numeric_limits<double>::infinity();  ///< proven lower bound, attained to 2e-7 m
  CarrierId first = 0, second = 0;                         ///< the pair that comes so close
};

struct Certificate {
  std::vector<Reason> reasons;
  /// What breaks no rule but deserves a look. A stiffness that is negative at some moments is here: the stability of a
  /// motion is decided over its whole period, and passing moments alone do not decide it.
  std::vector<Reason> cautions;
  double period_s = 0.0;
  double wrench_error_max_n = 0.0;
  Separation separation;
  /// Smallest generalised eigenvalue of the load's stiffness against (m I, J) over all time [1/s²] (stiffness.hpp).
  double stiffness_min_1_s2 = 0.0;
  SkewBudget skew;                       ///< with `stiffness` only
  std::vector<CarrierFigures> carriers;  ///< in the plan's order

  [[nodiscard]] bool admissible() const { return reasons.empty(); }
};

/// What to compute: the parts that are not per-carrier cost more (pairs, eigenvalues) and can be left out.
struct CertifyOptions {
  bool separation = true;
  bool stiffness = true;
  bool non_stop = true;  ///< off for a plan that is meant to stand still
};

[[nodiscard]] Certificate certify(const Plan& plan, const CertifyOptions& options = {});

}  // namespace gyre::mechanics
