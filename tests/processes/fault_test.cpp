// The loss table with real programs: packets really dropped, clocks really wrong, the coordinator really killed; and a
// load that is measured all along. At the end the table, as the README has it.

#include "tests/processes/fault_fixture.hpp"

namespace gyre::test {
namespace {

using protocol::AgentState;
using protocol::AgentStatus;
using protocol::CommandKind;
using protocol::Wisher;

const auto* const kTable = testing::AddGlobalTestEnvironment(new LossTable);

// ---------------------------------------------------------------------------------------------------------- the wire

TEST_F(FaultTest, NothingGoesWrong) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  wait(6.0);
  land();
  expect_unmoved(measure("none", "the floor of this table"));
}

TEST_F(FaultTest, EveryThirdPacketIsLost) {
  ASSERT_NO_FATAL_FAILURE(start(mission()));
  network_->lose(30, instrument());
  ASSERT_NO_FATAL_FAILURE(fly());
  wait(6.0);
  land();
  EXPECT_GT(network_->lost(), 1000U);
  expect_unmoved(measure("30 % of all packets lost, from the start", lost_packets()));
}

TEST_F(FaultTest, MostPacketsAreLost) {
  // Fast DDS takes a minute to match everybody at such losses (it asks for a lost endpoint again once per second), so
  // the losses begin when the processes have met. Everything that is agreed, is agreed under them.
  ASSERT_NO_FATAL_FAILURE(start(mission(), {}, false));
  ASSERT_TRUE(FaultFlight::seconds_until(kStart_s, [&] { return flight_->all_ready(); })) << flight_->said_by_all();
  network_->lose(60, instrument_and_vehicles());
  flight_->observer().command(CommandKind::kEngage);
  ASSERT_NO_FATAL_FAILURE(fly());
  wait(6.0);
  land();
  EXPECT_GT(network_->lost(), 2000U);
  expect_unmoved(measure("60 % of all packets lost, but on board", lost_packets()));
}

TEST_F(FaultTest, MostPacketsAreLostOnBoardToo) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  network_->lose(60, instrument());
  wait(6.0);
  EXPECT_GT(network_->lost(), 2000U);
  const Row& row = measure("60 % of all packets lost, on the way to the vehicles too", lost_packets());
  // Every tenth of a second without a setpoint is flown on a parabola.
  EXPECT_LT(row.load.displacement_max_m, kSwing_m);
  expect_continuous(row);
}

TEST_F(FaultTest, TheRadioIsOutAndAllFlyOn) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_with(kFlyOn)));
  network_->lose(100, instrument_and_vehicles());
  wait(kLease_s + 2.0);
  EXPECT_TRUE(flight_->every_agent(
      [](const AgentStatus& s) { return s.state == AgentState::kAlone && !s.course.rests(s.swarm_time); }));
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  wait(2.0);
  ASSERT_TRUE(took);
  expect_unmoved(
      measure("radio out for 7 s, policy fly on", text("all hear the coordinator again %.1f s after", *took)));
}

TEST_F(FaultTest, TheRadioIsOutWithinTheLease) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  network_->lose(100, instrument_and_vehicles());
  wait(3.0);
  EXPECT_TRUE(flight_->every_agent([](const AgentStatus& s) { return s.state == AgentState::kAlone; }));
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  wait(kLease_s);
  EXPECT_TRUE(flight_->all_flying()) << "what was in doubt was only the lease";
  ASSERT_TRUE(took);
  expect_unmoved(measure("radio out for 3 s", text("all hear the coordinator again %.1f s after", *took)));
}

TEST_F(FaultTest, TheRadioIsOutBeyondTheLease) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  network_->lose(100, instrument_and_vehicles());
  const auto stopped = all_stop();
  ASSERT_TRUE(stopped) << flight_->said_by_all();
  EXPECT_GT(*stopped, kLease_s);
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); });
  wait(2.0);
  EXPECT_TRUE(flight_->all_ready()) << "stopped by silence, it waits for a person";
  expect_done(ask(CommandKind::kEngage));
  ASSERT_NO_FATAL_FAILURE(fly());
  ASSERT_TRUE(took);
  expect_unmoved(
      measure("radio out beyond the lease",
              text("all at rest %.1f s after; all hear it again after %.1f s, and fly when engaged", *stopped, *took)));
}

