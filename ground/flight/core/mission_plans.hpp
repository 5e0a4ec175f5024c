#pragma once
// Which of a swarm's plans are those of the mission that is flown here, by the numbers that its coordinator tells.
//
// The first word counts. What a coordinator names later is another mission's motion, a retune, about which this mission
// says nothing; a coordinator that takes over knows its mission's plans again, under the numbers they had.

#include "common/protocol/messages.hpp"

namespace gyre::ground {

struct MissionPlans {
  protocol::PlanNumber rest;
  protocol::PlanNumber motion;

  void learn(const protocol::CoordinatorStatus& status) {
    if (known()) return;
    rest = status.rest;
    motion = status.motion;
  }
  /// False until the coordinator has told.
  [[nodiscard]] bool known() const { return !motion.none(); }
};

}  // namespace gyre::ground
