#pragma once
// What a carrier has to do by a course at a moment of swarm time: the one evaluation that the agent flies by, and that
// its vehicle goes on by when no more setpoints come.

#include <optional>

#include "common/mechanics/reference.hpp"
#include "common/protocol/course.hpp"

namespace gyre::protocol {

/// With derivatives by swarm time. Absent when a slice of the course is missing.
[[nodiscard]] std::optional<mechanics::Reference> reference(const Course& course, SwarmTime now,
                                                            const SliceLookup& lookup);

/// What the winch has paid out: the cable, short by what its tension stretches it, l0 = l − s / k. A stiffness of 0: no
/// stretch is compensated.
[[nodiscard]] mechanics::Taylor<double> winch_length(const mechanics::Reference& r, double stiffness_n_m);

}  // namespace gyre::protocol
