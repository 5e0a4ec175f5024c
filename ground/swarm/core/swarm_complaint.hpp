#pragma once
// What is not as it should be in a swarm, the worst first: one sentence, or none.
//
//   nobody leads or tells where the load is > somebody is silent > it stopped by itself > it is changing > another plan
//   > clocks > what processes say of themselves > the load
//
// A swarm without a complaint is calm: it flies, or rests, as its mission says, and the load is where it should be.

#include <optional>
#include <string>

#include "common/mission/mission.hpp"
#include "ground/swarm/core/load_gauge.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

/// Whether the coordinator and the load are heard at all; absent: they are.
[[nodiscard]] std::optional<std::string> out_of_contact(const SwarmView& view, LocalTime now);

/// `load` may be unknown, with its mission: then it is not judged.
[[nodiscard]] std::optional<std::string> complaint(const SwarmView& view, const LoadGauge* load,
                                                   const mission::LoadTolerance& tolerance, LocalTime now);

}  // namespace gyre::ground
