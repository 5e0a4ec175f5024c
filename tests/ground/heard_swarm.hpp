#pragma once
// A swarm as somebody hears it who looks on: every message of one that flies as it should, for a test to change before
// it tells it.

#include <map>
#include <string>
#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mission/mission.hpp"
#include "common/protocol/follow.hpp"
#include "ground/swarm/core/swarm_view.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::ground::test {

inline constexpr protocol::PlanNumber kMotion{0x10000, 2};

/// Carriers on a polygon, in full motion.
struct HeardSwarm {
  explicit HeardSwarm(std::size_t n = 4) {
    mission.name = "polygon";
    mission.plan = mechanics::test::polygon_plan(n);
    beacon.term = status.term = beacon.course.term = text.term = kMotion.term;
    beacon.course.base.number = status.plan = text.plan = kMotion;
    beacon.course.pace = at_pace(1.0);
    beacon.course.wish = {1.0, false, protocol::Wisher::kPerson};
    status.mission = mission.name;
    status.skew_budget = std::chrono::milliseconds(10);
    status.skew = std::chrono::milliseconds(1);
    text.text = mission::to_text(mission);
    load.position_w_m = mission.plan.load.position_w_m;
    load.orientation_w_b = mission.plan.load.orientation_w_b;
    load.incarnation = 900;
    for (const mechanics::CarrierSlice& slice : mechanics::slices(mission.plan)) {
      status.carriers.push_back(slice.id);
      protocol::HeldPlans& held_now = held[slice.id];
      held_now.carrier = slice.id;
      held_now.slices = {{kMotion, slice}};
      protocol::AgentStatus& agent = agents[slice.id];
      agent.carrier = slice.id;
      agent.incarnation = 100 + slice.id;
      agent.term = kMotion.term;
      agent.state = protocol::AgentState::kFlying;
      agent.clock_uncertainty = std::chrono::microseconds(50);
      agent.course = beacon.course;
      agent.accepted = {kMotion};
      agent.address = "here, pid " + std::to_string(1000 + slice.id);
      vehicles[slice.id].carrier = slice.id;
      vehicles[slice.id].incarnation = load.incarnation;
    }
    pass(Duration::zero());
  }

  /// Time goes on, and everything with it.
  void pass(Duration duration) {
    now += duration;
    swarm_now += duration;
    beacon.swarm_time = status.swarm_time = swarm_now;
    ++beacon.sequence;
    beacon.course.lease = swarm_now + std::chrono::seconds(5);
    load.stamp = now;
    for (auto& [id, vehicle] : vehicles) {
      const auto reference = planned(id);
      vehicle.stamp = now;
      vehicle.position_w_m = reference.position_w_m.value;
      vehicle.velocity_w_m_s = reference.position_w_m.first;
      vehicle.tension_n = 5.0;
      vehicle.cable_length_m = vehicle.winch_length_m = 3.0;
    }
  }

  [[nodiscard]] mechanics::Reference planned(CarrierId id) const {
    const mechanics::CarrierSlice* const slice = &held.at(id).slices.front().slice;
    return *protocol::reference(beacon.course, swarm_now, [slice](const protocol::PlanNumber&) { return slice; });
  }

  /// All that this swarm says now, one message after the other.
  [[nodiscard]] std::vector<SwarmMessage> all() const {
    std::vector<SwarmMessage> words{beacon, status, text, load};
    for (const auto& [id, agent] : agents) words.insert(words.end(), {agent, held.at(id), vehicles.at(id)});
    return words;
  }
  void tell_all(SwarmView& view) const {
    for (const SwarmMessage& message : all()) view.step(now, message);
  }

  static protocol::Pace at_pace(double pace) {
    return {{{SwarmTime{}, Duration{}, {PlanTime{}, pace, 0.0, 0.0}, pace}}};
  }
  static protocol::Health health(const std::string& process, const std::string& complaint = "") {
    protocol::Health word;
    word.process = process;
    word.complaint = complaint;
    return word;
  }

  mission::Mission mission;
  LocalTime now{std::chrono::seconds(100)};
  SwarmTime swarm_now{std::chrono::seconds(5000)};
  protocol::Beacon beacon;
  protocol::CoordinatorStatus status;
  protocol::MissionText text;
  protocol::LoadState load;
  std::map<CarrierId, protocol::AgentStatus> agents;
  std::map<CarrierId, protocol::HeldPlans> held;
  std::map<CarrierId, protocol::CarrierState> vehicles;
};

}  // namespace gyre::ground::test
