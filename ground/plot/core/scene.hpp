#pragma once
// The load, its cables and its carriers in one view: where they are at the period's begin, the orbits, and how close
// carriers and cables ever come.

#include "ground/plot/core/motion.hpp"
#include "ground/plot/core/svg.hpp"
#include "ground/plot/core/view.hpp"

namespace gyre::ground {

void draw_scene(Svg& svg, const Motion& motion, const Frame& frame);

/// How the closest approach of carriers, or of cables, is drawn: from one to the other.
void draw_approach(Svg& svg, Point from, Point to, bool of_cables);

}  // namespace gyre::ground
