// How far a flight has come, told by messages and a clock that is an argument; and who is missing.

#include "ground/flight/core/flight_monitor.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gyre::ground {
namespace {

using protocol::Stage;

constexpr double kSwarmAhead_s = 5000.0;                    // swarm time has nothing to do with this process's clock
constexpr protocol::PlanNumber kRest{7, 9}, kMotion{5, 2};  // whatever they are called

LocalTime local(double time_s) {
  return LocalTime(from_seconds(time_s));
}
SwarmTime swarm(double local_s) {
  return SwarmTime(from_seconds(local_s + kSwarmAhead_s));
}

protocol::Transition go(const protocol::PlanNumber& to, double start_s, double duration_s, std::uint64_t id = 1) {
  return {id, {to, swarm(0.0)}, swarm(start_s), from_seconds(duration_s), Stage::kGo};
}

class FlightMonitorTest : public testing::Test {
 protected:
  FlightMonitor monitor{{1, 2, 5}, local(0.0)};
  protocol::Course course;

  void SetUp() override { course.base = {kRest, swarm(0.0)}; }

  void beacon(double time_s) {
    protocol::Beacon beacon;
    beacon.term = 1;
    beacon.swarm_time = swarm(time_s);
    beacon.course = course;
    monitor.see(beacon, local(time_s));
  }
  /// The coordinator's, while the mission in force has this motion.
  void word(const protocol::PlanNumber& motion = kMotion, std::uint64_t term = 7) {
    protocol::CoordinatorStatus status;
    status.term = term;
    status.rest = kRest;
    status.motion = motion;
    monitor.see(status);
  }
  void agent(CarrierId id, double time_s, bool ready = true) {
    protocol::AgentStatus status;
    status.carrier = id;
    status.accepted = ready ? std::vector{kRest, kMotion} : std::vector{kRest};
    monitor.see(status, local(time_s));
  }
  void everybody(double time_s) {
    beacon(time_s);
    word();
    for (const CarrierId id : {1U, 2U, 5U}) agent(id, time_s);
    monitor.see(protocol::CarrierState{}, local(time_s));
  }
  [[nodiscard]] std::string phase(double time_s) const { return name(monitor.phase(local(time_s))); }
  [[nodiscard]] std::string complaint(double time_s) const { return monitor.complaint(local(time_s)).value_or("none"); }
};

TEST_F(FlightMonitorTest, GoesThroughAWholeFlight) {
  EXPECT_EQ(phase(0.0), "starting");
  beacon(0.5);
  EXPECT_EQ(phase(0.5), "starting");  // no simulator yet
  monitor.see(protocol::CarrierState{}, local(0.6));
  agent(1, 0.6);
  EXPECT_EQ(phase(0.6), "starting");  // and nobody knows yet which plan is the motion
  EXPECT_EQ(monitor.agents_ready(), 0);
  word();
  EXPECT_EQ(phase(0.6), "matching");
  agent(1, 0.7);
  agent(2, 0.7, false);
  EXPECT_EQ(monitor.agents_ready(), 1);
  everybody(1.0);
  EXPECT_EQ(monitor.agents_ready(), 3);
  EXPECT_EQ(phase(1.0), "engaging");
  EXPECT_FALSE(monitor.under_way(local(1.0)));

  course.transitions = {go(kMotion, 2.0, 4.0)};
  everybody(1.5);
  EXPECT_FALSE(monitor.under_way(local(1.9)));
  EXPECT_TRUE(monitor.under_way(local(2.1)));
  EXPECT_EQ(phase(5.9), "engaging");
  EXPECT_EQ(seconds(monitor.flown(local(5.9))), 0.0);
  EXPECT_EQ(phase(6.1), "flying");  // even when no beacon says so
  EXPECT_NEAR(seconds(monitor.flown(local(16.0))), 10.0, 1e-9);

  course.base.number = kMotion;
  course.transitions.clear();
  everybody(7.0);
  EXPECT_EQ(phase(7.0), "flying");
  course.transitions = {go(kRest, 20.0, 4.0, 2)};
  everybody(19.0);
  EXPECT_EQ(phase(19.9), "flying");
  EXPECT_EQ(phase(20.1), "releasing");
  EXPECT_NEAR(seconds(monitor.flown(local(23.0))), 14.0, 1e-9);
  EXPECT_TRUE(monitor.under_way(local(23.9)));
  EXPECT_FALSE(monitor.under_way(local(24.1)));
  EXPECT_EQ(phase(24.1), "releasing");
  EXPECT_EQ(monitor.transition_duration(), from_seconds(4.0));
}

TEST_F(FlightMonitorTest, AProposedTransitionIsNotYetATransition) {
  course.transitions = {go(kMotion, 2.0, 4.0)};
  course.transitions[0].stage = Stage::kProposed;
  everybody(1.0);
  EXPECT_EQ(phase(3.0), "engaging");
  EXPECT_FALSE(monitor.under_way(local(3.0)));
  EXPECT_EQ(monitor.flown(local(9.0)), Duration::zero());
}

TEST_F(FlightMonitorTest, TurningBackHalfWayNeverFlew) {
  course.transitions = {go(kMotion, 2.0, 4.0), go(kRest, 3.0, 4.0, 2)};
  everybody(3.5);
  EXPECT_EQ(phase(3.5), "releasing");
  EXPECT_EQ(monitor.flown(local(9.0)), Duration::zero());
}

TEST_F(FlightMonitorTest, APlanOfItsOwnIsADeviation) {
  course.base.number = kMotion;
  course.transitions = {go({7, 10}, 10.0, 4.0, 2)};
  everybody(9.5);
  EXPECT_EQ(phase(9.9), "flying");
  EXPECT_EQ(phase(10.1), "deviated");
  EXPECT_NE(complaint(10.1).find("plan of its own"), std::string::npos);
}

TEST_F(FlightMonitorTest, ARetuneIsADeviationThoughTheCoordinatorCallsItTheMotion) {
  constexpr protocol::PlanNumber kRetuned{7, 11};
  course.base.number = kMotion;
  everybody(9.0);
  word(kRetuned);
  EXPECT_EQ(phase(9.5), "flying");
  course.transitions = {go(kRetuned, 10.0, 4.0, 2)};
  everybody(9.5);
  EXPECT_EQ(phase(9.9), "flying");
  EXPECT_EQ(phase(10.1), "deviated");
}

TEST_F(FlightMonitorTest, ACoordinatorThatTakesOverAndKnowsThePlansAgainChangesNothing) {
  course.transitions = {go(kMotion, 2.0, 4.0)};
  everybody(5.0);
  word(kMotion, 8);
  everybody(7.0);
  EXPECT_EQ(phase(7.0), "flying");
  EXPECT_NEAR(seconds(monitor.flown(local(16.0))), 10.0, 1e-9);
}

TEST_F(FlightMonitorTest, WhatIsUnderWayIsKnownWhenTheCoordinatorHasTold) {
  course.transitions = {go(kMotion, 2.0, 4.0)};
  beacon(1.5);
  monitor.see(protocol::CarrierState{}, local(1.5));
  EXPECT_EQ(phase(3.0), "starting");
  EXPECT_FALSE(monitor.under_way(local(3.0)));
  word();
  EXPECT_EQ(phase(1.6), "matching");
  EXPECT_TRUE(monitor.under_way(local(3.0)));
  beacon(3.1);
  EXPECT_EQ(phase(3.1), "engaging");
  EXPECT_NEAR(seconds(monitor.flown(local(16.0))), 10.0, 1e-9);
}

TEST_F(FlightMonitorTest, NamesWhoDidNotComeUp) {
  EXPECT_EQ(complaint(19.0), "none");
  EXPECT_EQ(complaint(21.0), "the coordinator was not heard within 20 s");
  beacon(21.0);
  EXPECT_EQ(complaint(21.0), "the coordinator did not tell which plan is which within 20 s");
  word();
  EXPECT_EQ(complaint(21.0), "the simulator was not heard within 20 s");
  monitor.see(protocol::CarrierState{}, local(21.0));
  EXPECT_EQ(complaint(21.0), "none");
  agent(2, 22.0);
  EXPECT_EQ(complaint(31.0), "agents 1 and 5 did not accept the motion within 30 s");
  agent(1, 31.0);
  EXPECT_EQ(complaint(31.0), "agent 5 did not accept the motion within 30 s");
}

TEST_F(FlightMonitorTest, ARefusalIsToldAtOnce) {
  everybody(1.0);
  protocol::AgentStatus status;
  status.carrier = 5;
  status.refused = kMotion;
  status.refusal = "tension 9 N, this vehicle lifts 5 N";
  monitor.see(status, local(1.1));
  EXPECT_EQ(complaint(1.1), "agent 5 refuses the motion: tension 9 N, this vehicle lifts 5 N");
}

TEST_F(FlightMonitorTest, AMotionThatNeverBeginsIsToldOf) {
  for (double t = 1.0; t < 33.0; t += 1.0) everybody(t);
  EXPECT_NE(complaint(32.5).find("did not begin the motion within 30 s"), std::string::npos) << complaint(32.5);
}

TEST_F(FlightMonitorTest, SilenceIsNamed) {
  course.transitions = {go(kMotion, 2.0, 4.0)};
  everybody(7.0);
  EXPECT_EQ(complaint(11.0), "none");
  EXPECT_EQ(complaint(13.0), "the coordinator was silent for more than 5 s");
  beacon(13.0);
  EXPECT_EQ(complaint(13.0), "the simulator was silent for more than 5 s");
  monitor.see(protocol::CarrierState{}, local(13.0));
  agent(2, 13.0);
  EXPECT_EQ(complaint(13.0), "agents 1 and 5 were silent for more than 5 s");
}

TEST_F(FlightMonitorTest, StrangersDoNotCount) {
  agent(77, 1.0);
  EXPECT_EQ(monitor.agents_ready(), 0);
  EXPECT_EQ(monitor.agents(), 3);
}

}  // namespace
}  // namespace gyre::ground
