#include "ground/swarm/core/swarm_complaint.hpp"

#include "common/base/text.hpp"
#include "ground/swarm/core/course_line.hpp"

namespace gyre::ground {

std::optional<std::string> out_of_contact(const SwarmView& view, LocalTime now) {
  if (view.beacon_heard().silent(now)) return "the coordinator is not heard";
  if (view.load_heard().silent(now)) return "nobody tells where the load is";
  return std::nullopt;
}

std::optional<std::string> complaint(const SwarmView& view, const LoadGauge* load,
                                     const mission::LoadTolerance& tolerance, LocalTime now) {
  if (const auto missing = out_of_contact(view, now)) return missing;
  if (view.coordinator_heard().silent(now)) return "the coordinator beacons, but does not say how it is";
  const protocol::CoordinatorStatus& coordinator = *view.coordinator();
  if (!coordinator.silent.empty()) return text("carrier %u is silent", coordinator.silent.front());
  const protocol::Beacon& beacon = *view.beacon();
  const protocol::Course& course = beacon.course;
  if (course.wish.by == protocol::Wisher::kSilence && course.wish.pace == 0.0)
    return "all have stopped, because somebody fell silent";
  if (course.wish.by == protocol::Wisher::kEvidence && course.wish.pace == 0.0) {
    return "all have stopped, because a carrier got stuck";
  }
  if (!course.transitions.empty()) return "a transition is under way";
  if (!course.flown_pace(beacon.swarm_time).constant(beacon.swarm_time)) return "the pace is changing";
  if (beacon.proposal) return "a change is proposed";
  if (course.wish.pace != course.pace.target()) return pace_name(course.wish.pace) + " is wished, and not agreed yet";
  if (course.base.number != coordinator.plan) return "the load is not held by the mission's plan";
  if (coordinator.skew_budget > Duration::zero() && coordinator.skew > coordinator.skew_budget) {
    return text("the clocks may disagree by %.3g ms, the plan in force allows %.3g ms", 1e3 * seconds(coordinator.skew),
                1e3 * seconds(coordinator.skew_budget));
  }
  if (const auto words = view.complaints(now); !words.empty()) {
    return words.begin()->first + ": " + words.begin()->second;
  }
  if (!load) return std::nullopt;
  if (load->displacement_now_m() > tolerance.displacement_max_m) {
    return text("the load is %.3g mm away, the mission allows %.3g mm", 1e3 * load->displacement_now_m(),
                1e3 * tolerance.displacement_max_m);
  }
  if (load->rotation_now_deg() > tolerance.rotation_max_deg) {
    return text("the load is turned by %.3g degrees, the mission allows %.3g", load->rotation_now_deg(),
                tolerance.rotation_max_deg);
  }
  return std::nullopt;
}

}  // namespace gyre::ground
