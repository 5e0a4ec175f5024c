#include "ground/swarm/core/swarm_view.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/follow.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::ground {
namespace {

/// Names are the sender's to choose: a liar shall not fill the memory. Every agent there can be, and the hubs.
constexpr std::size_t kMaxProcesses = 128;

constexpr double kOnItsWay_s = 0.01;

bool is_carrier(CarrierId id) {
  return id >= 1 && id <= kMaxCarrierId;
}

/// Those that there can be, each of them once: who shows them keeps a place for each.
std::vector<CarrierId> possible(const std::vector<CarrierId>& told) {
  std::vector<CarrierId> ids;
  for (const CarrierId id : told) {
    if (is_carrier(id) && std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
  }
  return ids;
}

/// Of a coordinator that leads no longer, while a later one is heard: two may be heard for a moment, as one takes over.
template <class Word>
bool is_outdated(const std::optional<Word>& before, const Word& word, const protocol::Liveness& heard, LocalTime now) {
  return before && word.term < before->term && !heard.silent(now);
}

}  // namespace

bool SwarmView::step(LocalTime arrived, const SwarmMessage& message) {
  const bool believed = std::visit([&](const auto& one) { return on(arrived, one); }, message);
  if (!believed) ++refused_;
  return believed;
}

bool SwarmView::on(LocalTime arrived, const protocol::Beacon& beacon) {
  if (!sane(beacon) || is_outdated(beacon_, beacon, beacon_heard_, arrived)) return false;
  beacon_ = beacon;
  beacon_arrived_ = arrived;
  beacon_heard_.heard(arrived);
  return true;
}

bool SwarmView::on(LocalTime arrived, const protocol::CoordinatorStatus& status) {
  if (is_outdated(coordinator_, status, coordinator_heard_, arrived)) return false;
  coordinator_ = status;
  coordinator_->carriers = possible(status.carriers);
  coordinator_->silent = possible(status.silent);
  coordinator_heard_.heard(arrived);
  if (outdated_mission_ && outdated_mission_->term == status.term) {
    mission_ = std::exchange(outdated_mission_, std::nullopt);
  }
  return true;
}

bool SwarmView::on(LocalTime arrived, const protocol::AgentStatus& status) {
  if (!is_carrier(status.carrier) || !sane(status)) return false;
  CarrierView& carrier = carriers_[status.carrier];
  if (!carrier.agents.believes(arrived, status.incarnation)) return false;
  carrier.agent = status;
  carrier.agent_heard = arrived;
  return true;
}

bool SwarmView::on(LocalTime /*arrived*/, const protocol::HeldPlans& held) {
  if (!is_carrier(held.carrier) || !sane(held)) return false;
  auto& slices = carriers_[held.carrier].slices;
  slices.clear();
  for (const protocol::NumberedSlice& entry : held.slices) slices[entry.number] = entry.slice;
  return true;
}

bool SwarmView::on(LocalTime arrived, const protocol::CarrierState& state) {
  if (!is_carrier(state.carrier) || !sane(state)) return false;
  CarrierView& carrier = carriers_[state.carrier];
  if (!carrier.vehicles.believes(arrived, state.incarnation)) return false;
  carrier.vehicle = state;
  carrier.vehicle_heard = arrived;
  return true;
}

bool SwarmView::on(LocalTime arrived, const protocol::LoadState& load) {
  if (!sane(load) || !loads_.believes(arrived, load.incarnation)) return false;
  load_ = load;
  return true;
}

bool SwarmView::on(LocalTime arrived, const protocol::Health& health) {
  if (processes_.size() >= kMaxProcesses && processes_.count(health.process) == 0) return false;
  ProcessView& process = processes_[health.process];
  process.word = health;
  process.heard.heard(arrived);
  return true;
}

bool SwarmView::on(LocalTime arrived, const protocol::MissionText& mission) {
  if (is_outdated(mission_, mission, coordinator_heard_, arrived)) {
    outdated_mission_ = mission;  // it is said once: who says it may lead when the other one is gone
    return false;
  }
  mission_ = mission;
  return true;
}

bool SwarmView::on(LocalTime /*arrived*/, const protocol::Command& /*command*/) {
  return true;  // what comes of it is seen in the course
}

bool SwarmView::on(LocalTime /*arrived*/, const protocol::CommandReply& /*reply*/) {
  return true;
}

std::optional<SwarmTime> SwarmView::swarm_time(LocalTime now) const {
  if (!beacon_) return std::nullopt;
  return beacon_->swarm_time + (now - beacon_arrived_);
}

bool SwarmView::named_silent(CarrierId carrier) const {
  if (!coordinator_) return false;
  const auto& silent = coordinator_->silent;
  return std::find(silent.begin(), silent.end(), carrier) != silent.end();
}

std::vector<CarrierId> SwarmView::carrier_ids() const {
  if (coordinator_) return coordinator_->carriers;
  std::vector<CarrierId> ids;
  for (const auto& [id, carrier] : carriers_) ids.push_back(id);
  return ids;
}

std::optional<mechanics::Reference> SwarmView::planned(CarrierId carrier, SwarmTime at) const {
  const auto found = carriers_.find(carrier);
  if (!beacon_ || found == carriers_.end()) return std::nullopt;
  const auto& slices = found->second.slices;
  return protocol::reference(beacon_->course, at, [&](const protocol::PlanNumber& number) {
    const auto slice = slices.find(number);
    return slice == slices.end() ? nullptr : &slice->second;
  });
}

std::optional<double> SwarmView::deviation_m(CarrierId carrier) const {
  const auto found = carriers_.find(carrier);
  if (!beacon_ || found == carriers_.end() || !found->second.vehicle) return std::nullopt;
  const auto then = planned(carrier, *swarm_time(*found->second.vehicle_heard));
  if (!then || !then->position_w_m.value.allFinite()) return std::nullopt;
  const Eigen::Vector3d off = found->second.vehicle->position_w_m - then->position_w_m.value;
  const Eigen::Vector3d& velocity = then->position_w_m.first;
  if (velocity.squaredNorm() == 0.0) return off.norm();
  const double late_s = std::clamp(off.dot(velocity) / velocity.squaredNorm(), -kOnItsWay_s, kOnItsWay_s);
  return (off - late_s * velocity).norm();
}

std::map<std::string, std::string> SwarmView::complaints(LocalTime now) const {
  std::map<std::string, std::string> complaints;
  for (const auto& [name, process] : processes_) {
    if (!process.word.complaint.empty() && !process.heard.silent(now)) complaints[name] = process.word.complaint;
  }
  return complaints;
}

}  // namespace gyre::ground
