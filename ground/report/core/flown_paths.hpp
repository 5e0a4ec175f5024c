#pragma once
// Where carriers were in a flight, from above and from the side, over where the plan has them.

#include <vector>

#include "ground/plot/core/svg.hpp"
#include "ground/plot/core/view.hpp"
#include "ground/report/core/flown_charts.hpp"

namespace gyre::ground {

/// What the views of this flight have to show.
[[nodiscard]] Extents flown_extents(const Account& account);

/// Whether flights are of one size, near enough for one scale to show all of them.
[[nodiscard]] bool of_one_size(const std::vector<Account>& accounts);

/// In one of the two views.
void draw_paths(Svg& svg, const Account& account, const Places& places, const Frame& frame);

}  // namespace gyre::ground
