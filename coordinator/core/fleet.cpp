#include "coordinator/core/fleet.hpp"

#include <algorithm>

namespace gyre::coordinator {
namespace {

/// A rival that is not heard for so long is gone.
constexpr Duration kRivalGone = std::chrono::seconds(1);
/// Both are heard for so long: not just the last word of one who died.
constexpr Duration kRivalReal = std::chrono::milliseconds(300);

}  // namespace

Fleet::Fleet(const std::vector<CarrierId>& carriers, Duration timeout) {
  for (const CarrierId id : carriers) members_.emplace(id, Member(timeout));
}

Fleet::Verdict Fleet::take(LocalTime now, const protocol::AgentStatus& status) {
  const auto found = members_.find(status.carrier);
  if (found == members_.end()) return Verdict::kStranger;
  Member& member = found->second;
  if (member.status && member.status->incarnation != status.incarnation) {
    if (!member.liveness.silent(now)) {
      if (!member.rival || now - member.rival->last > kRivalGone) member.rival = Member::Rival{now, now};
      member.rival->last = now;
      return Verdict::kRival;
    }
    member.rival.reset();
    member.restarted = true;
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
  member.liveness.heard(now);
  return Verdict::kTaken;
}

std::vector<CarrierId> Fleet::claimed_twice(LocalTime now) const {
  std::vector<CarrierId> out;
  for (const auto& [id, member] : members_) {
    const bool both = member.rival && now - member.rival->last <= kRivalGone && !member.liveness.silent(now) &&
                      std::min(*member.liveness.last(), member.rival->last) - member.rival->since >= kRivalReal;
    if (both) out.push_back(id);
  }
  return out;
}

void Fleet::heard(LocalTime now, CarrierId carrier, std::uint64_t incarnation) {
  const auto found = members_.find(carrier);
  if (found == members_.end() || !found->second.status) return;
  if (found->second.status->incarnation == incarnation) found->second.liveness.heard(now);
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

bool Fleet::in_touch(LocalTime now, CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found != members_.end() && !found->second.liveness.silent(now) && !found->second.hearing.silent(now);
}

bool Fleet::silent(LocalTime now, CarrierId carrier) const {
  const auto found = members_.find(carrier);
  return found == members_.end() || found->second.liveness.silent(now);
}

}  // namespace gyre::coordinator
