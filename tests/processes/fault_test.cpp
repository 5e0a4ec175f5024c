// The loss table with real programs: packets really dropped, clocks really wrong, processes really killed; and a load
// that is measured all along. At the end the table, as the README has it.

#include <gtest/gtest.h>

#include <unistd.h>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "tests/processes/fault_flight.hpp"
#include "tests/processes/flight_figures.hpp"
#include "tests/processes/launched.hpp"
#include "tests/processes/private_network.hpp"

namespace gyre::test {
namespace {

using protocol::AgentState;
using protocol::AgentStatus;
using protocol::Stage;

constexpr double kStart_s = 40.0;  // a bound, not a measure
constexpr double kRecovery_s = 20.0;

/// What has to hold while messages are lost, clocks are wrong, or the coordinator is gone.
constexpr double kUnmoved_m = 1e-3;
constexpr double kUnturned_deg = 0.1;
constexpr double kNoPositionStep_m = 2e-5;
constexpr double kNoVelocityStep_m_s = 2e-3;
/// What is left of the load's swing when everybody does again what he should: nothing damps it but the cables.
constexpr double kSwing_m = 0.03;

struct Row {
  std::string event;
  LoadFigures load;
  SetpointFigures setpoints;
  std::string remark;
};

class LossTable : public testing::Environment {
 public:
  static std::vector<Row>& rows() {
    static std::vector<Row> rows;
    return rows;
  }
  void TearDown() override {
    if (rows().empty()) return;
    std::printf(
        "\n| event | load moved, mm | load turned, deg | setpoint step, um | in velocity, mm/s | what happened |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const Row& row : rows()) {
      std::printf("| %s | %.3f | %.4f | %.2f | %.3f | %s |\n", row.event.c_str(), 1e3 * row.load.displacement_max_m,
                  row.load.rotation_max_deg, 1e6 * row.setpoints.position_step_max_m,
                  1e3 * row.setpoints.velocity_step_max_m_s, row.remark.c_str());
    }
    std::printf("\n");
  }
};

const auto* const kTable = testing::AddGlobalTestEnvironment(new LossTable);

void wait(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

class FaultTest : public ProgramsTest {
 protected:
  void SetUp() override {
    // This program starts no thread before its first flight.
    static Result<PrivateNetwork> entered = PrivateNetwork::enter();
    if (!entered) GTEST_SKIP() << entered.error().text;
    network_.emplace(entered.value());
    network_->heal();
  }
  void TearDown() override {
    flight_.reset();
    ProgramsTest::TearDown();
  }

  static std::string mission() { return std::string(GYRE_SOURCE_DIR) + "/tests/processes/missions/faults.textproto"; }
  /// The same mission at another rate, and with another policy.
  [[nodiscard]] std::string mission_at(double rate_rad_s, const std::string& agent_loss) const {
    std::ostringstream text;
    text << std::ifstream(mission()).rdbuf() << "agent_loss: " << agent_loss << "\n";
    std::string words = text.str();
    const std::string before = "rate_rad_s: 1";
    words.replace(words.find(before), before.size(), "rate_rad_s: " + std::to_string(rate_rad_s));
    std::string path = directory() + "/variant.textproto";
    std::ofstream(path) << words;
    return path;
  }

  void start(const std::string& mission, const std::map<std::string, ClockFault>& clocks = {}, bool engage = true) {
    auto started = FaultFlight::start({mission, directory(), GYRE_BIN_DIR, clocks, engage});
    ASSERT_TRUE(started) << started.error().text;
    flight_ = std::move(started).value();
  }
  void fly() {
    const auto took = FaultFlight::seconds_until(kStart_s, [&] { return flight_->all_flying(); });
    ASSERT_TRUE(took) << "the motion did not begin\n" << flight_->said_by_all();
  }
  void fly(const std::string& mission, const std::map<std::string, ClockFault>& clocks = {}) {
    ASSERT_NO_FATAL_FAILURE(start(mission, clocks));
    ASSERT_NO_FATAL_FAILURE(fly());
  }
  /// The coordinator is asked to end the flight: back to rest, and good-bye.
  void land() {
    flight_->send("coordinator", SIGTERM);
    const auto took = FaultFlight::seconds_until(kRecovery_s, [&] {
      return flight_->said("coordinator").find("the flight has ended at rest") != std::string::npos;
    });
    EXPECT_TRUE(took) << flight_->said("coordinator");
  }

  /// This program hears everything, whatever is lost: the instrument is not part of the experiment.
  static std::vector<std::uint16_t> instrument() { return udp_ports(::getpid()); }
  /// The way from an agent to its vehicle is on board: the radio may be out, it is not.
  [[nodiscard]] std::vector<std::uint16_t> instrument_and_vehicles() const {
    std::vector<std::uint16_t> ports = instrument();
    for (const std::uint16_t port : udp_ports(flight_->pid("simulator"))) ports.push_back(port);
    return ports;
  }

  Row& measure(const std::string& event, const std::string& remark) {
    const auto figures = [&](const FlightRecord& record) {
      return Row{event, load_figures(record, flight_->mission().plan.load), setpoint_figures(record), remark};
    };
    LossTable::rows().push_back(flight_->observer().ask(figures));
    return LossTable::rows().back();
  }
  /// The load does not notice, and no setpoint steps.
  void expect_unmoved(const Row& row) {
    EXPECT_LT(row.load.displacement_max_m, kUnmoved_m);
    EXPECT_LT(row.load.rotation_max_deg, kUnturned_deg);
    expect_continuous(row);
  }
  void expect_continuous(const Row& row) {
    EXPECT_LT(row.setpoints.position_step_max_m, kNoPositionStep_m);
    EXPECT_LT(row.setpoints.velocity_step_max_m_s, kNoVelocityStep_m_s);
    EXPECT_EQ(row.setpoints.backwards, 0);
    if (HasFailure()) std::printf("%s\n", flight_->said_by_all().c_str());
  }

  [[nodiscard]] std::string lost_packets() const { return std::to_string(network_->lost()) + " packets"; }

  [[nodiscard]] bool nobody_alone() const {
    return flight_->every_agent([](const AgentStatus& s) { return s.state != AgentState::kAlone; });
  }
  [[nodiscard]] bool all_follow_a_term_above(std::uint64_t term) const {
    return flight_->every_agent([&](const AgentStatus& s) { return s.term > term; });
  }

  std::optional<PrivateNetwork> network_;
  std::unique_ptr<FaultFlight> flight_;
};

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
  flight_->observer().command(protocol::CommandKind::kEngage);
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

TEST_F(FaultTest, TheRadioIsOut) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  network_->lose(100, instrument_and_vehicles());
  wait(5.0);
  EXPECT_TRUE(flight_->every_agent([](const AgentStatus& s) { return s.state == AgentState::kAlone; }));
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return nobody_alone(); });
  wait(2.0);
  ASSERT_TRUE(took);
  expect_unmoved(measure("radio out for 5 s", text("all hear the coordinator again %.1f s after", *took)));
}

