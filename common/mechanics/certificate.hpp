#pragma once
// The certificate: what a plan does at its worst, over all time, and whether that is allowed.
//
// Intuition: with one rate every force runs on an ellipse, so every figure of the motion is a quotient of
// trigonometric polynomials, and its extremes are among the roots of another one. They are found, not sampled. So are
// the moments at which cables may cross. Only distances have no such form; they are bounded by branch and bound, from
// the exact speeds and accelerations: still a proof.
//
// The verdict is "admissible" exactly when `reasons` is empty. A reason names the paper's rule that is broken, the
// carrier, and what would cure it. Figures are given for refused plans too, as far as they exist (infinite where a
// length law has no bounded length, or a cable goes slack). What is no plan at all (plan.hpp) has no figures, only
// reasons.
//
// Source: Franchi, Landi, Gabellieri: one-carrier impossibility, two-carrier obstruction and construction, level
// non-stop motion for n >= 3. Reference: docs/design.md, The mechanics, facts 1, 4 and 6.

#include <optional>
#include <string>
#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/mechanics/range.hpp"
#include "common/mechanics/skew.hpp"
#include "common/mechanics/swing.hpp"

namespace gyre::mechanics {

enum class Rule {
  kMalformedPlan,
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
  kWinch,
  kSpeed,
  kAcceleration,
  kThrust,
  kBank,
  kSeparation,
  kBraid,
  kClearance,
  kStiffness,
  kSwing,
};

/// The rule as a person reads it, in the paper's words: "two-carrier obstruction".
[[nodiscard]] const char* name(Rule rule);

struct Reason {
  Rule rule = Rule::kTension;
  std::optional<CarrierId> carrier;
  std::string text;
};

/// A vehicle as far as what it has to pull depends on it.
struct VehicleWeight {
  double mass_kg = 0.0;
  double gravity_m_s2 = 0.0;
};

/// Absent: the vehicle's mass is not known.
[[nodiscard]] inline std::optional<VehicleWeight> weight(const Vehicle& vehicle, double gravity_m_s2) {
  if (!vehicle.mass_kg) return std::nullopt;
  return VehicleWeight{*vehicle.mass_kg, gravity_m_s2};
}

/// Extremes over all time, outward of the true ones by rounding only; where they are proven bounds, what computes them
/// says so.
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
  Range paid_out_m;  ///< l − s/k: what the winch has out; l where stretch is not compensated
  Range paid_out_rate_m_s;
  double winch_acceleration_max_m_s2 = 0.0;  ///< of what is paid out
  /// What the vehicle pulls, m (a + g e_z) + f, and its greatest angle from the vertical, at every pace that may last:
  /// at pace p it is p² of that at full pace and 1 − p² of that at rest, so both are in it. Absent: its mass is not
  /// known.
  std::optional<double> thrust_max_n, bank_max_rad;

  [[nodiscard]] double winch_rate_max_m_s() const { return std::max(winch_rate_m_s.max, -winch_rate_m_s.min); }
  [[nodiscard]] double paid_out_rate_max_m_s() const { return std::max(paid_out_rate_m_s.max, -paid_out_rate_m_s.min); }
};

/// What comes close to what (clearance.hpp).
enum class Touch { kPlaces, kCables, kStrayingCable, kVehicleAndCable, kVehicles, kCableAndLoad };

/// As a person reads it: "cable and load".
[[nodiscard]] const char* name(Touch what);

/// How close, and who when.
struct Approach {
  double min_m = 0.0;  ///< proven lower bound
  Touch what = Touch::kPlaces;
  CarrierId first = 0, second = 0;  ///< 0: the load
  double at_s = 0.0;
};

/// "the cables of carriers 1 and 2".
[[nodiscard]] std::string who(const Approach& approach);

struct Certificate {
  std::vector<Reason> reasons;
  /// What breaks no rule but deserves a look. A stiffness that is negative at some moments is here, because a swing's
  /// fate is decided over whole periods; and so are paces at which a swing grows, because they are passed.
  std::vector<Reason> cautions;
  double period_s = std::numeric_limits<double>::infinity();
  double wrench_error_max_n = std::numeric_limits<double>::infinity();
  /// Of carriers, attained to 2e-7 m. Absent: left out, fewer than two carriers, or a motion without bounds.
  std::optional<Approach> separation;
  /// Of cables; at most 1 % below the truth, as is the clearance.
  std::optional<Approach> cable_distance;
  /// How far a carrier may stray before its cable touches a cable, a vehicle or the load, or its vehicle a cable or
  /// another one (clearance.hpp); of vehicles and the load speaks above_load_min_m.
  std::optional<Approach> clearance;
  /// From the load's highest corner to the lowest edge of a vehicle; absent for a load without a shape.
  std::optional<double> above_load_min_m;
  /// Smallest generalised eigenvalue of the load's stiffness against (m I, J) over all time [1/s²] (stiffness.hpp).
  /// Absent: left out, or a cable has no positive, bounded length at some moment.
  std::optional<double> stiffness_min_1_s2;
  std::optional<SkewBudget> skew;  ///< absent where the stiffness is: a displacement follows from it
  /// That declared lags are wrong by a fifth (lag.hpp); absent: as above.
  std::optional<double> lag_error_displacement_m;
  std::optional<Swings> swings;          ///< absent where the stiffness is, left out, or a cable goes slack
  std::vector<CarrierFigures> carriers;  ///< in the plan's order

  [[nodiscard]] bool admissible() const { return reasons.empty(); }
};

/// What to compute: the parts that are not per-carrier cost more (pairs, eigenvalues) and can be left out.
struct CertifyOptions {
  bool separation = true;  ///< and all that must not touch
  bool stiffness = true;   ///< and the skew budget
  bool non_stop = true;    ///< off for a plan that is meant to stand still
  bool swings = true;      ///< where the stiffness is; they cost more than all the rest
};

/// Of any plan, whatever is in it: nothing here asks that it be valid.
[[nodiscard]] Certificate certify(const Plan& plan, const CertifyOptions& options = {});

}  // namespace gyre::mechanics
