// Agents really killed and stopped: named in time, and the mission's policy followed.

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
  /// Displacement over the last second.
  [[nodiscard]] double moved_at_the_end_m() const {
    return flight_->observer().ask([&](const FlightRecord& record) {
      return load_figures(record, flight_->mission().plan.load, dds::now() - std::chrono::seconds(1))
          .displacement_max_m;
    });
  }
};

TEST_F(AgentFaultTest, AnAgentIsKilledAndTheSwarmFreezes) {
  for (const double rate : {kRate_rad_s, 1.0}) {
    ASSERT_NO_FATAL_FAILURE(fly(mission_at(rate, "FREEZE")));
    const auto named = kill_agent(3);
    ASSERT_TRUE(named) << flight_->said_by_all();
    EXPECT_LT(*named, 0.5);
    const auto frozen = FaultFlight::seconds_until(kRecovery_s, [&] {
      return flight_->said("coordinator").find("the load is held by the frozen plan") != std::string::npos;
    });
    ASSERT_TRUE(frozen) << flight_->said_by_all();
    flight_->start_process(agent_name(3));
    const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); });
    ASSERT_TRUE(back) << flight_->said_by_all();
    wait(3.0);
    const Row& row = measure(
        text("agent killed at %.1f rad/s, policy freeze", rate),
        text("named after %.2f s, frozen %.1f s later; restarted, it follows after %.1f s, with a step of %.2f mm; "
             "the load then swings by %.2f mm",
             *named, *frozen, *back, return_step_mm(), 1e3 * moved_at_the_end_m()));
    if (rate == kRate_rad_s) {
      EXPECT_LT(row.load.displacement_max_m, kSwing_m);
    }
    expect_continuous(row);
    flight_.reset();
  }
}

TEST_F(AgentFaultTest, AnAgentIsKilledAndTheSwarmFliesOn) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(kRate_rad_s, "CONTINUE")));
  const auto named = kill_agent(3);
  ASSERT_TRUE(named) << flight_->said_by_all();
  EXPECT_LT(*named, 0.5);
  wait(2.0);
  flight_->start_process(agent_name(3));
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(4.0);
  const Row& row = measure("agent killed at 0.1 rad/s, policy continue, started again 2 s after it was named",
                           text("named after %.2f s; flies %.1f s after its start, with a step of %.2f mm; the load "
                                "then swings by %.2f mm",
                                *named, *back, return_step_mm(), 1e3 * moved_at_the_end_m()));
  EXPECT_LT(row.load.displacement_max_m, kSwing_m);
  expect_continuous(row);
}

TEST_F(AgentFaultTest, AnAgentIsStopped) {
  ASSERT_NO_FATAL_FAILURE(fly(mission_at(kRate_rad_s, "CONTINUE")));
  flight_->send(agent_name(3), SIGSTOP);
  wait(2.0);
  flight_->send(agent_name(3), SIGCONT);
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(4.0);
  const Row& row = measure("agent stopped for 2 s at 0.1 rad/s, policy continue",
                           text("goes on with a step of %.2f mm; the load then swings by %.2f mm", return_step_mm(),
                                1e3 * moved_at_the_end_m()));
  EXPECT_LT(row.load.displacement_max_m, kSwing_m);
  expect_continuous(row);
}

}  // namespace
}  // namespace gyre::test
