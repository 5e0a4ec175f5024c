#pragma once
// Where a flight starts and ends: the same load, held still by carriers that stand still.
//
// The natural place of rest is the centre of every orbit: each edge keeps its offset, each profile its mean, and no
// carrier spends more force than that asks for. A small load whose carriers fly wide circles has no such place: at the
// centre they would hang above their attachments, closer to each other than they may be. Then they rest on their
// orbits, at phase zero, where every limit but the least speed is known to hold.

#include "common/mechanics/plan.hpp"

namespace gyre::mechanics {

/// The centre if it keeps the plan's limits, else the static plan at phase zero.
[[nodiscard]] Plan rest_plan(const Plan& plan);

}  // namespace gyre::mechanics
