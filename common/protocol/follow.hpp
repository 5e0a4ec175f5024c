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

}  // namespace gyre::protocol
