#include "ground/plot/core/labels.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"

namespace gyre::ground {

void Labels::occupy(Point from, Point to, double half_width) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const int pieces = 1 + static_cast<int>(length / (2.0 * half_width));
  for (int k = 0; k <= pieces; ++k) {
    const double x = from.x + (to.x - from.x) * k / pieces, y = from.y + (to.y - from.y) * k / pieces;
    occupy({x - half_width, y - half_width, x + half_width, y + half_width});
  }
}

bool Labels::has_room(const Box& box) const {
  if (box.left < within_.left || box.right > within_.right || box.top < within_.top || box.bottom > within_.bottom)
    return false;
  return std::none_of(taken_.begin(), taken_.end(), [&box](const Box& other) {
    return box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom;
  });
}

std::optional<Point> Labels::place(const std::string& words, double font_size, Point mark, double gap, Point wish) {
  constexpr int kDirections = 16;
  constexpr double kHeight = 0.74;  // of a font's capitals and digits, in its size
  constexpr double kRim = 1.5;      // px, so that two are told apart
  const double half_width = 0.5 * width_of(words, font_size);
  const double half_height = 0.5 * kHeight * font_size;
  const double first = std::atan2(wish.y, wish.x);
  for (const double further : {0.0, 6.0, 14.0, 24.0, 36.0}) {
    for (int k = 0; k < kDirections; ++k) {
      // the wish, then to either side of it by turns
      const int turn = (k + 1) / 2;
      const double angle = first + (k % 2 == 0 ? turn : -turn) * (kTwoPi / kDirections);
      const double x = std::cos(angle), y = std::sin(angle);
      // so far that the box of the words is off the mark
      const double reach =
          gap + further + std::min(half_width / std::max(std::abs(x), 1e-9), half_height / std::max(std::abs(y), 1e-9));
      const Point middle{mark.x + reach * x, mark.y + reach * y};
      const Box box{middle.x - half_width - kRim, middle.y - half_height - kRim, middle.x + half_width + kRim,
                    middle.y + half_height + kRim};
      if (!has_room(box)) continue;
      occupy(box);
      return Point{middle.x, middle.y + half_height};
    }
  }
  return std::nullopt;
}

}  // namespace gyre::ground
