#pragma once
// The load, its cables and its carriers in one view: where they are at the period's begin, the orbits, and how close
// carriers and cables ever come.

#include <string>
#include <vector>

#include "ground/plot/core/motion.hpp"
#include "ground/plot/core/svg.hpp"
#include "ground/plot/core/view.hpp"

namespace gyre::ground {

void draw_scene(Svg& svg, const Motion& motion, const Frame& frame);

/// A view's title, its axes, the ground where it is seen; a remark beside the title.
void draw_frame(Svg& svg, const Frame& frame, const std::string& remark);

/// The outline of a load with these corners.
void draw_load(Svg& svg, const std::vector<Eigen::Vector3d>& corners_w_m, const Frame& frame);

/// How the closest approach of carriers, or of cables, is drawn: from one to the other.
void draw_approach(Svg& svg, Point from, Point to, bool of_cables);

}  // namespace gyre::ground
