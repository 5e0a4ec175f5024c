#pragma once
// What it costs at the load that declared lags are not quite true.
//
//   symbol     meaning                                                     shape   frame   unit
//   T_w, T_v   declared lags of a winch and of a vehicle                   1       -       s
//   e          how wrong they are: the true ones are (1 + e) T             1       -       -
//   L, p, q    paid-out length, place of the carrier, cable's direction    1,3,3   W       m, m, -
//   K, J       load stiffness, attachment motion (stiffness.hpp)
//
// Whoever follows with a lag of (1 + e) T what is asked for ahead by T is late by e T: by −e T_w L' of the length and
// by −e T_v p' of the place. Cables so moved pull the load by
//
//   K x = sum J' [ (k q q' + (s/l)(I − q q')) dp − k q dL ],   dp = −e T_v p',   dL = −e T_w L'
//
// All winches are taken to be wrong alike, and all vehicles, these with the same sign as the winches or with the other,
// whichever is worse: equal lags of both nearly cancel. The figure is a linear consequence, as if the load were without
// mass, and the worst on a grid over the period: not a proof. Simulated dynamics agree where the motion is slow next
// to the load's own modes, and move it further where it is not: by a fifth at half the frequency of its softest mode.
//
// Reference: docs/design.md, fact 9.

#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/plan.hpp"

namespace gyre::mechanics {

/// A lag that is known to a fifth is known well.
inline constexpr double kLagError = 0.2;

/// How far the load moves when the declared lags are wrong by kLagError [m]; 0 where nothing lags. `period_s` as in the
/// certificate; of cables that are taut and longer than nothing.
[[nodiscard]] double lag_error_displacement_m(const Plan& plan, const std::vector<CarrierSlice>& slices,
                                              double period_s);

}  // namespace gyre::mechanics
