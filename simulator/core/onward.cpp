#include "simulator/core/onward.hpp"

#include <algorithm>

#include "common/protocol/follow.hpp"

namespace gyre::simulator {

void Onward::take(const protocol::AgentStatus& status) {
  if (!status.course.none()) course_ = status.course;  // of an agent that starts again, the former one's still holds
}

void Onward::take(const protocol::HeldPlans& held) {
  const auto flown = protocol::plans_of(course_);
  for (auto it = slices_.begin(); it != slices_.end();) {
    it = std::find(flown.begin(), flown.end(), it->first) == flown.end() ? slices_.erase(it) : std::next(it);
  }
  for (const protocol::NumberedSlice& numbered : held.slices) slices_.emplace(numbered.number, numbered.slice);
}

std::optional<protocol::Setpoint> Onward::at(SwarmTime now) const {
  const auto lookup = [this](const protocol::PlanNumber& number) {
    const auto found = slices_.find(number);
    return found == slices_.end() ? nullptr : &found->second;
  };
  if (course_.none()) return std::nullopt;
  const auto r = protocol::reference(course_, now, lookup);
  if (!r) return std::nullopt;
  const mechanics::CarrierSlice& slice = *lookup(course_.base.number);
  // As its agent would ask: ahead by what the winch and the vehicle lag.
  const auto place = mechanics::led(r->position_w_m, slice.vehicle_lag_s);
  const auto winch = mechanics::led(mechanics::paid_out(*r, slice.cable_stiffness_n_m), slice.winch_lag_s);
  protocol::Setpoint s;
  s.carrier = slice.id;
  s.swarm_time = now;
  s.position_w_m = place.value;
  s.velocity_w_m_s = place.first;
  s.acceleration_w_m_s2 = place.second;
  s.direction_w = r->direction_w.value;
  s.tension_n = r->tension_n.value;
  s.cable_length_m = r->length_m.value;
  s.winch_length_m = winch.value;
  s.winch_rate_m_s = winch.first;
  s.winch_acceleration_m_s2 = winch.second;
  return s;
}

}  // namespace gyre::simulator
