#pragma once
// Whether two plans hold the same load, by the same points, on the same cables: what mixtures of them and a coordinator
// that takes a flight over rest on. Another motion is no obstacle, another cycle neither.
//
// Compared with tolerances: the same mission, worked out on another machine, differs in the last bits.

#include <optional>
#include <string>

#include "common/mechanics/plan.hpp"
#include "coordinator/core/plan_book.hpp"

namespace gyre::coordinator {

/// Why a flight of `flown` cannot go over to `wanted`; absent: it can.
[[nodiscard]] std::optional<std::string> load_obstacle(const mechanics::Plan& flown, const mechanics::Plan& wanted);

/// The same of what is known of a plan that agents hold, and a plan's slices. Inertia is not in a slice: it takes no
/// part in holding the load.
[[nodiscard]] std::optional<std::string> load_obstacle(const Slices& flown, const Slices& wanted);

}  // namespace gyre::coordinator
