#include "coordinator/core/fleet.hpp"

#include <algorithm>

namespace gyre::coordinator {

Fleet::Fleet(const std::vector<CarrierId>& carriers, Duration timeout) {
  for (const CarrierId id : carriers) members_.emplace(id, Member(timeout));
}

bool Fleet::Member::prefers(LocalTime now, const protocol::AgentStatus& newcomer) const {
  if (followed != 0 && !vehicle.silent(now)) return newcomer.incarnation == followed;
  return status && status->course.none() && !newcomer.course.none();
}

Fleet::Verdict Fleet::take(LocalTime now, const protocol::AgentStatus& status) {
  const auto found = members_.find(status.carrier);
  if (found == members_.end()) return Verdict::kStranger;
  Member& member = found->second;
  if (member.agent.who() != status.incarnation) {
    using Heard = protocol::Incumbent::Verdict;
    if (member.agent.hear(now, status.incarnation, member.prefers(now, status)) == Heard::kRival) {
      member.rival_address = status.address;
      return Verdict::kRival;
    }
    member.restarted = member.status.has_value();
    member.sequences = {};
  }
  switch (member.sequences.take(status.sequence)) {
    case protocol::SequenceJudge::Verdict::kNew:
      break;
    case protocol::SequenceJudge::Verdict::kDuplicate:
      return Verdict::kDuplicate;
    case protocol::SequenceJudge::Verdict::kLate:
      return Verdict::kLate;
    case protocol::SequenceJudge::Verdict::kLeap:
      return Verdict::kLeap;
  }
  if (!member.status || status.beacons_received != member.status->beacons_received) member.hearing.heard(now);
  member.status = status;
  (void)member.agent.hear(now, status.incarnation);
  return Verdict::kTaken;
}

void Fleet::heard(LocalTime now, CarrierId carrier, std::uint64_t incarnation) {
  const auto found = members_.find(carrier);
  // Who begins a life tells it by a status.
  if (found != members_.end() && !found->second.agent.silent(now)) (void)found->second.agent.hear(now, incarnation);
}

bool Fleet::believes(LocalTime now, const protocol::CarrierState& state) {
  const auto found = members_.find(state.carrier);
  if (found == members_.end() || !found->second.vehicle.believes(now, state.incarnation)) return false;
  found->second.followed = state.follows;
  return true;
}

Fleet::Standing Fleet::standing(LocalTime now, CarrierId carrier, std::uint64_t incarnation) const {
  const auto found = members_.find(carrier);
  if (found == members_.end() || found->second.agent.silent(now)) return {};
  const Member& member = found->second;
  Standing standing{*member.agent.who(), {}};
  if (standing.believed != incarnation) {
    standing.rival = member.status->address;
  } else if (member.agent.contested(now)) {
    standing.rival = member.rival_address;
  }
  return standing;
}

std::vector<Fleet::Claim> Fleet::claimed_twice(LocalTime now) const {
  std::vector<Claim> out;
  for (const auto& [id, member] : members_) {
    if (member.agent.contested(now)) out.push_back({id, member.status->address, member.rival_address});
  }
  return out;
}

std::vector<CarrierId> Fleet::told_twice(LocalTime now) const {
  std::vector<CarrierId> out;
  for (const auto& [id, member] : members_) {
    if (member.vehicle.contested(now)) out.push_back(id);
  }
  return out;
}

std::vector<Fleet::Change> Fleet::changes(LocalTime now) {
  std::vector<Change> out;
  for (auto& [id, member] : members_) {
    const bool present = !member.agent.silent(now);
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

bool Fleet::in_touch(LocalTime now, CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found != members_.end() && !found->second.agent.silent(now) && !found->second.hearing.silent(now);
}

bool Fleet::silent(LocalTime now, CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found == members_.end() || found->second.agent.silent(now);
}

}  // namespace gyre::coordinator
