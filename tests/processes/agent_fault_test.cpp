// Agents really killed and stopped: named in time, and the mission's policy followed; and their links cut
// for good.

#include <algorithm>

#include "common/dds/clock.hpp"
#include "tests/processes/fault_fixture.hpp"

namespace gyre::test {
namespace {

class AgentFaultTest : public FaultTest {
 protected:
  /// How long the coordinator took to name it.
  std::optional<double> kill_agent(CarrierId carrier) {
    flight_->kill(agent_name(carrier));
    return FaultFlight::seconds_until(5.0, [&] {
      return flight_->said("coordinator").find(agent_name(carrier) + " is silent") != std::string::npos;
    });
  }
  /// Of the agent that was away: from where its carrier had gone by then to its first setpoint.
  [[nodiscard]] double return_step_mm() const {
    return 1e3 * flight_->observer().ask([](const FlightRecord& record) {
      return setpoint_figures(record).return_step_max_m.value_or(0.0);
    });
  }
  /// Its radio; the way to its vehicle is on board.
  void cut_off(CarrierId carrier) {
    network_->cut(udp_ports(flight_->pid(agent_name(carrier))), instrument_and_vehicles());
  }
  /// How far apart the ends of the leases are by which the agents stopped.
  [[nodiscard]] double spread_of_leases_s() const {
    return flight_->observer().ask([](const FlightRecord& record) {
      SwarmTime first = SwarmTime::max();
      SwarmTime last = SwarmTime::min();
      for (const auto& [id, carrier] : record.carriers) {
        const auto& statuses = carrier.statuses;
        const auto moved = std::find_if(statuses.rbegin(), statuses.rend(), [](const auto& s) {
          return s.message.course.lease && !s.message.course.rests(s.message.swarm_time);
        });
        if (moved == statuses.rend()) continue;
        first = std::min(first, *moved->message.course.lease);
        last = std::max(last, *moved->message.course.lease);
      }
      return seconds(last - first);
    });
  }
  /// Displacement over the last second.
  [[nodiscard]] double moved_at_the_end_m() const {
    return flight_->observer().ask([&](const FlightRecord& record) {
      return load_figures(record, flight_->mission().plan.load, dds::now() - std::chrono::seconds(1))
          .displacement_max_m;
    });
  }
};

TEST_F(AgentFaultTest, AnAgentIsKilledAndAllStopTogether) {
  for (const double rate : {kRate_rad_s, 1.0}) {
    ASSERT_NO_FATAL_FAILURE(fly(mission_at(rate, kStop)));
    const auto named = kill_agent(3);
    ASSERT_TRUE(named) << flight_->said_by_all();
    EXPECT_LT(*named, 0.5);
    const auto stopped = FaultFlight::seconds_until(kRecovery_s, [&] {
      const auto beacon = flight_->beacon();
      return beacon->course.rests(beacon->swarm_time) && beacon->course.wish.by == protocol::Wisher::kSilence;
    });
    ASSERT_TRUE(stopped) << flight_->said_by_all();
    flight_->start_process(agent_name(3));
    const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); });
    ASSERT_TRUE(back) << flight_->said_by_all();
    wait(3.0);
    EXPECT_TRUE(flight_->all_ready()) << "nobody goes on before a person engages";
    Row& row = measure(text("agent killed at %.1f rad/s, policy stop", rate),
                       text("named after %.2f s, all at rest %.1f s later; restarted, it follows after %.1f s, with a "
                            "step of %.2f mm; the load then swings by %.2f mm",
                            *named, *stopped, *back, return_step_mm(), 1e3 * moved_at_the_end_m()));
    expect_continuous(row);
    EXPECT_LT(row.load.displacement_max_m, 1e-3) << "its vehicle goes on, and stops with the others";
    flight_.reset();
  }
}

TEST_F(AgentFaultTest, AnAgentIsKilledAndItsVehicleHoldsAndAllStopWithIt) {
  for (const double rate : {kRate_rad_s, 1.0}) {
    ASSERT_NO_FATAL_FAILURE(fly(mission_at(rate, kStop, 3)));
    wait(1.0);
    flight_->kill(agent_name(3));
    const auto stuck = FaultFlight::seconds_until(
        kRecovery_s, [&] { return flight_->beacon()->course.wish.by == protocol::Wisher::kEvidence; });
    ASSERT_TRUE(stuck) << flight_->said_by_all();
    EXPECT_LT(*stuck, 0.5) << "it is seen, before its agent is silent for long";
    EXPECT_NE(flight_->said("coordinator").find("carrier 3 has left its path"), std::string::npos);
    const auto stopped = FaultFlight::seconds_until(kRecovery_s, [&] {
      const auto beacon = flight_->beacon();
      return beacon->course.rests(beacon->swarm_time);
    });
    ASSERT_TRUE(stopped) << flight_->said_by_all();
    wait(2.0);
    const Row& row = measure(text("agent killed at %.1f rad/s, its vehicle holds its place", rate),
                             text("seen after %.2f s, all at rest %.1f s later; in the end %.2f mm away", *stuck,
                                  *stopped, 1e3 * moved_at_the_end_m()));
    EXPECT_LT(row.load.displacement_max_m, rate < 0.5 ? 0.010 : 0.110);
    flight_.reset();
  }
}

TEST_F(AgentFaultTest, AnAgentIsKilledAndBackWithinTheLease) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(kRate_rad_s, kStop)));
  const auto named = kill_agent(3);
  ASSERT_TRUE(named) << flight_->said_by_all();
  wait(1.5);
  flight_->start_process(agent_name(3));
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(kLease_s + 1.0);
  EXPECT_TRUE(flight_->all_flying()) << "the lease runs again\n" << flight_->said_by_all();
  expect_continuous(
      measure("agent killed at 0.1 rad/s, policy stop, started again 1.5 s after it was named",
              text("flies %.1f s after its start, with a step of %.2f mm; the load then swings by %.2f mm", *back,
                   return_step_mm(), 1e3 * moved_at_the_end_m())));
}