TEST_F(FaultTest, EverythingIsOut) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(kRate_rad_s, kFlyOn)));
  network_->lose(100, instrument());
  wait(5.0);
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return nobody_alone(); });
  wait(4.0);
  ASSERT_TRUE(took);
  const Row& row = measure("everything out for 5 s at 0.1 rad/s, the way to the vehicles too",
                           text("all hear the coordinator again %.1f s after", *took));
  // Vehicles that hear nothing stop by themselves, all alike; called from where they stopped, they catch up along their
  // paths, all alike as well.
  EXPECT_LT(row.load.displacement_max_m, kSwing_m);
  expect_continuous(row);
}

// -------------------------------------------------------------------------------------------------------- the clocks

const std::map<std::string, ClockFault> kWrongClocks{{"coordinator", {12345.0, 50.0}}, {"simulator", {-3600.0, -100.0}},
                                                     {"agent 1", {0.5, 100.0}},        {"agent 2", {-0.5, -100.0}},
                                                     {"agent 3", {36000.0, 100.0}},    {"agent 4", {-7200.0, -100.0}}};

TEST_F(FaultTest, EveryClockIsWrong) {
  ASSERT_NO_FATAL_FAILURE(fly(mission(), kWrongClocks));
  wait(6.0);
  land();
  expect_unmoved(measure("clocks off by 0.5 s to 10 h, drifts to 100 ppm", ""));
}

TEST_F(FaultTest, EveryClockIsWrongAndTheRadioIsOut) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_with(kFlyOn), kWrongClocks));
  wait(2.0);
  network_->lose(100, instrument_and_vehicles());
  wait(5.0);
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return nobody_alone(); });
  wait(2.0);
  ASSERT_TRUE(took);
  expect_unmoved(measure("the same clocks, and the radio out for 5 s",
                         text("all hear the coordinator again %.1f s after", *took)));
}

// --------------------------------------------------------------------------------------------------- the coordinator

TEST_F(FaultTest, TheCoordinatorIsKilledAndBackWithinTheLease) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  const std::uint64_t term = flight_->term();
  flight_->kill("coordinator");
  wait(2.0);
  const auto took = take_over_and_land(term);
  ASSERT_TRUE(took);
  expect_still(measure("coordinator killed in motion, started again after 2 s",
                       text("followed by all %.1f s after its start, and nothing happened", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsDeadBeyondTheLease) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  flight_->kill("coordinator");
  const auto stopped = all_stop();
  ASSERT_TRUE(stopped) << flight_->said_by_all();
  wait(2.0);
  EXPECT_TRUE(flight_->all_at_rest());
  // Whoever starts it again, and however: what stopped by itself stays until a person engages.
  flight_->start_process("coordinator", {"--engage"});
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); });
  ASSERT_TRUE(took) << flight_->said_by_all();
  wait(3.0);
  EXPECT_TRUE(flight_->all_ready()) << flight_->said_by_all();
  EXPECT_EQ(flight_->beacon()->course.wish.by, Wisher::kSilence);
  expect_done(ask(CommandKind::kEngage));
  ASSERT_NO_FATAL_FAILURE(fly());
  expect_still(measure("coordinator dead beyond the lease",
                       text("all at rest %.1f s after; the next one leads %.1f s after its start, and nobody moves "
                            "before a person engages",
                            *stopped, *took)));
}

