#pragma once
// Two views of a motion, from above and from the side, in one scale, so that they can be held against each other.
//
//   symbol    meaning                                        shape   frame     unit
//   right     across the view                                3       W         -
//   up        up the view                                    3       W         -
//
// From the side means across the wider of x and y, so that as much as can be is seen.

#include <Eigen/Core>
#include <vector>

#include "ground/plot/core/motion.hpp"
#include "ground/plot/core/scale.hpp"
#include "ground/plot/core/svg.hpp"

namespace gyre::ground {

struct View {
  const char* title;
  const char* right_name;
  const char* up_name;
  Eigen::Vector3d right, up;
};

struct Frame {
  View view;
  Box plot;
  Scale right, up;            ///< metres to px
  bool shows_ground = false;  ///< altitude 0

  [[nodiscard]] Point operator()(const Eigen::Vector3d& place_w_m) const {
    return {right(place_w_m.dot(view.right)), up(place_w_m.dot(view.up))};
  }
  [[nodiscard]] double px_per_m() const { return plot.width() / right.shown.span(); }
};

struct Frames {
  Frame above, side;
};

/// What the views have to show, along the axes of W.
struct Extents {
  mechanics::Range x, y, z;

  void include(const Eigen::Vector3d& place_w_m, double radius_m = 0.0);
  void include(const Extents& other);
};
[[nodiscard]] Extents extents(const Motion& motion);

/// Beside each other below `top_left`, as high as they have to be; around `plot` there is room for what axes say.
[[nodiscard]] Frames frames(const Extents& extents, Point top_left, double width);

/// The corners of the hull of points, in order.
[[nodiscard]] std::vector<Point> hull_of(std::vector<Point> points);

}  // namespace gyre::ground
