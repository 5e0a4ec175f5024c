#pragma once
// What a mission may say about the twin: how carriers and winches behave, what the wind does, how time is cut.

#include <cstdint>
#include <optional>
#include <set>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "simulator/core/wind.hpp"

namespace gyre::simulator {

struct SimulationSettings {
  std::optional<double> carrier_lag_s;          ///< absent: carriers realise setpoints exactly
  std::optional<double> winch_time_constant_s;  ///< less than three ticks counts as three ticks
  std::optional<double> winch_rate_limit_m_s;   ///< with neither of these, winches are exact
  std::set<CarrierId> holds;                    ///< whose vehicles brake without setpoints; the others go on
  WindSettings wind;
  std::uint64_t seed = 1;
  Duration tick = std::chrono::milliseconds(2);
  std::uint64_t incarnation = 0;  ///< of this process: whoever hears two simulators can tell them apart
};

}  // namespace gyre::simulator
