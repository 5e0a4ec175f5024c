#pragma once
// Where a swarm is between its plans, in words: "motion", "rest -> motion (40 %)".

#include <optional>
#include <string>

#include "common/protocol/messages.hpp"

namespace gyre::ground {

/// "rest" or "motion" where the coordinator has told which plan is which, else "plan 3.7": its term and revision.
[[nodiscard]] std::string plan_name(const protocol::PlanNumber& plan,
                                    const std::optional<protocol::CoordinatorStatus>& coordinator);

[[nodiscard]] std::string course_line(const protocol::Beacon& beacon,
                                      const std::optional<protocol::CoordinatorStatus>& coordinator);

}  // namespace gyre::ground
