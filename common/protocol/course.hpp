#pragma once
// Reading a course: which plans count now, and how a carrier's slices of them lie on each other.

#include <functional>
#include <vector>

#include "common/mechanics/transition.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::protocol {

/// A carrier's slice of a plan, or nullptr where it is not held.
using SliceLookup = std::function<const mechanics::CarrierSlice*(const PlanNumber&)>;

/// The course's plan and transitions as layers, in seconds since `origin`. Transitions that are only proposed are not
/// flown and not in it. Empty when a slice is missing: a course is flown whole or not at all.
[[nodiscard]] std::vector<mechanics::TimedLayer> layers(const Course& course, SwarmTime origin,
                                                        const SliceLookup& lookup);

/// Every plan the course refers to, proposed ones too, from the bottom up.
[[nodiscard]] std::vector<PlanNumber> plans_of(const Course& course);

/// A transition that is complete makes its plan the base, and what lay below it goes. True if anything changed;
/// the motion does not change by it.
bool settle(Course& course, SwarmTime now);

/// Whether a transition that is go has started and is not complete.
[[nodiscard]] bool in_transition(const Course& course, SwarmTime now);

}  // namespace gyre::protocol
