#pragma once
// A figure sampled along a motion, and what sampling can have missed of it.

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "common/mechanics/range.hpp"

namespace gyre::mechanics::test {

class Track {
 public:
  /// At equal steps of time.
  void add(double value) {
    if (count_ >= 2) missed_ = std::max(missed_, 2.0 * std::abs(value - 2.0 * last_ + before_));
    before_ = last_;
    last_ = value;
    ++count_;
    range_.include(value);
  }
  [[nodiscard]] const Range& range() const { return range_; }
  [[nodiscard]] double size() const { return std::max(std::abs(range_.min), std::abs(range_.max)); }
  /// How far the figure may rise above the samples between two of them.
  [[nodiscard]] double missed() const { return missed_; }

 private:
  Range range_;
  double before_ = 0.0, last_ = 0.0, missed_ = 0.0;
  int count_ = 0;
};

/// `claim` holds every sample, and exceeds them by no more than sampling can have missed and `slack`.
inline void check_holds(const Track& track, const Range& claim, double slack = 0.0) {
  const double rounding = 1e-12 * (1.0 + track.size());
  const double allowed = track.missed() + slack + rounding;
  RC_ASSERT(claim.min <= track.range().min + rounding);
  RC_ASSERT(claim.max >= track.range().max - rounding);
  RC_ASSERT(claim.min >= track.range().min - allowed);
  RC_ASSERT(claim.max <= track.range().max + allowed);
}

}  // namespace gyre::mechanics::test
