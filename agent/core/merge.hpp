#pragma once
// Why no setpoint ever steps: whatever jumps in what an agent should fly, it starts from where it is and closes the
// gap.
//
// Intuition: an agent that was restarted in flight, or that heard of a transition after its start, suddenly has a
// reference elsewhere. Flying it at once would be a step. So the gap between what was flown and what is to be flown is
// measured, in value, rate and acceleration, and added to the reference as a quintic that fades to nothing.
//
//   e(t) = e0 v(x) + e0' T s(x) + e0'' T² c(x)          v, s, c as in quintic.hpp
//   x = (t − t0) / T, each term with its own T: long enough for half the vehicle's speed and acceleration to be left
//   for the plan itself, and for a gap that is felt not to set the load swinging; no longer, because a rate that fades
//   over a long T carries far: e0' T / 5, e0'' T² / 60.
//
// On a motion that repeats, most of a gap is usually time: a carrier that stood still has only fallen behind on its
// path. Straight ahead to where it should be would leave the path, with a cable that fits neither place. So it first
// looks for the moment t0 − d0 at which the motion comes nearest, flies the motion with a delay d that fades from d0 to
// nothing by the same quintic, and only what is left beside the path is closed straight.
//
//   command(t) = reference(t − d(t)) + e(t)       d0' = 1 − (speed flown / speed of the motion): 1 at rest
//
// Carriers that fell behind together catch up together, and the load is in equilibrium all the way: how long the delay
// takes depends on the delay alone, not on the vehicle. A vehicle that could not hurry so much closes its gap straight.
//
// While a gap closes, the carrier is not where equilibrium wants it: that is the price of having been away, and T is
// what it is paid with.

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <optional>

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

/// What is to be flown.
struct Path {
  std::function<Command(SwarmTime)> at;
  /// Of a motion that repeats, and has no transition before it or ahead; absent: `at` is asked for the present only.
  std::optional<Duration> period;
};

class Merge {
 public:
  explicit Merge(const MergeLimits& limits) : limits_(limits) {}

  /// From now on, `path` would be flown; `flown` is what was.
  void begin(SwarmTime now, const Command& flown, const Path& path);
  /// The same, where the vehicle's word of what it flies is so old: place and speed, and no acceleration. The gap
  /// is that of the moment it speaks of: on a bend, a hundredth of a second later it is another one, in speed, too, and
  /// that carries far. So who flies along the path is taken to speak of the moment at which he was nearest to it, no
  /// longer ago than a word is on its way; and to be on his way round the same bend: at a share of its speed, by the
  /// square of that share. Taken for none, his acceleration would carry him aside by a sixtieth of the path's.
  void begin_at_vehicle(SwarmTime now, Duration age, Command told, const Path& path);

  /// The path's command with what is left of the gap. `path`: the one it began with.
  [[nodiscard]] Command apply(SwarmTime now, const Path& path) const;
  [[nodiscard]] bool under_way(SwarmTime now) const {
    return under_way_ && now < start_ + std::max({value_time_, rate_time_, delay_time_});
  }

 private:
  [[nodiscard]] Command find_delay(SwarmTime now, const Command& flown, const Path& path);
  void close(const Command& flown, const Command& reference);
  /// Flown at `now` with a delay, in seconds, that changes by `rate`.
  struct Delay {
    double delay_s = 0.0;
    double rate = 0.0;
  };
  [[nodiscard]] std::optional<Delay> behind(SwarmTime now, const Command& flown, const Path& path) const;
  [[nodiscard]] Command delayed(SwarmTime now, const Path& path) const;

  MergeLimits limits_;
  SwarmTime start_{};
  Duration value_time_{};
  Duration rate_time_{};
  Duration delay_time_{};  ///< zero: none
  Delay delay_;
  bool under_way_ = false;
  Command gap_;
};

}  // namespace gyre::agent
