#include "simulator/core/vehicle.hpp"

#include <cmath>

namespace gyre::simulator {

void Vehicle::take_up(const protocol::Setpoint& setpoint, LocalTime held, LocalTime now, LocalTime start) {
  // Its agent may have begun where this vehicle was by then, on its own way.
  const Hand hand = silent(now) ? Hand::kReturns : Hand::kSame;
  last_ = Last{setpoint, held};
  alone_ = false;
  command(setpoint, seconds(held - start), seconds(now - start), hand);
}

void Vehicle::tick(LocalTime now, LocalTime start) {
  if (on_silence_ == OnSilence::kGoesOn && silent(now)) go_on(now, start);
  follower_.tick(seconds(now - start));
  winch_.tick(seconds(now - start));
}

void Vehicle::go_on(LocalTime now, LocalTime start) {
  const auto s = path(now);
  if (!s) return;
  // An agent that was merging back when it died led it beside its path; one that starts again tells of another path.
  const Hand hand = alone_ || was_led_elsewhere() ? Hand::kAnother : Hand::kSame;
  alone_ = true;
  command(*s, seconds(now - start), seconds(now - start), hand);
}

std::optional<protocol::Setpoint> Vehicle::path(LocalTime now) const {
  if (!last_) return std::nullopt;
  auto s = onward.at(last_->setpoint.swarm_time + (now - last_->held));
  if (s && s->carrier != id) return std::nullopt;
  return s;
}

bool Vehicle::was_led_elsewhere() const {
  const protocol::Setpoint& told = last_->setpoint;
  const auto meant = path(last_->held);
  return !meant || (meant->position_w_m - told.position_w_m).norm() > kCalledElsewhere_m ||
         std::abs(meant->winch_length_m - told.winch_length_m) > kCalledElsewhere_m;
}

void Vehicle::command(const protocol::Setpoint& s, double held_s, double now_s, Hand hand) {
  follower_.command({s.position_w_m, s.velocity_w_m_s, s.acceleration_w_m_s2}, held_s, now_s, hand);
  winch_.command({s.winch_length_m, s.winch_rate_m_s, s.winch_acceleration_m_s2}, held_s, now_s, hand);
}

Anchor Vehicle::anchor(double t_s) const {
  const CarrierMotion carrier = follower_.at(t_s);
  const WinchMotion drum = winch_.at(t_s);
  return {carrier.position_w_m, carrier.velocity_w_m_s, drum.length_m, drum.rate_m_s};
}

}  // namespace gyre::simulator
