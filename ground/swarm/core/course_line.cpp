#include "ground/swarm/core/course_line.hpp"

#include <algorithm>

#include "common/base/text.hpp"
#include "common/protocol/course.hpp"
#include "common/protocol/term.hpp"

namespace gyre::ground {

std::string pace_name(double pace) {
  if (pace == 0.0) return "rest";
  if (pace == 1.0) return "motion";
  return text("motion at %.3g %%", 100.0 * pace);
}

std::string plan_name(const protocol::PlanNumber& plan, const std::optional<protocol::CoordinatorStatus>& coordinator) {
  if (coordinator && plan == coordinator->plan) return "the mission's";
  return text("plan %llu.%llu", protocol::generation(plan.term), static_cast<unsigned long long>(plan.revision));
}

std::string course_line(const protocol::Beacon& beacon, const std::optional<protocol::CoordinatorStatus>& coordinator) {
  const SwarmTime now = beacon.swarm_time;
  const auto share = [](Duration since, Duration length) {
    return text(" (%.0f %%)", 100.0 * std::clamp(seconds(since) / seconds(length), 0.0, 1.0));
  };
  const protocol::Pace pace = beacon.course.flown_pace(now);
  const protocol::Ramp& ramp = pace.ramps.back();
  std::string line = pace_name(pace.constant(now) ? ramp.target : ramp.from.pace);
  if (!pace.constant(now)) line += " -> " + pace_name(ramp.target) + share(now - ramp.start, ramp.duration);
  if (coordinator && beacon.course.base.number != coordinator->plan) {
    line += " by " + plan_name(beacon.course.base.number, coordinator);
  }
  const PlanTime plan_time = pace.at(now).at;
  for (const protocol::Transition& t : beacon.course.transitions) {
    line += ", going over to " + plan_name(t.to.number, coordinator) + share(plan_time - t.start, t.duration);
  }
  if (beacon.proposal) line += ", a change is proposed";
  return line;
}

}  // namespace gyre::ground
