#include "tests/processes/flight_figures.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"

namespace gyre::test {
namespace {

using Setpoints = Heards<protocol::Setpoint>;

void take_pair(const protocol::Setpoint& a, const protocol::Setpoint& b, SetpointFigures& figures) {
  const Duration apart = b.swarm_time - a.swarm_time;
  if (apart < Duration::zero()) ++figures.backwards;
  figures.longest_gap = std::max(figures.longest_gap, apart);
  if (apart <= Duration::zero() || apart > kAbsence) return;
  const double dt = seconds(apart);
  const Eigen::Vector3d position_step = b.position_w_m - a.position_w_m -
                                        0.5 * dt * (a.velocity_w_m_s + b.velocity_w_m_s) +
                                        dt * dt / 12.0 * (b.acceleration_w_m_s2 - a.acceleration_w_m_s2);
  const Eigen::Vector3d velocity_step =
      b.velocity_w_m_s - a.velocity_w_m_s - 0.5 * dt * (a.acceleration_w_m_s2 + b.acceleration_w_m_s2);
  figures.position_step_max_m = std::max(figures.position_step_max_m, position_step.norm());
  figures.velocity_step_max_m_s = std::max(figures.velocity_step_max_m_s, velocity_step.norm());
}

/// `first`: what an agent says after it was away. Its carrier has gone on meanwhile, by itself.
void take_return(const Heard<protocol::Setpoint>& first, const Heards<protocol::CarrierState>& states,
                 SetpointFigures& figures) {
  const auto after =
      std::find_if(states.begin(), states.end(), [&](const auto& s) { return s.arrived >= first.arrived; });
  if (after == states.begin()) return;
  const Heard<protocol::CarrierState>& last = *std::prev(after);
  const Eigen::Vector3d carrier_w_m =
      last.message.position_w_m + seconds(first.arrived - last.arrived) * last.message.velocity_w_m_s;
  const double step = (first.message.position_w_m - carrier_w_m).norm();
  figures.return_step_max_m = std::max(figures.return_step_max_m.value_or(0.0), step);
}

}  // namespace

LoadFigures load_figures(const FlightRecord& record, const mechanics::Load& load, LocalTime from, LocalTime to) {
  LoadFigures figures;
  for (const auto& heard : record.load) {
    if (heard.arrived < from || heard.arrived >= to) continue;
    const protocol::LoadState& s = heard.message;
    figures.displacement_max_m = std::max(figures.displacement_max_m, (s.position_w_m - load.position_w_m).norm());
    figures.rotation_max_deg = std::max(
        figures.rotation_max_deg, degrees(s.orientation_w_b.angularDistance(Eigen::Quaterniond(load.orientation_w_b))));
  }
  return figures;
}

SetpointFigures setpoint_figures(const FlightRecord& record) {
  SetpointFigures figures;
  for (const auto& [id, carrier] : record.carriers) {
    const Setpoints& heard = carrier.setpoints;
    for (std::size_t i = 1; i < heard.size(); ++i) {
      const protocol::Setpoint& before = heard[i - 1].message;
      const protocol::Setpoint& now = heard[i].message;
      const bool restarted = now.sequence <= before.sequence;  // an agent counts its setpoints from one
      if (!restarted) take_pair(before, now, figures);
      if (restarted || now.swarm_time - before.swarm_time > kAbsence) take_return(heard[i], carrier.states, figures);
    }
  }
  return figures;
}

}  // namespace gyre::test
