#include "ground/swarm/core/swarm_watch.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/term.hpp"
#include "ground/swarm/core/course_line.hpp"
#include "ground/swarm/core/swarm_complaint.hpp"

namespace gyre::ground {

SwarmWatch::SwarmWatch(const mission::Mission& mission, LocalTime now)
    : tolerance_(mission.load_tolerance), begin_(now), load_(mission.plan) {}

void SwarmWatch::see(LocalTime arrived, const SwarmMessage& message) {
  if (!view_.step(arrived, message)) return;
  if (const auto* load = std::get_if<protocol::LoadState>(&message)) load_.see(*load);
  if (const auto* health = std::get_if<protocol::Health>(&message)) {
    Duration& late = late_max_[health->process];
    late = std::max(late, health->late_max);
  }
}

std::optional<std::string> SwarmWatch::out_of_contact(LocalTime now) const {
  return ground::out_of_contact(view_, now);
}

Account SwarmWatch::account(LocalTime now) {
  Account account;
  account.time_s = seconds(now - begin_);
  account.complaint = complaint(view_, &load_, tolerance_, now).value_or("");
  account.course = view_.beacon() ? course_line(*view_.beacon(), view_.coordinator()) : "unknown";
  account.complaints = view_.complaints(now);
  account.late_max = std::exchange(late_max_, {});
  account.load = load_.take();
  account.allowed = tolerance_;
  if (const auto& coordinator = view_.coordinator()) {
    account.term = protocol::generation(coordinator->term);
    account.silent = coordinator->silent;
    account.skew = coordinator->skew;
    account.skew_budget = coordinator->skew_budget;
  }
  return account;
}

}  // namespace gyre::ground
