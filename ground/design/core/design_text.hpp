#pragma once
// A design in words: how far the search is, what was found and what holds it back, or what cannot be met together.

#include <string>

#include "common/design/design.hpp"
#include "common/mission/requirements.hpp"

namespace gyre::ground {

/// "  3.2 s  all that is open: best so far 0.043 m/s".
[[nodiscard]] std::string progress_line(double elapsed_s, design::Objective objective,
                                        const design::Progress& progress);

/// Certificate and prices of a design; without a plan, why there is none.
[[nodiscard]] std::string design_report(const mission::Requirements& requirements, const design::Design& design);

/// The designed mission as a file, with where it comes from at its head. Of a design with a plan.
[[nodiscard]] std::string mission_file(const mission::Requirements& requirements, const design::Design& design,
                                       const std::string& source_name, std::uint64_t seed);

}  // namespace gyre::ground
