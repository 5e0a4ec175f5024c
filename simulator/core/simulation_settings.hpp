#pragma once
// What a mission may say about the twin: how it differs from what the plan says of its vehicles and winches, what the
// wind does, how time is cut.

#include <cstdint>
#include <optional>
#include <set>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "simulator/core/wind.hpp"

namespace gyre::simulator {

struct SimulationSettings {
  std::optional<double> carrier_lag_s;  ///< of every carrier, which no agent knows of; absent: as the plan says
  double lag_error = 0.0;               ///< winches and vehicles lag by 1 + this times what the plan says
  std::set<CarrierId> holds;            ///< whose vehicles brake without setpoints; the others go on
  WindSettings wind;
  std::uint64_t seed = 1;
  Duration tick = std::chrono::milliseconds(2);
  std::uint64_t incarnation = 0;  ///< of this process: whoever hears two simulators can tell them apart
};

}  // namespace gyre::simulator
