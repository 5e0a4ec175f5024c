#pragma once
// A winch that follows the setpoint's unstretched length: a digital loop that decides a drum rate once per tick.
//
//   L*(t)   paid-out length asked for, extrapolated (extrapolation.hpp)       m
//   L, r    paid-out length and its rate                                      m, m/s
//   h       tick                                                              s
//   T       lag                                                               s
//
//   with a lag       L' = (L* − L) / T (digital_loop.hpp), as winches are in the field: a length that moves is paid out
//                    late by T, and whoever does not want that asks for it ahead of time
//   without one      r(t + h) = L*'(t + h) + (L*(t) − L(t)) / 3h
//   either           within r(t) ± acceleration limit · h, and then within ± rate limit
//
// Without a lag the feed-forward at the tick's end leaves a constantly accelerated target no steady error; its poles
// are real for 2.92 h and more. A lag shorter than a tick is taken as one. A winch without lag and limits is exact: it
// has paid out what is asked for, at all times. After a silence that made it slow down, either catches up
// (catch_up.hpp). One that holds brakes what it is asked for (on_silence.hpp).

#include <limits>
#include <optional>

#include "simulator/core/catch_up.hpp"
#include "simulator/core/digital_loop.hpp"
#include "simulator/core/on_silence.hpp"

namespace gyre::simulator {

struct WinchSettings {
  double lag_s = 0.0;  ///< 0: none
  std::optional<double> rate_limit_m_s;
  std::optional<double> acceleration_limit_m_s2;
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

  /// From `now` on follows a target that held at `held`, or holds in a moment.
  void command(const WinchTarget& target, double held_s, double now_s, Hand hand = Hand::kSame);

  /// Decides the motion from `now` until the next tick; once per tick, in order.
  void tick(double now_s);

  /// At any time within the tick.
  [[nodiscard]] WinchMotion at(double t_s) const;

 private:
  /// As asked for if nobody brakes.
  [[nodiscard]] WinchMotion led(double t_s) const;
  [[nodiscard]] WinchMotion asked(double t_s) const;

  [[nodiscard]] bool exact() const {
    return settings_.lag_s == 0.0 && !settings_.rate_limit_m_s && !settings_.acceleration_limit_m_s2;
  }

  WinchSettings settings_;
  OnSilence on_silence_;
  WinchTarget target_;
  double target_since_s_ = 0.0;
  double brakes_at_s_ = std::numeric_limits<double>::infinity();
  bool led_ = false;
  CatchUp<double> catch_up_{0.0};
  DigitalLoop<double> drum_;
};

}  // namespace gyre::simulator
