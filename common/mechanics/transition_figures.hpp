#pragma once
// What a carrier does at its worst while transitions are under way.
//
// A mixture has no critical polynomial, so its extremes are enclosed: the same formulas (transition.hpp) are evaluated
// in interval arithmetic on cells of time, with the mean value form, and cells are halved until the enclosure is tight.
// The result holds every value of the window and is wider than the truth by at most kTransitionSlack of each figure's
// greatest magnitude (rates of the winch: or the speed's; altitude: or the length's), by kAccelerationSlack where the
// acceleration is in it (bank: of a radian), and by kWinchAccelerationSlack of the winch's or the carrier's: a proof,
// not a sampling. Where cells get as narrow as they may first (violent mixtures, cables near the plane of their law) it
// is wider, never wrong.
//
// Reference: docs/design.md, facts 1 and 3; R. E. Moore, Interval Analysis.

#include <optional>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/transition.hpp"

namespace gyre::mechanics {

inline constexpr double kTransitionSlack = 2e-3;
/// The acceleration is the last derivative carried: without the next one its enclosure shrinks with h only, and the
/// same slack would cost five times the cells.
inline constexpr double kAccelerationSlack = 1e-2;
/// Nor has the winch's, whose formula divides more often: at that slack a rehearsal would take twice as long.
inline constexpr double kWinchAccelerationSlack = 5e-2;

/// Over [begin_s, end_s] on the layers' clock, end after begin; `layers` as for evaluate_course (GYRE_ENSURE). Where a
/// cable may go slack, or perpendicular to its law, figures are bounded by nothing: infinite.
/// `direction_cosine_min` stays absent, and without a `vehicle` so does what it pulls.
[[nodiscard]] CarrierFigures transition_figures(const std::vector<TimedLayer>& layers, double begin_s, double end_s,
                                                const std::optional<VehicleWeight>& vehicle = std::nullopt);

}  // namespace gyre::mechanics
