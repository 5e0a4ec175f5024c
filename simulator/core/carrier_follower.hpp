#pragma once
// How a carrier realises its setpoints: exactly, or with a first-order lag whose feed-forward leaves no steady error.
//
//   p*(t)   what the setpoint asks for, extrapolated (extrapolation.hpp)      3   W   m
//   p(t)    where the carrier is                                              3   W   m
//   e       p* − p                                                            3   W   m
//
//   p' = p*' + e / T     so   e(t) = e(t0) exp(−(t − t0) / T): exact over any step
//
// A setpoint that differs from what was extrapolated moves an exact carrier there at once; a lagging one keeps its
// place and takes the difference up as error. After a silence that made it slow down, either catches up (catch_up.hpp).
// One that holds brakes what it is asked for (on_silence.hpp).

#include <Eigen/Core>
#include <limits>
#include <optional>

#include "simulator/core/catch_up.hpp"
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
  /// Rests there until the first command. An absent lag means exact.
  CarrierFollower(const Eigen::Vector3d& rest_position_w_m, std::optional<double> lag_s,
                  OnSilence on_silence = OnSilence::kGoesOn);

  /// From `now` on follows a target that held at `held` <= now.
  void command(const CarrierTarget& target, double held_s, double now_s, Hand hand = Hand::kSame);

  /// At any time since the last command.
  [[nodiscard]] CarrierMotion at(double t_s) const;

 private:
  /// As asked for if nobody brakes.
  [[nodiscard]] CarrierMotion led(double t_s) const;
  [[nodiscard]] CarrierMotion asked(double t_s) const;

  std::optional<double> lag_s_;
  OnSilence on_silence_;
  CarrierTarget target_;
  double target_since_s_ = 0.0;
  double brakes_at_s_ = std::numeric_limits<double>::infinity();
  bool led_ = false;
  CatchUp<Eigen::Vector3d> catch_up_{Eigen::Vector3d::Zero()};
  Eigen::Vector3d error_w_m_ = Eigen::Vector3d::Zero();  // at error_since_s_
  double error_since_s_ = 0.0;
};

}  // namespace gyre::simulator
