#pragma once
// True time, which nobody in the swarm knows, and the clock that a process has instead.
//
//   local = offset + integral of (1 + drift(t)) dt
//
// The drift is constant for half a second at a time and then wanders: a quartz that is warmed and cooled. Wall clocks
// do not appear: no core can be told one (harness_test.cpp holds that at compile time).

#include <algorithm>
#include <cmath>

#include "common/base/random_stream.hpp"
#include "common/base/time.hpp"

namespace gyre::swarm {

/// The harness's own clock: nanoseconds since the flight began.
struct TrueClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<TrueClock, duration>;
  static constexpr bool is_steady = true;  // NOLINT(readability-identifier-naming): the standard's name
};
using TrueTime = TrueClock::time_point;

inline constexpr double kDriftMax = 200e-6;

class VirtualClock {
 public:
  /// `offset`: what it shows when the flight begins; `drift`: how much too fast; `wander_per_sqrt_s`: of the drift.
  VirtualClock(const RandomStream& random, Duration offset, double drift, double wander_per_sqrt_s)
      : random_(random), local_(offset), drift_(drift), wander_(wander_per_sqrt_s) {}

  /// For `now` that never goes back.
  [[nodiscard]] LocalTime at(TrueTime now) {
    while (now - since_ >= kConstantFor) {
      local_ += elapsed(kConstantFor);
      since_ += kConstantFor;
      if (wander_ > 0.0) {
        drift_ =
            std::clamp(drift_ + wander_ * std::sqrt(seconds(kConstantFor)) * random_.normal(), -kDriftMax, kDriftMax);
      }
    }
    return LocalTime(local_ + elapsed(now - since_));
  }

  /// A moment at which the clock shows `local` or a little more, if the drift stays as it is.
  [[nodiscard]] TrueTime when(LocalTime local) const {
    const Duration ahead = local.time_since_epoch() - local_;
    return since_ + Duration(std::llround(static_cast<double>(ahead.count()) / (1.0 + drift_))) + Duration(1);
  }

 private:
  static constexpr Duration kConstantFor = std::chrono::milliseconds(500);
  [[nodiscard]] Duration elapsed(Duration truly) const {
    return truly + Duration(std::llround(static_cast<double>(truly.count()) * drift_));
  }

  RandomStream random_;
  TrueTime since_{};
  Duration local_{};
  double drift_;
  double wander_;
};

}  // namespace gyre::swarm
