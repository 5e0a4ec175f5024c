#pragma once
// What a swarm flies, in words: "motion", "rest -> motion (40 %)", "motion at 50 %".

#include <optional>
#include <string>

#include "common/protocol/messages.hpp"

namespace gyre::ground {

/// "rest", "motion", "motion at 50 %".
[[nodiscard]] std::string pace_name(double pace);

/// "the mission's" where the coordinator has told which that is, else "plan 3.7": its term and revision.
[[nodiscard]] std::string plan_name(const protocol::PlanNumber& plan,
                                    const std::optional<protocol::CoordinatorStatus>& coordinator);

[[nodiscard]] std::string course_line(const protocol::Beacon& beacon,
                                      const std::optional<protocol::CoordinatorStatus>& coordinator);

}  // namespace gyre::ground
