#include "coordinator/core/recovery.hpp"

#include <algorithm>

#include "common/protocol/course.hpp"
#include "coordinator/core/load_obstacle.hpp"

namespace gyre::coordinator {

void Recovery::take(LocalTime arrived, const protocol::AgentStatus& status) {
  highest_term_ = std::max(highest_term_, status.term);
  if (status.term == 0 || status.course.none()) return;

  const Duration offset = status.swarm_time.time_since_epoch() - arrived.time_since_epoch();
  const Duration proven = offset - std::min(status.clock_uncertainty, kLongest);
  if (!proven_offset_ || proven > *proven_offset_) {
    proven_offset_ = proven;
    swarm_offset_ = offset;
  }

  if (!course_ || status.course.newer_than(*course_)) {
    course_ = status.course;
  } else if (!course_->newer_than(status.course) && course_->lease && status.course.lease) {
    course_->lease = std::max(*course_->lease, *status.course.lease);  // whoever has heard most of it
  }
}

void Recovery::take(const protocol::HeldPlans& held) {
  for (const protocol::NumberedSlice& numbered : held.slices) plans_[numbered.number][held.carrier] = numbered.slice;
  // Whoever flies it knows better.
  for (const protocol::NumberedSlice& numbered : held.neighbour) {
    plans_[numbered.number].emplace(numbered.slice.id, numbered.slice);
  }
}

std::optional<std::string> Recovery::obstacle_to(const Slices& ours) const {
  for (const auto& [number, slices] : plans_) {
    if (const auto why = load_obstacle(slices, ours)) return why;
  }
  return std::nullopt;
}

bool Recovery::complete_for(CarrierId carrier) const {
  if (!course_) return true;
  const auto numbers = protocol::plans_of(*course_);
  return std::all_of(numbers.begin(), numbers.end(), [&](const protocol::PlanNumber& number) {
    const auto plan = plans_.find(number);
    return plan != plans_.end() && plan->second.count(carrier) > 0;
  });
}

}  // namespace gyre::coordinator