TEST_F(AgentFaultTest, AnAgentIsKilledAndTheSwarmFliesOn) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(kRate_rad_s, kFlyOn)));
  const auto named = kill_agent(3);
  ASSERT_TRUE(named) << flight_->said_by_all();
  EXPECT_LT(*named, 0.5);
  wait(2.0);
  flight_->start_process(agent_name(3));
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(4.0);
  expect_continuous(measure("agent killed at 0.1 rad/s, policy fly on, started again 2 s after it was named",
                            text("named after %.2f s; flies %.1f s after its start, with a step of %.2f mm; the load "
                                 "then swings by %.2f mm",
                                 *named, *back, return_step_mm(), 1e3 * moved_at_the_end_m())));
}

TEST_F(AgentFaultTest, AnAgentIsStopped) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(kRate_rad_s, kFlyOn)));
  flight_->send(agent_name(3), SIGSTOP);
  wait(2.0);
  flight_->send(agent_name(3), SIGCONT);
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(4.0);
  expect_continuous(measure("agent stopped for 2 s at 0.1 rad/s, policy fly on",
                            text("goes on with a step of %.2f mm; the load then swings by %.2f mm", return_step_mm(),
                                 1e3 * moved_at_the_end_m())));
}

// What waited for the simulator is of an agent that is no more, and of a time that is over.
TEST_F(AgentFaultTest, TheSimulatorHangsWhileAnAgentIsStartedAnew) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(1.0, kFlyOn)));
  flight_->send("simulator", SIGSTOP);
  flight_->kill(agent_name(3));
  flight_->start_process(agent_name(3));
  wait(1.2);
  flight_->send("simulator", SIGCONT);
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(4.0);
  const Row& row = measure("simulator hung for 1.2 s at 1 rad/s, an agent started anew meanwhile",
                           text("all fly %.1f s after it goes on", *back));
  EXPECT_LT(row.load.displacement_max_m, 1e-3) << flight_->said_by_all();
}

// ---------------------------------------------------------------------------------------------------------- its link

TEST_F(AgentFaultTest, AnAgentsLinkIsCutAndAllStopTogether) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_with(kStop)));
  cut_off(3);
  const auto stopped = all_stop();
  ASSERT_TRUE(stopped) << flight_->said_by_all();
  wait(2.0);
  EXPECT_TRUE(flight_->all_at_rest());
  EXPECT_GT(network_->lost(), 100U);
  EXPECT_EQ(flight_->beacon()->course.wish.by, protocol::Wisher::kSilence);
  const Row before =
      measure("an agent's link cut for good, policy stop",
              text("all at rest %.1f s after, the one that hears nobody, too; stops began within %.2f ms", *stopped,
                   1e3 * spread_of_leases_s()));
  expect_still(before);
  EXPECT_FALSE(ask(protocol::CommandKind::kEngage)->done) << "not without everybody";
  network_->heal();
  ASSERT_TRUE(FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); })) << flight_->said_by_all();
  expect_done(ask(protocol::CommandKind::kEngage));
  ASSERT_NO_FATAL_FAILURE(fly());
  expect_still(measure("and heard again, engaged", ""));
}

TEST_F(AgentFaultTest, NothingReachesACarrierForThreeSeconds) {
  for (const double rate : {kRate_rad_s, 1.0}) {
    ASSERT_NO_FATAL_FAILURE(fly(mission_at(rate, kStop)));
    network_->cut(udp_ports(flight_->pid(agent_name(3))), instrument());
    wait(3.0);
    EXPECT_GT(network_->lost(), 100U);
    EXPECT_NE(flight_->said("coordinator").find("agent 3 is silent"), std::string::npos);
    network_->heal();
    const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
    ASSERT_TRUE(back) << flight_->said_by_all();
    wait(kLease_s);
    EXPECT_TRUE(flight_->all_flying()) << "what was in doubt was only the lease";
    const Row& row = measure(text("every packet of an agent lost for 3 s at %.1f rad/s, on board, too", rate),
                             text("it hears the coordinator again %.1f s after", *back));
    expect_unmoved(row);
    flight_.reset();
  }
}

TEST_F(AgentFaultTest, AnAgentsLinkIsCutAndAllFlyOn) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_with(kFlyOn)));
  cut_off(3);
  wait(kLease_s + kStopping_s + 3.0);
  EXPECT_TRUE(flight_->every_agent([](const protocol::AgentStatus& s) { return !s.course.rests(s.swarm_time); }));
  EXPECT_FALSE(ask(protocol::CommandKind::kRelease)->done) << "who cannot be told to stop flies on";
  network_->heal();
  ASSERT_TRUE(FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); })) << flight_->said_by_all();
  wait(1.0);
  expect_still(measure("an agent's link cut for 10 s, policy fly on", "all fly on"));
}

TEST_F(AgentFaultTest, AStopIsAskedForWhileAnAgentsLinkIsCut) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_with(kStop)));
  cut_off(3);
  wait(1.0);
  expect_done(ask(protocol::CommandKind::kFreeze));
  const auto stopped = all_stop();
  ASSERT_TRUE(stopped) << flight_->said_by_all();
  wait(1.0);
  network_->heal();
  ASSERT_TRUE(FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); })) << flight_->said_by_all();
  EXPECT_EQ(flight_->beacon()->course.wish.by, protocol::Wisher::kPerson);
  expect_still(measure("freeze asked for while an agent's link is cut", text("all at rest %.1f s after", *stopped)));
}

}  // namespace
}  // namespace gyre::test
