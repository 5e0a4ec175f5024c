#pragma once
// One figure over time in bounded memory, however long it is told: no extreme is ever lost.
//
// Intuition: a picture has a thousand columns, and of all that falls into one column nobody sees more than where it
// comes in, its least, its greatest, and where it goes out. So these are kept, each with the time it had. When there
// are too many columns, they become twice as wide, and two are made one.
//
// Times are seconds and do not decrease.

#include <cstdint>
#include <vector>

#include "common/mechanics/range.hpp"
#include "ground/plot/core/svg.hpp"

namespace gyre::ground {

class Envelope {
 public:
  static constexpr std::size_t kMostColumns = 1024;
  /// Of streams that come a hundred times a second: so long a silence is one, and no line is drawn across it.
  static constexpr double kGap_s = 0.25;

  void add(double t_s, double figure);

  [[nodiscard]] bool empty() const { return columns_.empty(); }
  /// Of all that was told.
  [[nodiscard]] const mechanics::Range& figures() const { return figures_; }
  [[nodiscard]] std::size_t columns() const { return columns_.size(); }

  /// Lines through time and figure, one from each gap to the next, as columns at least so wide have them: four points
  /// of a column at most.
  [[nodiscard]] std::vector<std::vector<Point>> pieces(double least_width_s) const;

 private:
  struct Column {
    std::int64_t number;
    Point first, least, greatest, last;
    bool after_gap;
  };
  [[nodiscard]] static std::vector<Column> widened(const std::vector<Column>& columns, double width_s);

  double width_s_ = 1.0 / 128.0;
  std::vector<Column> columns_;
  mechanics::Range figures_;
};

}  // namespace gyre::ground
