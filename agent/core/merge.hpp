#pragma once
// Why no setpoint ever steps: whatever jumps in what an agent should fly, it starts from where it is and closes the
// gap.
//
// Intuition: an agent that was restarted in flight, or that heard of a transition after its start, suddenly has a
// reference elsewhere. Flying it at once would be a step. So the gap between what was flown and what is to be flown is
// measured, in value, rate and acceleration, and added to the reference as a quintic that fades to nothing.
//
//   e(x) = e0 (1 − 10x³ + 15x⁴ − 6x⁵) + e0' T (x − 6x³ + 8x⁴ − 3x⁵) + e0'' T² (x²/2 − 3x³/2 + 3x⁴/2 − x⁵/2)
//   x = (t − t0) / T, each term with its own T: long enough for half the vehicle's speed and acceleration to be left
//   for the plan itself, and for a gap that is felt not to set the load swinging; no longer, because a rate that fades
//   over a long T carries far: e0' T / 5, e0'' T² / 60.
//
// While a gap closes, the carrier is not where equilibrium wants it: that is the price of having been away, and T is
// what it is paid with.

#include <Eigen/Core>
#include <algorithm>

#include "common/base/time.hpp"
#include "common/mechanics/taylor.hpp"

namespace gyre::agent {

/// What a vehicle is asked to do, with derivatives: carrier position [m, W] and unstretched cable length [m].
struct Command {
  mechanics::TaylorVector<double> position_w_m;
  mechanics::Taylor<double> winch_m;
};

struct MergeLimits {
  double speed_m_s = 1.0;
  double acceleration_m_s2 = 1.0;
  double winch_rate_m_s = 0.5;
};

class Merge {
 public:
  explicit Merge(const MergeLimits& limits) : limits_(limits) {}

  /// From now on, `reference` would be flown; `flown` is what was.
  void begin(SwarmTime now, const Command& flown, const Command& reference);

  /// The reference with what is left of the gap.
  [[nodiscard]] Command apply(SwarmTime now, const Command& reference) const;
  [[nodiscard]] bool under_way(SwarmTime now) const {
    return under_way_ && now < start_ + std::max(value_time_, rate_time_);
  }

 private:
  MergeLimits limits_;
  SwarmTime start_{};
  Duration value_time_{};
  Duration rate_time_{};
  bool under_way_ = false;
  Command gap_;
};

}  // namespace gyre::agent
