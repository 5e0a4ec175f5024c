#pragma once
// A plan's motion over one period as a table that any tool reads.
//
// One row per moment and carrier, moments first; both ends of the period are there, so the last moment repeats the
// first. Columns: time; force, tension and direction with its rate (W); length with its rate; position and velocity
// (W); units in the names. Numbers are written so that they read back to the same bits.

#include <string>

#include "common/mechanics/plan.hpp"

namespace gyre::ground {

/// `count` moments, at least 2.
[[nodiscard]] std::string motion_csv(const mechanics::Plan& plan, int count);

}  // namespace gyre::ground
