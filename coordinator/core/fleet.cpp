#include "coordinator/core/fleet.hpp"

namespace gyre::coordinator {

Fleet::Fleet(const std::vector<CarrierId>& carriers, Duration timeout) {
  for (const CarrierId id : carriers) members_.emplace(id, Member(timeout));
}

Fleet::Verdict Fleet::take(LocalTime now, const protocol::AgentStatus& status) {
  const auto found = members_.find(status.carrier);
  if (found == members_.end()) return Verdict::kStranger;
  Member& member = found->second;
  if (member.status && member.status->incarnation == status.incarnation) {
    if (status.sequence == member.status->sequence) return Verdict::kDuplicate;
    if (status.sequence < member.status->sequence) return Verdict::kLate;
  } else if (member.status) {
    if (status.incarnation == member.former) return Verdict::kLate;  // the dead confirm nothing
    member.former = member.status->incarnation;
    member.restarted = true;
  }
  member.status = status;
  member.liveness.heard(now);
  return Verdict::kTaken;
}

void Fleet::heard(LocalTime now, CarrierId carrier) {
  const auto found = members_.find(carrier);
  if (found != members_.end() && found->second.status) found->second.liveness.heard(now);
}

std::vector<Fleet::Change> Fleet::changes(LocalTime now) {
  std::vector<Change> out;
  for (auto& [id, member] : members_) {
    const bool present = !member.liveness.silent(now);
    if (present == member.known_present && !member.restarted) continue;
    out.push_back({id, !present, member.restarted});
    member.known_present = present;
    member.restarted = false;
  }
  return out;
}

const protocol::AgentStatus* Fleet::status(CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found == members_.end() || !found->second.status ? nullptr : &*found->second.status;
}

bool Fleet::silent(LocalTime now, CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found == members_.end() || found->second.liveness.silent(now);
}

std::optional<LocalTime> Fleet::last_heard(CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found == members_.end() ? std::nullopt : found->second.liveness.last();
}

}  // namespace gyre::coordinator
