#include "coordinator/core/lease_book.hpp"

#include <algorithm>

namespace gyre::coordinator {

std::optional<SwarmTime> LeaseBook::step(LocalTime now, SwarmTime time, const protocol::Silence& silence,
                                         const std::vector<CarrierId>& carriers, const Fleet& fleet) {
  if (!silence.stop_after) return granted_ = std::nullopt;
  const SwarmTime ahead = time + *silence.stop_after;
  const SwarmTime next = ahead - ahead.time_since_epoch() % kStep;
  SwarmTime least = next;
  bool all = true;
  for (const CarrierId id : carriers) {
    const protocol::AgentStatus* status = fleet.status(id);
    if (status != nullptr && status->course.lease) confirmed_[id] = *status->course.lease;
    const auto confirmed = confirmed_.find(id);
    if (confirmed != confirmed_.end()) least = std::min(least, confirmed->second);
    all = all && confirmed != confirmed_.end() && fleet.in_touch(now, id);
  }
  // The first one is nobody's to confirm: nothing moves yet.
  if (!granted_ || (all && least >= std::min(*granted_, next))) {
    // What has ended is known to have ended; what is about to end could not be taken back any more.
    const bool too_late = granted_ && time <= *granted_ && *granted_ - time <= kPatience + kBelieved;
    if (!granted_ || (next > *granted_ && !too_late)) {
      granted_ = next;
      granted_at_ = time;
    }
  } else if (time - granted_at_ > kPatience && least > time) {
    granted_ = std::min(*granted_, least);
  }
  return granted_;
}

}  // namespace gyre::coordinator
