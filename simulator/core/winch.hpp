#pragma once
// A winch that follows the setpoint's unstretched length: a digital loop that decides a drum rate once per tick.
//
//   L*(t)   paid-out length asked for, extrapolated (extrapolation.hpp)       m
//   L, r    paid-out length and its rate                                      m, m/s
//   h       tick                                                              s
//
//   r(t + h) = clamp(L*'(t + h) + (L*(t) − L(t)) / T, ± rate limit),  r linear within the tick
//
// The rate is linear within the tick because it must not jump: the cables' damping would turn a jump into a kick. The
// feed-forward at the tick's end makes a constantly accelerated target free of steady error. The loop's poles are real
// for T >= 2.92 h, so a shorter time constant is taken as three ticks. A winch without time constant and rate limit is
// exact: it has paid out what is asked for, at all times. After a silence that made it slow down, either catches up
// (catch_up.hpp). One that holds brakes what it is asked for (on_silence.hpp).

#include <limits>
#include <optional>

#include "simulator/core/catch_up.hpp"
#include "simulator/core/on_silence.hpp"

namespace gyre::simulator {

struct WinchSettings {
  std::optional<double> time_constant_s;
  std::optional<double> rate_limit_m_s;
  double tick_s = 0.002;
};

struct WinchTarget {
  double length_m = 0.0;
  double rate_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
};

struct WinchMotion {
  double length_m = 0.0;
  double rate_m_s = 0.0;
};

class Winch {
 public:
  Winch(double rest_length_m, const WinchSettings& settings, OnSilence on_silence = OnSilence::kGoesOn);

  /// From `now` on follows a target that held at `held` <= now.
  void command(const WinchTarget& target, double held_s, double now_s, Hand hand = Hand::kSame);

  /// Decides the motion from `now` until the next tick; once per tick, in order.
  void tick(double now_s);

  /// At any time within the tick.
  [[nodiscard]] WinchMotion at(double t_s) const;

 private:
  /// As asked for if nobody brakes.
  [[nodiscard]] WinchMotion led(double t_s) const;
  [[nodiscard]] WinchMotion asked(double t_s) const;

  bool exact_;
  double time_constant_s_;
  std::optional<double> rate_limit_m_s_;
  double tick_s_;
  OnSilence on_silence_;
  WinchTarget target_;
  double target_since_s_ = 0.0;
  double brakes_at_s_ = std::numeric_limits<double>::infinity();
  bool led_ = false;
  CatchUp<double> catch_up_{0.0};
  WinchMotion begin_;  // at tick_since_s_
  double acceleration_m_s2_ = 0.0;
  double tick_since_s_ = 0.0;
};

}  // namespace gyre::simulator
