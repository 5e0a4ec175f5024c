#pragma once
// The swarm as figures for a monitoring system, in Prometheus' text form.

#include <optional>
#include <string>

#include "ground/page/core/known_mission.hpp"
#include "ground/swarm/core/load_gauge.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

/// `load`: since the last call. `mission` may be unknown (nullptr): then there are no margins. What is not heard any
/// more has no figure.
[[nodiscard]] std::string metrics_text(const SwarmView& view, const KnownMission* mission, const LoadWindow& load,
                                       const std::optional<std::string>& complaint, LocalTime now);

}  // namespace gyre::ground