TEST_F(FaultTest, EverythingIsOut) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  network_->lose(100, instrument());
  wait(5.0);
  network_->heal();
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return nobody_alone(); });
  wait(4.0);
  ASSERT_TRUE(took);
  expect_continuous(measure("everything out for 5 s, the way to the vehicles too",
                            text("all hear the coordinator again %.1f s after", *took)));
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
  ASSERT_NO_FATAL_FAILURE(fly(mission(), kWrongClocks));
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

TEST_F(FaultTest, TheCoordinatorIsKilledInMotion) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  const std::uint64_t term = flight_->term();
  flight_->kill("coordinator");
  wait(2.0);
  flight_->start_process("coordinator");
  const auto took =
      FaultFlight::seconds_until(kRecovery_s, [&] { return all_follow_a_term_above(term) && flight_->all_flying(); });
  wait(2.0);
  land();
  ASSERT_TRUE(took) << flight_->said_by_all();
  expect_unmoved(measure("coordinator killed in motion, started again after 2 s",
                         text("followed by all %.1f s after its start", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsKilledInATransition) {
  ASSERT_NO_FATAL_FAILURE(start(mission()));
  const auto half_way = [&] {
    const auto t = flight_->transition();
    return t && t->stage == Stage::kGo && flight_->observer().ask([&](const FlightRecord& record) {
      return record.beacons.back().message.swarm_time > t->start + t->duration / 2;
    });
  };
  ASSERT_TRUE(FaultFlight::seconds_until(kStart_s, half_way)) << flight_->said_by_all();
  const std::uint64_t term = flight_->term();
  flight_->kill("coordinator");
  wait(0.3);
  flight_->start_process("coordinator");
  const auto took =
      FaultFlight::seconds_until(kRecovery_s, [&] { return all_follow_a_term_above(term) && flight_->all_flying(); });
  wait(2.0);
  land();
  ASSERT_TRUE(took) << flight_->said_by_all();
  expect_unmoved(measure("coordinator killed half-way through a transition",
                         text("followed by all %.1f s after its start; the transition was completed", *took)));
}

TEST_F(FaultTest, TheCoordinatorIsKilledWhileItProposes) {
  ASSERT_NO_FATAL_FAILURE(start(mission()));
  const auto proposed = [&] {
    const auto t = flight_->transition();
    return t && t->stage == Stage::kProposed;
  };
  ASSERT_TRUE(FaultFlight::seconds_until(kStart_s, proposed)) << flight_->said_by_all();
  flight_->kill("coordinator");
  wait(2.0);
  EXPECT_TRUE(flight_->every_agent([](const AgentStatus& s) { return s.state == AgentState::kAlone; }));
  flight_->start_process("coordinator", {"--engage"});
  const auto took = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(took) << flight_->said_by_all();
  wait(2.0);
  expect_unmoved(measure("coordinator killed between proposal and go",
                         text("nobody moved; flying %.1f s after its start", *took)));
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

// -------------------------------------------------------------------------------------------------------- the agents

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

/// A carrier without an agent coasts for 3 s. How far the others have gone by then is what the load feels, so the rate
/// is that of a real flight.
constexpr double kRate_rad_s = 0.1;
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
