#include "ground/report/core/envelope.hpp"

#include <algorithm>
#include <cmath>

namespace gyre::ground {

void Envelope::add(double t_s, double figure) {
  const Point now{t_s, figure};
  figures_.include(figure);
  auto number = static_cast<std::int64_t>(std::floor(t_s / width_s_));
  const bool after_gap = !columns_.empty() && t_s - columns_.back().last.x > kGap_s;
  if (columns_.size() >= kMostColumns && number > columns_.back().number) {
    width_s_ *= 2.0;
    columns_ = widened(columns_, width_s_);
    number = static_cast<std::int64_t>(std::floor(t_s / width_s_));
  }
  if (columns_.empty() || number > columns_.back().number) {
    columns_.push_back({number, now, now, now, now, after_gap});
    return;
  }
  Column& column = columns_.back();
  if (figure < column.least.y) column.least = now;
  if (figure > column.greatest.y) column.greatest = now;
  column.last = now;
}

std::vector<Envelope::Column> Envelope::widened(const std::vector<Column>& columns, double width_s) {
  std::vector<Column> out;
  for (Column column : columns) {
    column.number = static_cast<std::int64_t>(std::floor(column.first.x / width_s));
    // A gap that begins and ends within one column is narrower than anybody sees.
    const bool new_one =
        out.empty() || out.back().number != column.number || column.first.x - out.back().last.x > width_s;
    if (new_one) {
      out.push_back(column);
      continue;
    }
    Column& wide = out.back();
    if (column.least.y < wide.least.y) wide.least = column.least;
    if (column.greatest.y > wide.greatest.y) wide.greatest = column.greatest;
    wide.last = column.last;
  }
  return out;
}

std::vector<std::vector<Point>> Envelope::pieces(double least_width_s) const {
  std::vector<std::vector<Point>> out;
  for (const Column& column : least_width_s > width_s_ ? widened(columns_, least_width_s) : columns_) {
    if (out.empty() || column.after_gap) out.emplace_back();
    const bool falls = column.greatest.x < column.least.x;
    for (const Point& point :
         {column.first, falls ? column.greatest : column.least, falls ? column.least : column.greatest, column.last}) {
      const bool told = !out.back().empty() && out.back().back().x == point.x && out.back().back().y == point.y;
      if (!told) out.back().push_back(point);
    }
  }
  return out;
}

}  // namespace gyre::ground
