// How far a flight has come, told by messages and a clock that is an argument; and who is missing.

#include "ground/flight/core/flight_monitor.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gyre::ground {
namespace {

constexpr double kSwarmAhead_s = 5000.0;       // swarm time has nothing to do with this process's clock
constexpr protocol::PlanNumber kMotion{5, 2};  // whatever it is called
constexpr std::uint64_t kTerm = 1;

LocalTime local(double time_s) {
  return LocalTime(from_seconds(time_s));
}
SwarmTime swarm(double local_s) {
  return SwarmTime(from_seconds(local_s + kSwarmAhead_s));
}

class FlightMonitorTest : public testing::Test {
 protected:
  SwarmView view;
  FlightMonitor monitor{view, {1, 2, 5}, local(0.0)};
  protocol::Course course;
  std::uint64_t word_term = 7;
  double last_s = 0.0;  ///< when the last message came

  void SetUp() override {
    course.term = kTerm;
    course.base = {kMotion, PlanTime{}};
  }

  void hear(double time_s, const SwarmMessage& message) {
    last_s = time_s;
    EXPECT_TRUE(view.step(local(time_s), message));
    monitor.look(local(time_s));
  }

  void ramp(double start_s, double duration_s, double target) {
    course.pace = course.pace.with_ramp(swarm(start_s), from_seconds(duration_s), target);
  }

