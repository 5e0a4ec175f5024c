#pragma once
// Which of a swarm's plans is that of the mission that is flown here, by the number that its coordinator tells.
//
// The first word counts. What a coordinator names later is another mission's motion, a retune, about which this mission
// says nothing; a coordinator that takes over knows its mission's plan again, under the number it had.

#include "common/protocol/messages.hpp"

namespace gyre::ground {

struct MissionPlan {
  protocol::PlanNumber number;

  void learn(const protocol::CoordinatorStatus& status) {
    if (!known()) number = status.plan;
  }
  /// False until the coordinator has told.
  [[nodiscard]] bool known() const { return !number.none(); }
};

}  // namespace gyre::ground
