#pragma once
// Whether a swing of the load dies out while the plan runs, and at which paces on the way there.
//
//   symbol      meaning                                                      shape   unit
//   dx          displacement of the load: (translation, rotation), W         6       m, rad
//   M, K        inertia and stiffness of the load (stiffness.hpp)            6x6
//   J           [I, −[r]x]: attachment motion from load motion               3x6
//   q, q˙       cable direction, and its rate at full pace                   3       -, 1/s
//   c           damping of a cable                                           1       N s/m
//   p           pace: how fast the phase passes, 1 in full motion            1       -
//
//   M dx'' + (sum c J' q q' J) dx' + (K + p sum c J' q q˙' J) dx = 0         (linear about the equilibrium)
//
// A cable from an attachment that leaves its place by J dx is longer by −q·J dx; its damping resists the rate of that,
// −q·J dx' − q˙·J dx, along q. So the cable's turning brings a term that is no spring's: it can feed a swing. And K
// changes with the phase: a swing grows when about twice its frequency is a multiple of the motion's (parametric
// resonance). Both are in Floquet's multipliers (floquet.hpp), and in nothing that is known at single moments.
//
// Carriers and winches follow their references; that winches make up for stretch changes nothing here: they do so by
// the planned tension. A swing that is too large for linear equations is not judged.
//
// Found numerically, not proven: by steps that were halved until that made no difference, at paces of a grid, between
// which narrow resonances lie unseen. Proven are two things at rest, where nothing feeds a swing, and C >= 0 in
// M dx'' + C dx' + K dx = 0: none grows where K > 0, and none faster than √(−least stiffness) where not. At paces so
// slow that twice the softest swing's frequency is 28 times the motion's, or more, the motion is taken as a sequence of
// such rests, where K > 0: of 67 random plans none grew beyond the 23rd such order, up to the 120th that was looked at.
//
// Source: Floquet's theorem. Reference: docs/design.md, fact 6.

#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/floquet.hpp"
#include "common/mechanics/plan.hpp"

namespace gyre::mechanics {

struct PaceGrowth {
  double pace = 0.0;
  double growth_1_s = 0.0;
};

/// Of the swing that grows fastest; negative: all die out.
struct Swings {
  double growth_1_s = 0.0;  ///< of the plan as it is
  double worst_1_s = 0.0;   ///< with a rate, and moments of inertia, up to kSwingMargin different
  /// From rest to full pace, rising; at rest a bound. Of slow motions nothing but the two ends.
  std::vector<PaceGrowth> paces;

  /// The larger of the neighbours' in the grid; at paces beyond it, of its end.
  [[nodiscard]] double growth_at(double pace) const;
};

/// Nobody knows the moments of inertia of a load any better, and a clock that is wrong changes the rate by nothing.
inline constexpr double kSwingMargin = 0.05;
/// What does not grow faster is not told from what does not grow: rounding, and Radau's own damping. e-fold in 3 hours.
inline constexpr double kNeutralGrowth_1_s = 1e-4;

/// Of a plan whose cables are taut and longer than nothing. `period_s` and `stiffness_min_1_s2` as in the certificate.
[[nodiscard]] Swings swings(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s,
                            double stiffness_min_1_s2);

/// K, sum c J' q q' J and sum c J' q q˙' J at one moment, `t_s` since the plan's epoch at full pace.
[[nodiscard]] LinearMoment linear_moment(const Plan& plan, const std::vector<CarrierSlice>& slices, double t_s);

/// The growth at one pace, with moments of inertia so many times the load's, by so many steps a period [1/s].
struct SwingCase {
  double pace = 1.0;
  double inertia_factor = 1.0;
  std::size_t steps = 512;
};
[[nodiscard]] double swing_growth(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s,
                                  const SwingCase& asked);

}  // namespace gyre::mechanics
