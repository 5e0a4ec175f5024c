#pragma once
// A plan flown perfectly: every carrier and every winch exactly where the plan has them, at every moment.
//
// What remains is the load's own dynamics on elastic cables: how well the paper's equilibrium holds a real load.

#include "common/mechanics/plan.hpp"
#include "simulator/core/load_integrator.hpp"

namespace gyre::simulator {

enum class Stretch {
  kCompensated,  ///< the winch has paid out l − s/k, so that the stretched cable is l long
  kIgnored,      ///< the winch has paid out l, and the load sags
};

/// t = 0 is the plan's epoch.
[[nodiscard]] SurroundingsAt planned_surroundings(const mechanics::Plan& plan, Stretch stretch);

}  // namespace gyre::simulator
