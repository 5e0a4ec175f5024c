#pragma once
// A carrier's slice of the static plan that holds the load as a course holds it at one moment.
//
// If one carrier is stuck, the equilibrium that includes it is the one in which everybody is where they were when it
// got stuck. Whatever was under way then, that equilibrium is a set of constant forces and lengths: f(t*) and l(t*).
//
// Reference: docs/design.md, fact 5.

#include <vector>

#include "common/mechanics/transition.hpp"

namespace gyre::mechanics {

/// `layers` as for evaluate_course; `t_s` on their clock. Not finite where the course's cable is slack at that moment.
[[nodiscard]] CarrierSlice frozen_slice(const std::vector<TimedLayer>& layers, double t_s);

}  // namespace gyre::mechanics
