#pragma once
// All that a perfect swarm says in a flight: from rest to full pace and back, every carrier where the plan has it.

#include <functional>
#include <string>
#include <vector>

#include "common/mechanics/reference.hpp"
#include "common/mission/mission.hpp"
#include "ground/swarm/core/swarm_view.hpp"
#include "tests/places.hpp"

namespace gyre::test {

inline mission::Mission shipped_mission(const std::string& name) {
  auto mission = mission::read_mission_file(source_directory() + "/deploy/missions/" + name + ".textproto");
  GYRE_ENSURE(mission.ok(), "a shipped mission is read");
  return std::move(mission).value();
}

class PerfectSwarm {
 public:
  static constexpr double kEngage_s = 5.0, kRamp_s = 10.0, kRelease_s = 100.0, kEnd_s = 115.0, kBeat_s = 0.1;
  static constexpr double kSwarmAhead_s = 1234.5;  ///< of the clock of who hears it
  static constexpr protocol::PlanNumber kMotion{5, 2};

  explicit PerfectSwarm(mission::Mission flown) : mission(std::move(flown)), slices(mechanics::slices(mission.plan)) {}

  [[nodiscard]] std::vector<ground::Heard> flight() const {
    std::vector<ground::Heard> out;
    if (tells_mission) say(out, 0.0, protocol::MissionText{kMotion.term, kMotion, mission::to_text(mission)});
    for (int k = 0; k * kBeat_s < kEnd_s; ++k) {
      const double t_s = k * kBeat_s;
      if (k % 5 == 0) say(out, t_s, word(t_s));
      say(out, t_s, beacon(t_s));
      for (const mechanics::CarrierSlice& slice : slices) {
        protocol::CarrierState state = carrier(slice, t_s);
        spoil(t_s, state);
        if (state.carrier != 0) say(out, t_s, state);
      }
      say(out, t_s, load(t_s));
    }
    return out;
  }

  [[nodiscard]] static SwarmTime swarm_time(double t_s) { return SwarmTime(from_seconds(t_s + kSwarmAhead_s)); }

  [[nodiscard]] static protocol::Course course(double t_s) {
    protocol::Course course;
    course.term = kMotion.term;
    course.revision = t_s < kRelease_s ? 3 : 4;
    course.base = {kMotion, PlanTime{}};
    course.pace = course.pace.with_ramp(swarm_time(kEngage_s), from_seconds(kRamp_s), 1.0);
    if (t_s >= kRelease_s) course.pace = course.pace.with_ramp(swarm_time(kRelease_s), from_seconds(kRamp_s), 0.0);
    return course;
  }

  mission::Mission mission;
  std::vector<mechanics::CarrierSlice> slices;
  bool tells_mission = true;
  /// What a carrier tells instead; as carrier 0, nothing.
  std::function<void(double, protocol::CarrierState&)> spoil = [](double, protocol::CarrierState&) {};

 private:
  template <class Message>
  static void say(std::vector<ground::Heard>& out, double t_s, Message message) {
    out.push_back({std::move(message), LocalTime(from_seconds(1e6 + t_s))});
  }

  static protocol::Beacon beacon(double t_s) {
    protocol::Beacon beacon;
    beacon.term = kMotion.term;
    beacon.swarm_time = swarm_time(t_s);
    beacon.course = course(t_s);
    return beacon;
  }

  [[nodiscard]] protocol::CoordinatorStatus word(double t_s) const {
    protocol::CoordinatorStatus status;
    status.term = kMotion.term;
    status.plan = kMotion;
    status.mission = mission.name;
    status.swarm_time = swarm_time(t_s);
    return status;
  }

  static protocol::CarrierState carrier(const mechanics::CarrierSlice& slice, double t_s) {
    const protocol::PlanMoment moment = course(t_s).moment(swarm_time(t_s));
    const mechanics::Reference r = mechanics::evaluate(slice, seconds(moment.at.time_since_epoch()));
    protocol::CarrierState state;
    state.carrier = slice.id;
    state.incarnation = 1;
    state.position_w_m = r.position_w_m.value;
    state.velocity_w_m_s = moment.pace * r.position_w_m.first;
    state.tension_n = r.tension_n.value;
    state.cable_length_m = r.length_m.value;
    state.winch_length_m = r.length_m.value;
    state.winch_rate_m_s = moment.pace * r.length_m.first;
    return state;
  }

  [[nodiscard]] protocol::LoadState load(double t_s) const {
    protocol::LoadState state;
    state.incarnation = 1;
    state.stamp = LocalTime(from_seconds(t_s));
    state.position_w_m = mission.plan.load.position_w_m + Eigen::Vector3d(1e-5 * t_s / kEnd_s, 0.0, 0.0);
    state.orientation_w_b = mission.plan.load.orientation_w_b;
    return state;
  }
};

}  // namespace gyre::test
