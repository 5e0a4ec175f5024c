#pragma once
// Finds room for words where no other words are.

#include <optional>
#include <string>
#include <vector>

#include "ground/plot/core/svg.hpp"

namespace gyre::ground {

class Labels {
 public:
  explicit Labels(const Box& within) : within_(within) {}

  void occupy(const Box& box) { taken_.push_back(box); }
  /// A line, and `half_width` px to either side.
  void occupy(Point from, Point to, double half_width);

  /// The middle of the baseline of words beside `mark`, which stay `gap` px off it: towards `wish` where there is room,
  /// else as near to that as can be. Absent: there is no room at all.
  [[nodiscard]] std::optional<Point> place(const std::string& words, double font_size, Point mark, double gap,
                                           Point wish);

 private:
  [[nodiscard]] bool has_room(const Box& box) const;

  Box within_;
  std::vector<Box> taken_;
};

}  // namespace gyre::ground
