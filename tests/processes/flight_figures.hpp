#pragma once
// What a flight did to the load and to the setpoints, in figures.
//
// A setpoint carries position, velocity and acceleration, so a step shows without knowing the plan: two of them dt
// apart must agree with the curve between (Hermite). What is left is
//
//   position step   | p1 − p0 − dt (v0 + v1) / 2 + dt² (a1 − a0) / 12 |          O(dt^5) where nothing steps
//   velocity step   | v1 − v0 − dt (a0 + a1) / 2 |                               O(dt^3)
//
// Reference: the trapezoidal rule with end correction (Euler, Maclaurin).

#include <Eigen/Core>

#include "common/mechanics/plan.hpp"
#include "tests/processes/flight_observer.hpp"

namespace gyre::test {

struct LoadFigures {
  double displacement_max_m = 0.0;
  double rotation_max_deg = 0.0;
};

/// Away from the pose the mission gives it, over [from, to).
[[nodiscard]] LoadFigures load_figures(const FlightRecord& record, const mechanics::Load& load,
                                       LocalTime from = LocalTime::min(), LocalTime to = LocalTime::max());

struct SetpointFigures {
  double position_step_max_m = 0.0;
  double velocity_step_max_m_s = 0.0;
  Duration longest_gap{};  ///< between two setpoints of one agent's life, in swarm time
  int backwards = 0;       ///< setpoints whose swarm time is before the last one's
  /// Of an agent that was away, restarted or stopped: its first setpoint from where its carrier is by then.
  std::optional<double> return_step_max_m;
};

/// Setpoints further apart than this are no step: their agent was away.
inline constexpr Duration kAbsence = std::chrono::milliseconds(100);
/// Over all agents.
[[nodiscard]] SetpointFigures setpoint_figures(const FlightRecord& record);

}  // namespace gyre::test
