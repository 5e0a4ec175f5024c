#include "coordinator/core/lease_book.hpp"

#include <algorithm>

namespace gyre::coordinator {

std::optional<SwarmTime> LeaseBook::step(LocalTime now, SwarmTime time, const protocol::Silence& silence,
                                         const std::vector<CarrierId>& carriers, const Fleet& fleet) {
  if (!silence.stop_after) return granted_ = std::nullopt;
  const SwarmTime ahead = time + *silence.stop_after;
  const SwarmTime next = ahead - ahead.time_since_epoch() % kStep;
  SwarmTime least = SwarmTime::max();
  bool all = true;
  for (const CarrierId id : carriers) {
    const protocol::AgentStatus* status = fleet.status(id);
    if (status != nullptr && status->course.lease) confirmed_[id] = *status->course.lease;
    const auto confirmed = confirmed_.find(id);
    if (confirmed != confirmed_.end()) least = std::min(least, confirmed->second);
    all = all && confirmed != confirmed_.end() && fleet.in_touch(now, id);
  }
  // Nobody moves before the first one, which is nobody's to confirm, nor after the end of one, which all know.
  const bool nobody_moves = !granted_ || time > *granted_;
  const Duration took = time - granted_at_;
  if (!granted_ || (all && least >= *granted_)) {
    // What is about to end could not be taken back any more.
    const bool too_late = !nobody_moves && *granted_ - time <= kPatience + kBelieved;
    if (!granted_ || (next > *granted_ && !too_late)) {
      if (took <= kPatience) reach_ = std::clamp(2 * took, kStep, kReach);
      granted_ = nobody_moves ? next : std::min(next, *granted_ + reach_);
      granted_at_ = time;
    }
  } else if (took > kPatience && least > time && least < *granted_) {
    // Longer by next to nothing: a late word about this step shall not confirm the next one.
    reach_ = std::max(kStep, *granted_ - least + Duration(1));
    granted_ = least;
  }
  return granted_;
}

}  // namespace gyre::coordinator
