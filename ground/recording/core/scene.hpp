#pragma once
// What a swarm looks like at a moment, for whoever replays a recording without Gyre: load, cables, carriers, planned
// orbits, as standard messages.
//
// Cables run from the attachment to the carrier. Where the mission is known the attachment moves with the load as it
// is; otherwise it is where the carrier's plan has it, which is the same while the load hangs still. A cable's colour
// is its tension between the mission's limits, from blue at the least to red at the greatest, and between nothing and
// the greatest present one where there are no limits.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/mission/mission.hpp"
#include "ground/recording/core/visual_messages.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

struct Scene {
  std::optional<Pose> load;       ///< absent: none was heard
  std::vector<NamedPose> frames;  ///< "load", "carrier_3"
  std::vector<Marker> markers;    ///< what moves
};

/// `mission` as far as it is known.
[[nodiscard]] Scene scene(const SwarmView& view, const mission::Mission* mission);

/// Where the carriers are to go in one round of the plan in force; none before it is told. It changes with the plan
/// only.
[[nodiscard]] std::vector<Marker> planned_orbits(const SwarmView& view);

}  // namespace gyre::ground
