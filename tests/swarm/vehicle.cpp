#include "tests/swarm/vehicle.hpp"

#include "simulator/core/extrapolation.hpp"

namespace gyre::swarm {

protocol::Setpoint Vehicle::realised(const protocol::Setpoint& asked) const {
  const auto late = [](auto& x, auto& rate, const auto& acceleration, double lag_s) {
    x += lag_s * (lag_s * acceleration - rate);
    rate -= lag_s * acceleration;
  };
  protocol::Setpoint s = asked;
  late(s.position_w_m, s.velocity_w_m_s, s.acceleration_w_m_s2, vehicle_lag_s_);
  late(s.winch_length_m, s.winch_rate_m_s, s.winch_acceleration_m_s2, winch_lag_s_);
  return s;
}

void Vehicle::command(TrueTime now, const protocol::Setpoint& setpoint) {
  since_ = now;
  last_ = setpoint;
  led_ = true;
  alone_at_.reset();
  gap_w_m_ = simulator::CatchUp<Eigen::Vector3d>(Eigen::Vector3d::Zero());
  gap_m_ = simulator::CatchUp<double>(0.0);
}

protocol::Setpoint Vehicle::extrapolated(TrueTime now) const {
  const auto w = simulator::extrapolate(seconds(now - since_));
  protocol::Setpoint s = last_;
  s.position_w_m += w.by_velocity * last_.velocity_w_m_s + w.by_acceleration * last_.acceleration_w_m_s2;
  s.velocity_w_m_s = w.rate_by_velocity * last_.velocity_w_m_s + w.rate_by_acceleration * last_.acceleration_w_m_s2;
  s.winch_length_m += w.by_velocity * last_.winch_rate_m_s;
  s.winch_rate_m_s = w.rate_by_velocity * last_.winch_rate_m_s;
  return s;
}

protocol::Setpoint Vehicle::braked(TrueTime now) const {
  protocol::Setpoint s = extrapolated(since_ + simulator::kGoesOnAfter);
  const double braking_s = seconds(now - since_ - simulator::kGoesOnAfter);
  const auto [travelled_s, share] = simulator::fade(braking_s, simulator::kBraking_s);
  s.position_w_m += travelled_s * s.velocity_w_m_s;
  s.winch_length_m += travelled_s * s.winch_rate_m_s;
  // The share's slope, −w'.
  const double slope_1_s = -mechanics::smooth_step(braking_s, simulator::kBraking_s).first;
  s.acceleration_w_m_s2 = slope_1_s * s.velocity_w_m_s;
  s.winch_acceleration_m_s2 = slope_1_s * s.winch_rate_m_s;
  s.velocity_w_m_s *= share;
  s.winch_rate_m_s *= share;
  return s;
}

protocol::Setpoint Vehicle::doing(TrueTime now) {
  if (!led_ || now - since_ <= simulator::kGoesOnAfter) return extrapolated(now);
  if (on_silence_ == simulator::OnSilence::kHolds) return braked(now);
  const auto path = onward_.at(last_.swarm_time + (now - since_));
  if (!path) return extrapolated(now);
  protocol::Setpoint s = realised(*path);
  const double now_s = seconds(now.time_since_epoch());
  // Its agent was merging back when it died, or starts again and tells of another path: nobody leaps there.
  const protocol::Setpoint here = alone_at_ ? went_on(now) : extrapolated(now);
  const auto left = gap_w_m_.at(now_s);
  if ((here.position_w_m - s.position_w_m - left.value).norm() > simulator::kCalledElsewhere_m) {
    gap_w_m_.begin({here.position_w_m - s.position_w_m, here.velocity_w_m_s - s.velocity_w_m_s}, now_s);
    gap_m_.begin({here.winch_length_m - s.winch_length_m, here.winch_rate_m_s - s.winch_rate_m_s}, now_s);
  }
  const auto place = gap_w_m_.at(now_s);
  const auto winch = gap_m_.at(now_s);
  s.position_w_m += place.value;
  s.velocity_w_m_s += place.rate;
  s.winch_length_m += winch.value;
  s.winch_rate_m_s += winch.rate;
  alone_at_ = now;
  did_ = s;
  return s;
}

protocol::Setpoint Vehicle::went_on(TrueTime now) const {
  const double dt_s = seconds(now - *alone_at_);
  protocol::Setpoint s = did_;
  s.position_w_m += dt_s * (did_.velocity_w_m_s + 0.5 * dt_s * did_.acceleration_w_m_s2);
  s.velocity_w_m_s += dt_s * did_.acceleration_w_m_s2;
  s.winch_length_m += dt_s * did_.winch_rate_m_s;
  return s;
}

protocol::CarrierState Vehicle::state(TrueTime now) {
  const protocol::Setpoint s = doing(now);
  protocol::CarrierState state;
  state.incarnation = 1;  // of the world they all live in
  state.follows = follows(now);
  state.position_w_m = s.position_w_m;
  state.velocity_w_m_s = s.velocity_w_m_s;
  state.winch_length_m = s.winch_length_m;
  state.winch_rate_m_s = s.winch_rate_m_s;
  state.cable_length_m = s.winch_length_m;
  return state;
}

}  // namespace gyre::swarm