  void beacon(double time_s) {
    protocol::Beacon beacon;
    beacon.term = kTerm;
    beacon.swarm_time = swarm(time_s);
    beacon.course = course;
    hear(time_s, beacon);
  }
  /// The coordinator's, while this is the plan of the mission in force.
  void word(const protocol::PlanNumber& motion = kMotion) {
    protocol::CoordinatorStatus status;
    status.term = word_term;
    status.plan = motion;
    hear(last_s, status);
  }
  void vehicle(double time_s) {
    protocol::CarrierState state;
    state.carrier = 1;
    hear(time_s, state);
  }
  void agent(CarrierId id, double time_s, bool ready = true) {
    protocol::AgentStatus status;
    status.carrier = id;
    status.accepted = ready ? std::vector{kMotion} : std::vector<protocol::PlanNumber>{};
    hear(time_s, status);
  }
  void everybody(double time_s) {
    beacon(time_s);
    word();
    for (const CarrierId id : {1U, 2U, 5U}) agent(id, time_s);
    vehicle(time_s);
  }
  [[nodiscard]] std::string phase(double time_s) const { return name(monitor.phase(local(time_s))); }
  [[nodiscard]] std::string complaint(double time_s) const { return monitor.complaint(local(time_s)).value_or("none"); }
};

TEST_F(FlightMonitorTest, GoesThroughAWholeFlight) {
  EXPECT_EQ(phase(0.0), "starting");
  beacon(0.5);
  EXPECT_EQ(phase(0.5), "starting");  // no simulator yet
  vehicle(0.6);
  agent(1, 0.6);
  EXPECT_EQ(phase(0.6), "starting");  // and nobody knows yet which plan is the mission's
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

  ramp(2.0, 4.0, 1.0);
  everybody(1.5);
  EXPECT_FALSE(monitor.under_way(local(1.9)));
  EXPECT_TRUE(monitor.under_way(local(2.1)));
  EXPECT_EQ(phase(5.9), "engaging");
  EXPECT_EQ(seconds(monitor.flown(local(5.9))), 0.0);
  EXPECT_EQ(phase(6.1), "flying");  // even when no beacon says so
  EXPECT_NEAR(seconds(monitor.flown(local(16.0))), 10.0, 1e-9);

  course.pace.settle(swarm(7.0));
  everybody(7.0);
  EXPECT_EQ(phase(7.0), "flying");
  ramp(20.0, 3.0, 0.0);
  everybody(19.0);
  EXPECT_EQ(phase(19.9), "flying");
  EXPECT_EQ(phase(20.1), "releasing");
  EXPECT_NEAR(seconds(monitor.flown(local(22.0))), 14.0, 1e-9);
  EXPECT_TRUE(monitor.under_way(local(22.9)));
  EXPECT_FALSE(monitor.under_way(local(23.1)));
  EXPECT_EQ(phase(23.1), "releasing");
  EXPECT_EQ(monitor.transition_duration(), from_seconds(3.0));
}

TEST_F(FlightMonitorTest, WhatIsProposedIsNotYetAgreed) {
  protocol::Beacon beacon;
  beacon.term = kTerm;
  beacon.swarm_time = swarm(1.0);
  beacon.course = course;
  beacon.proposal = course;
  beacon.proposal->pace = course.pace.with_ramp(swarm(2.0), from_seconds(4.0), 1.0);
  everybody(1.0);
  hear(1.0, beacon);
  EXPECT_EQ(phase(3.0), "engaging");
  EXPECT_FALSE(monitor.under_way(local(3.0)));
  EXPECT_EQ(monitor.flown(local(9.0)), Duration::zero());
}

TEST_F(FlightMonitorTest, TurningBackHalfWayNeverFlew) {
  ramp(2.0, 4.0, 1.0);
  everybody(2.5);
  ramp(3.0, 4.0, 0.0);
  everybody(3.5);
  EXPECT_EQ(phase(3.5), "releasing");
  EXPECT_EQ(monitor.flown(local(9.0)), Duration::zero());
}

TEST_F(FlightMonitorTest, AnotherPaceIsFlownOnAndEndsNothing) {
  everybody(1.0);
  ramp(2.0, 4.0, 1.0);
  everybody(7.0);
  ramp(10.0, 2.0, 0.5);
  everybody(9.0);
  EXPECT_EQ(phase(9.9), "flying");
  EXPECT_EQ(phase(10.1), "slowed");
  EXPECT_EQ(phase(12.1), "slowed");
  EXPECT_TRUE(monitor.under_way(local(12.1)));
  EXPECT_NEAR(seconds(monitor.flown(local(15.0))), 4.0, 1e-9) << "at full pace";
  course.pace.settle(swarm(16.0));
  ramp(17.0, 2.0, 1.0);
  everybody(16.0);
  EXPECT_EQ(phase(16.5), "slowed") << "a change that is only announced has not begun, and nothing rests";
  EXPECT_TRUE(monitor.under_way(local(16.5)));
  EXPECT_EQ(phase(17.5), "engaging");
  EXPECT_EQ(phase(19.1), "flying");
}

TEST_F(FlightMonitorTest, WhatOvertakesARampIsToldOfWhenItBegins) {
  ramp(2.0, 4.0, 1.0);
  everybody(2.5);
  ramp(4.0, 2.0, 0.0);
  everybody(3.0);
  EXPECT_EQ(phase(3.5), "engaging");
  EXPECT_TRUE(monitor.under_way(local(3.5)));
  EXPECT_EQ(phase(4.5), "releasing");
}

TEST_F(FlightMonitorTest, APlanThatIsNotTheMissionsIsADeviation) {
  ramp(2.0, 4.0, 1.0);
  everybody(7.0);
  EXPECT_EQ(phase(9.5), "flying");
  course.transitions = {{{{7, 10}, PlanTime{}}, PlanTime(from_seconds(9.0)), from_seconds(4.0)}};
  everybody(9.5);
  EXPECT_EQ(phase(10.1), "deviated");
  EXPECT_NE(complaint(10.1).find("left the motion by itself"), std::string::npos);
}

TEST_F(FlightMonitorTest, AStopBySilenceIsADeviationAtRestToo) {
  ramp(2.0, 4.0, 1.0);
  everybody(7.0);
  ramp(8.0, 2.0, 0.0);
  course.wish = {0.0, false, protocol::Wisher::kSilence};
  everybody(9.0);
  EXPECT_EQ(phase(9.5), "deviated");
  EXPECT_EQ(phase(11.5), "deviated");
  EXPECT_TRUE(monitor.under_way(local(11.5)));
}

TEST_F(FlightMonitorTest, AtTheEndOfALeaseTheSwarmStopsThoughNoBeaconSaysSo) {
  ramp(2.0, 4.0, 1.0);
  course.lease = swarm(12.0);
  course.stopping = from_seconds(2.0);
  everybody(7.0);
  EXPECT_EQ(phase(11.9), "flying");
  EXPECT_EQ(phase(12.1), "releasing");
  EXPECT_TRUE(monitor.under_way(local(13.9)));
  EXPECT_FALSE(monitor.under_way(local(14.1)));
}

TEST_F(FlightMonitorTest, ARetuneIsADeviationThoughTheCoordinatorCallsItTheMissions) {
  constexpr protocol::PlanNumber kRetuned{7, 11};
  ramp(2.0, 4.0, 1.0);
  everybody(9.0);
  word(kRetuned);
  EXPECT_EQ(phase(9.5), "flying");
  course.transitions = {{{kRetuned, PlanTime{}}, PlanTime(from_seconds(9.0)), from_seconds(4.0)}};
  everybody(9.5);
  EXPECT_EQ(phase(10.1), "deviated");
}

TEST_F(FlightMonitorTest, ACoordinatorThatTakesOverAndKnowsThePlanAgainChangesNothing) {
  ramp(2.0, 4.0, 1.0);
  everybody(5.0);
  ++word_term;
  everybody(7.0);
  EXPECT_EQ(phase(7.0), "flying");
  EXPECT_NEAR(seconds(monitor.flown(local(16.0))), 10.0, 1e-9);
}

TEST_F(FlightMonitorTest, WhatIsUnderWayIsKnownWhenTheCoordinatorHasTold) {
  ramp(2.0, 4.0, 1.0);
  beacon(1.5);
  vehicle(1.5);
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
  EXPECT_EQ(complaint(21.0), "the coordinator did not tell which plan is the mission's within 20 s");
  word();
  EXPECT_EQ(complaint(21.0), "the simulator was not heard within 20 s");
  vehicle(21.0);
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
  hear(1.1, status);
  EXPECT_EQ(complaint(1.1), "agent 5 refuses the motion: tension 9 N, this vehicle lifts 5 N");
}

TEST_F(FlightMonitorTest, AMotionThatNeverBeginsIsToldOf) {
  for (double t = 1.0; t < 33.0; t += 1.0) everybody(t);
  EXPECT_NE(complaint(32.5).find("did not begin the motion within 30 s"), std::string::npos) << complaint(32.5);
}

TEST_F(FlightMonitorTest, SilenceIsNamed) {
  ramp(2.0, 4.0, 1.0);
  everybody(7.0);
  EXPECT_EQ(complaint(11.0), "none");
  EXPECT_EQ(complaint(13.0), "the coordinator was silent for more than 5 s");
  beacon(13.0);
  EXPECT_EQ(complaint(13.0), "the simulator was silent for more than 5 s");
  vehicle(13.0);
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
