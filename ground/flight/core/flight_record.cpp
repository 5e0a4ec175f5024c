#include "ground/flight/core/flight_record.hpp"

#include <algorithm>

#include "common/base/angle.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::ground {

void FlownFigures::include(const protocol::CarrierState& state) {
  tension_n.include(state.tension_n);
  length_m.include(state.cable_length_m);
  speed_m_s.include(state.velocity_w_m_s.norm());
  winch_rate_m_s.include(state.winch_rate_m_s);
  altitude_m.include(state.position_w_m.z());
  ++samples;
}

FlightRecord::FlightRecord(const mechanics::Plan& plan)
    : position_w_m_(plan.load.position_w_m), orientation_w_b_(plan.load.orientation_w_b) {
  for (const mechanics::Carrier& carrier : plan.carriers) carriers_.push_back({carrier.id, {}, {}});
}

void FlightRecord::see(const protocol::CarrierState& state, bool motion_proper) {
  const auto record =
      std::find_if(carriers_.begin(), carriers_.end(), [&](const CarrierRecord& r) { return r.id == state.carrier; });
  if (record == carriers_.end() || !sane(state)) return;
  record->whole.include(state);
  if (motion_proper) record->motion.include(state);
  ++timing_.carrier_states;
}

void FlightRecord::see(const protocol::LoadState& state, LocalTime arrived) {
  if (!sane(state)) return;
  load_.displacement_now_m = (state.position_w_m - position_w_m_).norm();
  load_.rotation_now_deg = degrees(state.orientation_w_b.angularDistance(orientation_w_b_));
  load_.displacement_max_m = std::max(load_.displacement_max_m, load_.displacement_now_m);
  load_.rotation_max_deg = std::max(load_.rotation_max_deg, load_.rotation_now_deg);
  ++load_.samples;

  // The two clocks have nothing in common; how their difference varies is how late the simulator was.
  const Duration delay = arrived.time_since_epoch() - state.stamp.time_since_epoch();
  least_delay_ = std::min(least_delay_.value_or(delay), delay);
  timing_.simulator_lag_max = std::max(timing_.simulator_lag_max, delay - *least_delay_);
}

void FlightRecord::see(const protocol::AgentStatus& status) {
  Missed& missed = missed_.try_emplace(status.carrier, Missed{status.beacons_missed, 0}).first->second;
  missed.last = status.beacons_missed;
  timing_.clock_uncertainty_max = std::max(timing_.clock_uncertainty_max, status.clock_uncertainty);
}

void FlightRecord::see(const protocol::Health& health) {
  if (!timing_.latest.empty() && health.late_max <= timing_.late_max) return;
  timing_.late_max = health.late_max;
  timing_.latest = health.process;
}

TimingRecord FlightRecord::timing() const {
  TimingRecord timing = timing_;
  for (const auto& [id, missed] : missed_) timing.beacons_missed += missed.last - std::min(missed.first, missed.last);
  return timing;
}

}  // namespace gyre::ground
