#pragma once
// What a setpoint means until the next one comes, and what it means when none comes.
//
//   τ = time since the setpoint held, H = kExtrapolationHorizon_s, T = kStoppingTime_s, w = smooth step (quintic.hpp)
//
//   τ <= H           x = x0 + v0 τ + ½ a0 τ²                    as the setpoint says
//   H < τ < H + T    x' = (v0 + a0 H) (1 − w((τ − H) / T))      slows down, along the last direction
//   H + T <= τ       x' = 0                                     rests
//
// A second's silence is a hundred setpoints at 100 Hz: nobody is going to send the next one soon. A parabola followed
// for longer leaves for infinity, and a stop at once would tear at the cable; so the carrier slows down as smoothly as
// a transition begins. The velocity has no step anywhere; the acceleration has one, at H. PX4 leaves offboard control
// after about the same silence (COM_OF_LOSS_T).

#include "simulator/core/on_silence.hpp"

namespace gyre::simulator {

inline constexpr double kExtrapolationHorizon_s = 1.0;
inline constexpr double kStoppingTime_s = 2.0;

/// x = x0 + v0 · by_velocity + a0 · by_acceleration, and x' = v0 · rate_by_velocity + a0 · rate_by_acceleration.
struct ExtrapolationWeights {
  double by_velocity = 0.0;
  double by_acceleration = 0.0;
  double rate_by_velocity = 1.0;
  double rate_by_acceleration = 0.0;
};

[[nodiscard]] inline ExtrapolationWeights extrapolate(double elapsed_s) {
  constexpr double kHorizon_s = kExtrapolationHorizon_s;
  if (elapsed_s <= kHorizon_s) return {elapsed_s, 0.5 * elapsed_s * elapsed_s, 1.0, elapsed_s};
  const auto [travelled_s, share] = fade(elapsed_s - kHorizon_s, kStoppingTime_s);
  return {kHorizon_s + travelled_s, 0.5 * kHorizon_s * kHorizon_s + kHorizon_s * travelled_s, share,
          kHorizon_s * share};
}

}  // namespace gyre::simulator
