#include "coordinator/core/recovery.hpp"

#include <algorithm>

#include "common/protocol/course.hpp"

namespace gyre::coordinator {

using protocol::Stage;
using protocol::Transition;

void Recovery::take(LocalTime arrived, const protocol::AgentStatus& status) {
  highest_term_ = std::max(highest_term_, status.term);
  last_transition_ = std::max(last_transition_, status.confirmed);
  if (status.term == 0 || status.course.base.number.none()) return;
  for (const Transition& t : status.course.transitions) last_transition_ = std::max(last_transition_, t.id);

  const Duration offset = status.swarm_time.time_since_epoch() - arrived.time_since_epoch();
  const Duration proven = offset - std::min(status.clock_uncertainty, kLongest);
  if (!proven_offset_ || proven > *proven_offset_) {
    proven_offset_ = proven;
    swarm_offset_ = offset;
  }

  const bool newer = !course_ || status.term > course_term_ ||
                     (status.term == course_term_ && status.course.revision > course_->revision);
  if (!newer) return;
  course_term_ = status.term;
  course_ = status.course;
  auto& transitions = course_->transitions;
  transitions.erase(
      std::remove_if(transitions.begin(), transitions.end(), [](const Transition& t) { return t.stage != Stage::kGo; }),
      transitions.end());
}

void Recovery::take(const protocol::HeldPlans& held) {
  for (const protocol::NumberedSlice& numbered : held.slices) plans_[numbered.number][held.carrier] = numbered.slice;
}

std::optional<CarrierId> Recovery::stranger_to(const Slices& ours) const {
  for (const auto& [number, slices] : plans_) {
    for (const auto& [carrier, slice] : slices) {
      const auto own = ours.find(carrier);
      if (own != ours.end() && own->second.attachment_w_m != slice.attachment_w_m) return carrier;
    }
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
