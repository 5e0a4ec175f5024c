#include "simulator/core/carrier_follower.hpp"

#include <algorithm>

#include "simulator/core/extrapolation.hpp"

namespace gyre::simulator {

CarrierFollower::CarrierFollower(const Eigen::Vector3d& rest_position_w_m, double lag_s, OnSilence on_silence,
                                 double tick_s)
    : lag_s_(lag_s > 0.0 ? std::max(lag_s, tick_s) : 0.0),
      tick_s_(tick_s),
      on_silence_(on_silence),
      body_(rest_position_w_m, Eigen::Vector3d::Zero()) {
  target_.position_w_m = rest_position_w_m;
}

void CarrierFollower::command(const CarrierTarget& target, double held_s, double now_s, Hand hand) {
  const CarrierMotion before = asked(now_s);
  const bool slowed_down = led_ && (now_s - target_since_s_ > kExtrapolationHorizon_s || now_s > brakes_at_s_);
  led_ = true;
  target_ = target;
  target_since_s_ = held_s;
  brakes_at_s_ = brakes_at_s(on_silence_, now_s);
  const bool called_elsewhere = (hand == Hand::kAnother || (hand == Hand::kReturns && catch_up_.under_way(now_s))) &&
                                (asked(now_s).position_w_m - before.position_w_m).norm() > kCalledElsewhere_m;
  if (slowed_down || called_elsewhere) {
    catch_up_ = CatchUp<Eigen::Vector3d>(Eigen::Vector3d::Zero());
    const CarrierMotion wanted = asked(now_s);
    catch_up_.begin({before.position_w_m - wanted.position_w_m, before.velocity_w_m_s - wanted.velocity_w_m_s}, now_s);
  }
}

void CarrierFollower::tick(double now_s) {
  if (lag_s_ == 0.0) return;
  using Body = DigitalLoop<Eigen::Vector3d>;
  body_.go(now_s, tick_s_, Body::lagging(body_.at(now_s), asked(now_s + tick_s_).position_w_m, lag_s_, tick_s_));
}

CarrierMotion CarrierFollower::led(double t_s) const {
  const ExtrapolationWeights w = extrapolate(t_s - target_since_s_);
  const auto left = catch_up_.at(t_s);
  return {
      left.value + target_.position_w_m + w.by_velocity * target_.velocity_w_m_s +
          w.by_acceleration * target_.acceleration_w_m_s2,
      left.rate + w.rate_by_velocity * target_.velocity_w_m_s + w.rate_by_acceleration * target_.acceleration_w_m_s2};
}

CarrierMotion CarrierFollower::asked(double t_s) const {
  if (t_s <= brakes_at_s_) return led(t_s);
  const CarrierMotion last = led(brakes_at_s_);
  const Fading braking = fade(t_s - brakes_at_s_, kBraking_s);
  return {last.position_w_m + braking.travelled_s * last.velocity_w_m_s, braking.share * last.velocity_w_m_s};
}

CarrierMotion CarrierFollower::at(double t_s) const {
  if (lag_s_ == 0.0) return asked(t_s);
  const auto motion = body_.at(t_s);
  return {motion.value, motion.rate};
}

}  // namespace gyre::simulator
