#pragma once
// How a carrier realises its setpoints: exactly, or with a first-order lag, as vehicles do in the field.
//
//   p*(t)   what the setpoint asks for, extrapolated (extrapolation.hpp)      3   W   m
//   p(t)    where the carrier is                                              3   W   m
//   T       lag                                                               s
//
//   p' = (p* − p) / T     by a digital loop (digital_loop.hpp)
//
// So a lagging carrier is where it was asked to be T ago, and whoever does not want that asks ahead of time. A setpoint
// that differs from what was extrapolated moves an exact carrier there at once; a lagging one never jumps. A lag
// shorter than a tick is taken as one. After a silence that made it slow down, either catches up (catch_up.hpp). One
// that holds brakes what it is asked for (on_silence.hpp).

#include <Eigen/Core>
#include <limits>

#include "simulator/core/catch_up.hpp"
#include "simulator/core/digital_loop.hpp"
#include "simulator/core/on_silence.hpp"

namespace gyre::simulator {

struct CarrierMotion {
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
};

struct CarrierTarget {
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_w_m_s2 = Eigen::Vector3d::Zero();
};

class CarrierFollower {
 public:
  /// Rests there until the first command. A lag of 0 means exact.
  explicit CarrierFollower(const Eigen::Vector3d& rest_position_w_m, double lag_s = 0.0,
                           OnSilence on_silence = OnSilence::kGoesOn, double tick_s = 0.002);

  /// From `now` on follows a target that held at `held`, or holds in a moment.
  void command(const CarrierTarget& target, double held_s, double now_s, Hand hand = Hand::kSame);

  /// Decides the motion from `now` until the next tick; once per tick, in order.
  void tick(double now_s);

  /// At any time within the tick; of an exact one, since the last command.
  [[nodiscard]] CarrierMotion at(double t_s) const;

 private:
  /// As asked for if nobody brakes.
  [[nodiscard]] CarrierMotion led(double t_s) const;
  [[nodiscard]] CarrierMotion asked(double t_s) const;

  double lag_s_;
  double tick_s_;
  OnSilence on_silence_;
  CarrierTarget target_;
  double target_since_s_ = 0.0;
  double brakes_at_s_ = std::numeric_limits<double>::infinity();
  bool led_ = false;
  CatchUp<Eigen::Vector3d> catch_up_{Eigen::Vector3d::Zero()};
  DigitalLoop<Eigen::Vector3d> body_;
};

}  // namespace gyre::simulator
