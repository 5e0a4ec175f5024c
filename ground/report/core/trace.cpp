#include "ground/report/core/trace.hpp"

#include <cmath>
#include <utility>

namespace gyre::ground {

Trace::Cell Trace::cell(const Eigen::Vector3d& place_m) const {
  const auto along = [&](int axis) { return static_cast<std::int64_t>(std::floor(place_m[axis] / cell_m_)); };
  return {along(0), along(1), along(2)};
}

void Trace::add(const Eigen::Vector3d& place_m) {
  for (int axis = 0; axis < 3; ++axis) extent_[static_cast<std::size_t>(axis)].include(place_m[axis]);
  if (!first_m_) first_m_ = place_m;
  step(place_m);
  while (steps_.size() > kMostSteps) widen();
}

void Trace::step(const Eigen::Vector3d& place_m) {
  const Cell to = cell(place_m);
  if (at_ == to) return;
  if (at_ && steps_.emplace(*at_, to).second) {
    if (!down_) strokes_.push_back({entered_m_});
    strokes_.back().push_back(place_m);
    down_ = true;
  } else {
    down_ = false;
  }
  at_ = to;
  entered_m_ = place_m;
}

void Trace::widen() {
  cell_m_ *= 2.0;
  const auto drawn = std::exchange(strokes_, {});
  const Eigen::Vector3d here = entered_m_;
  const bool known = at_.has_value();
  steps_.clear();
  for (const std::vector<Eigen::Vector3d>& stroke : drawn) {
    interrupt();
    down_ = false;
    for (const Eigen::Vector3d& place : stroke) step(place);
  }
  // Goes on from where it was, whichever stroke that was.
  down_ = down_ && !strokes_.empty() && strokes_.back().back() == here;
  entered_m_ = here;
  at_ = known ? std::optional<Cell>(cell(here)) : std::nullopt;
}

}  // namespace gyre::ground