TEST_F(FaultTest, TheCoordinatorIsDeadAndAllFlyOn) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_with(kFlyOn)));
  const std::uint64_t term = flight_->term();
  flight_->kill("coordinator");
  wait(kLease_s + kStopping_s + 2.0);
  EXPECT_TRUE(flight_->every_agent(
      [](const AgentStatus& s) { return s.state == AgentState::kAlone && !s.course.rests(s.swarm_time); }));
  const auto took = take_over_and_land(term);
  ASSERT_TRUE(took);
  expect_still(
      measure("coordinator dead for 9 s, policy fly on", text("followed by all %.1f s after its start", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsKilledWhileThePaceChanges) {
  ASSERT_NO_FATAL_FAILURE(start(mission()));
  const auto half_way = [&] {
    const auto beacon = flight_->beacon();
    return beacon && beacon->course.moment(beacon->swarm_time).pace > 0.5;
  };
  ASSERT_TRUE(FaultFlight::seconds_until(kStart_s, half_way)) << flight_->said_by_all();
  const std::uint64_t term = flight_->term();
  flight_->kill("coordinator");
  wait(0.3);
  const auto took = take_over_and_land(term);
  ASSERT_TRUE(took);
  expect_still(measure("coordinator killed half-way to full pace",
                       text("followed by all %.1f s after its start; full pace was reached", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsKilledWhileItProposes) {
  ASSERT_NO_FATAL_FAILURE(start(mission(), {}, false));
  ASSERT_TRUE(FaultFlight::seconds_until(kStart_s, [&] { return flight_->all_ready(); })) << flight_->said_by_all();
  wait(1.0);                              // what somebody complained of is settled by a word of its own
  flight_->send(agent_name(3), SIGSTOP);  // does not confirm, and is not silent yet
  flight_->observer().command(CommandKind::kEngage);
  const auto proposed = [&] { return flight_->beacon()->proposal.has_value(); };
  const bool seen = FaultFlight::seconds_until(1.0, proposed).has_value();
  flight_->kill("coordinator");
  flight_->send(agent_name(3), SIGCONT);
  ASSERT_TRUE(seen) << flight_->said_by_all();
  wait(2.0);
  EXPECT_TRUE(flight_->all_at_rest());
  flight_->start_process("coordinator", {"--engage"});
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(took) << flight_->said_by_all();
  wait(2.0);
  expect_still(measure("coordinator killed between proposal and go",
                       text("nobody moved; flying %.1f s after its start", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsEndedByTheSystem) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  const std::uint64_t term = flight_->term();
  flight_->send("coordinator", SIGTERM);
  const auto ended = [&] { return flight_->said("coordinator").find("the agents fly on") != std::string::npos; };
  ASSERT_TRUE(FaultFlight::seconds_until(kRecovery_s, ended)) << flight_->said("coordinator");
  wait(1.0);
  EXPECT_TRUE(flight_->every_agent([](const AgentStatus& s) { return s.state == AgentState::kAlone; }));
  const auto took = take_over_and_land(term);
  ASSERT_TRUE(took);
  expect_unmoved(measure("coordinator ended by SIGTERM in motion, started again after 1 s",
                         text("followed by all %.1f s after its start", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsStopped) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  flight_->send("coordinator", SIGSTOP);
  wait(2.0);
  flight_->send("coordinator", SIGCONT);
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return nobody_alone(); });
  wait(3.0);
  land();
  ASSERT_TRUE(took);
  expect_unmoved(measure("coordinator stopped for 2 s", text("all hear it again %.1f s after", *took)));
}

// -------------------------------------------------------------------------------------------------------- the person

TEST_F(FaultTest, APersonStopsAndStartsAtAnyMoment) {
  ASSERT_NO_FATAL_FAILURE(start(mission()));
  const auto moving = [&] {
    const auto beacon = flight_->beacon();
    return beacon && beacon->course.moment(beacon->swarm_time).pace > 0.3;
  };
  ASSERT_TRUE(FaultFlight::seconds_until(kStart_s, moving)) << flight_->said_by_all();
  expect_done(ask(CommandKind::kFreeze));  // on the way to full pace
  wait(0.3);
  expect_done(ask(CommandKind::kEngage));  // and while it stops
  ASSERT_NO_FATAL_FAILURE(fly());
  expect_done(ask(CommandKind::kFreeze));
  ASSERT_TRUE(FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); })) << flight_->said_by_all();
  expect_done(ask(CommandKind::kEngage));
  wait(1.0);
  expect_done(ask(CommandKind::kPace, 0.4));
  wait(3.0);
  EXPECT_TRUE(flight_->every_agent([](const AgentStatus& s) { return s.course.moment(s.swarm_time).pace == 0.4; }));
  expect_done(ask(CommandKind::kEngage));
  ASSERT_NO_FATAL_FAILURE(fly());
  for (int i = 0; i < 4; ++i) {
    expect_done(ask(CommandKind::kFreeze));
    wait(0.17 * (i + 1));
    expect_done(ask(CommandKind::kEngage));
    wait(0.23 * (i + 1));
  }
  ASSERT_NO_FATAL_FAILURE(fly());
  expect_still(measure("frozen, slowed and engaged thirteen times, at any moment", ""));
}

}  // namespace
}  // namespace gyre::test
