#include "ground/swarm/core/course_line.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/protocol/course.hpp"
#include "common/protocol/term.hpp"

namespace gyre::ground {

std::string plan_name(const protocol::PlanNumber& plan, const std::optional<protocol::CoordinatorStatus>& coordinator) {
  if (coordinator && plan == coordinator->rest) return "rest";
  if (coordinator && plan == coordinator->motion) return "motion";
  return text("plan %llu.%llu", protocol::generation(plan.term), static_cast<unsigned long long>(plan.revision));
}

std::string course_line(const protocol::Beacon& beacon, const std::optional<protocol::CoordinatorStatus>& coordinator) {
  std::string line = plan_name(beacon.course.base.number, coordinator);
  for (const protocol::Transition& t : beacon.course.transitions) {
    const double progress = seconds(beacon.swarm_time - t.start) / seconds(t.duration);
    line += " -> " + plan_name(t.to.number, coordinator);
    line += t.stage == protocol::Stage::kProposed ? " (proposed)"
                                                  : text(" (%.0f %%)", 100.0 * std::clamp(progress, 0.0, 1.0));
  }
  return line;
}

}  // namespace gyre::ground
