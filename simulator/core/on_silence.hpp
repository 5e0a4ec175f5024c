#pragma once
// What a vehicle does when no more setpoints come, and how one that holds brakes.
//
// There are two kinds. One goes on along its path (onward.hpp). The other holds, as most autopilots do by themselves:
// it knows no path, so it brakes where it is, soon and hard, and stays there until it is told anything again. What it
// brakes is its whole motion, what is left of a gap that it was closing (catch_up.hpp) included: it stands.
//
//   t_b = time the last setpoint was taken up + kGoesOnAfter, T = kBraking_s, w = smooth step (quintic.hpp)
//
//   t <= t_b             x = as if it were to go on being led
//   t_b < t < t_b + T    x' = x'(t_b) (1 − w((t − t_b) / T))        slows down, along the last direction
//   t_b + T <= t         x' = 0                                     stands, |x'(t_b)| T / 2 further on
//
// The silence is counted from when a setpoint was taken up, not from when it held: late is not silent. What is braked
// is what was asked for, and one that lags was asked for a place ahead of it: it stands that much further on, and
// later.

#include <limits>

#include "common/base/time.hpp"
#include "common/mechanics/quintic.hpp"

namespace gyre::simulator {

enum class OnSilence { kGoesOn, kHolds };

/// Without a setpoint for longer, a vehicle goes on by itself, or brakes: five of them at 100 Hz.
inline constexpr Duration kGoesOnAfter = std::chrono::milliseconds(50);
inline constexpr double kBraking_s = 0.2;

/// Of a motion that fades to a stand.
struct Fading {
  double travelled_s = 0.0;  ///< way so far, by the speed at the beginning
  double share = 1.0;        ///< of that speed, now
};

[[nodiscard]] inline Fading fade(double elapsed_s, double duration_s) {
  const mechanics::Taylor<double> x = mechanics::progress(elapsed_s, duration_s);
  return {duration_s * mechanics::value_left_integral(x.value), mechanics::value_left(x).value};
}

/// When a vehicle begins to brake that takes a setpoint up now: for one that goes on, never.
[[nodiscard]] inline double brakes_at_s(OnSilence on_silence, double taken_up_s) {
  if (on_silence == OnSilence::kGoesOn) return std::numeric_limits<double>::infinity();
  return taken_up_s + seconds(kGoesOnAfter);
}

}  // namespace gyre::simulator
