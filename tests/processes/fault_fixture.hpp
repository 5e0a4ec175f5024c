#pragma once
// What every fault flight needs: a network of its own, a flight in it, and a row of the loss table at the end.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "common/base/text.hpp"
#include "tests/places.hpp"
#include "tests/processes/fault_flight.hpp"
#include "tests/processes/flight_figures.hpp"
#include "tests/processes/launched.hpp"
#include "tests/processes/private_network.hpp"

namespace gyre::test {

inline constexpr double kStart_s = 40.0;  // a bound, not a measure
inline constexpr double kRecovery_s = 20.0;

/// What has to hold while messages are lost, clocks are wrong, or the coordinator is gone.
inline constexpr double kUnmoved_m = 1e-3;
inline constexpr double kUnturned_deg = 0.1;
inline constexpr double kNoPositionStep_m = 2e-5;
inline constexpr double kNoVelocityStep_m_s = 2e-3;
/// Where nobody's clock is wrong: 0.1 mm on a machine that has time. A millisecond by which clocks disagree is 0.19 mm
/// at 1 rad/s, and on a busy machine they may, for a moment, after a coordinator took over.
inline constexpr double kStill_m = 3e-4;
/// What is left of the load's swing when everybody does again what he should: nothing damps it but the cables.
inline constexpr double kSwing_m = 0.03;

/// What the swarm does when somebody falls silent.
inline constexpr const char* kStop = "silence { stop_after_s: 5 }";
inline constexpr const char* kFlyOn = "silence { fly_on {} }";
inline constexpr double kLease_s = 5.0;
inline constexpr double kStopping_s = 2.0;  // at the end of a lease

/// Of flights where a vehicle may have to go on without anybody: a real load's rate.
inline constexpr double kRate_rad_s = 0.1;

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

inline void wait(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

class FaultTest : public ProgramsTest {
 protected:
  void SetUp() override {
    // Before its first flight this program has no thread that uses a network.
    static Result<PrivateNetwork> entered = PrivateNetwork::enter();
    if (!entered) GTEST_SKIP() << entered.error().text;
    network_.emplace(entered.value());
    network_->heal();
  }
  void TearDown() override {
    flight_.reset();
    ProgramsTest::TearDown();
  }

  static std::string mission() { return source_directory() + "/tests/processes/missions/faults.textproto"; }
  /// The same mission at another rate, and with another policy.
  [[nodiscard]] std::string mission_at(double rate_rad_s, const std::string& silence) const {
    std::ostringstream text;
    text << std::ifstream(mission()).rdbuf() << silence << "\n";
    std::string words = text.str();
    const std::string before = "rate_rad_s: 1";
    words.replace(words.find(before), before.size(), "rate_rad_s: " + std::to_string(rate_rad_s));
    std::string path = directory() + "/variant.textproto";
    std::ofstream(path) << words;
    return path;
  }
  /// One whose carrier's vehicle brakes on the spot when nobody tells it anything.
  [[nodiscard]] std::string mission_at(double rate_rad_s, const std::string& silence, CarrierId holding) const {
    const std::string path = mission_at(rate_rad_s, silence);
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    std::string words = text.str();
    const std::string before = "carrier { id: " + std::to_string(holding) + " ";
    words.replace(words.find(before), before.size(), before + "vehicle { on_silence: HOLD } ");
    std::ofstream(path) << words;
    return path;
  }
  /// As it is, but for its policy.
  [[nodiscard]] std::string mission_with(const std::string& silence) const { return mission_at(1.0, silence); }

  void start(const std::string& mission, const std::map<std::string, ClockFault>& clocks = {}, bool engage = true) {
    auto started = FaultFlight::start({mission, directory(), program_directory(), clocks, engage});
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
    flight_->send("coordinator", SIGINT);
    const auto took = FaultFlight::seconds_until(kRecovery_s, [&] {
      return flight_->said("coordinator").find("at rest; the flight has ended") != std::string::npos;
    });
    EXPECT_TRUE(took) << flight_->said("coordinator");
  }

  /// Starts the coordinator again and lands; seconds until all flew under it, if they did.
  std::optional<double> take_over_and_land(std::uint64_t former_term) {
    flight_->start_process("coordinator");
    const auto took = FaultFlight::seconds_until(
        kRecovery_s, [&] { return all_follow_a_term_above(former_term) && flight_->all_flying(); });
    wait(2.0);
    land();
    EXPECT_TRUE(took) << flight_->said_by_all();
    return took;
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
  /// The load does not move at all.
  void expect_still(const Row& row) {
    EXPECT_LT(row.load.displacement_max_m, kStill_m);
    expect_unmoved(row);
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
    return flight_->every_agent([](const protocol::AgentStatus& s) { return s.state != protocol::AgentState::kAlone; });
  }
  [[nodiscard]] bool all_follow_a_term_above(std::uint64_t term) const {
    return flight_->every_agent([&](const protocol::AgentStatus& s) { return s.term > term; });
  }

  /// Every agent stops at the end of the lease, and nobody goes on; how long after now.
  std::optional<double> all_stop() {
    return FaultFlight::seconds_until(kLease_s + kStopping_s + 2.0, [&] { return flight_->all_at_rest(); });
  }
  /// A person's word, and the answer.
  std::optional<protocol::CommandReply> ask(protocol::CommandKind kind, double pace = 1.0) {
    const std::uint64_t command = flight_->observer().command(kind, pace);
    std::optional<protocol::CommandReply> reply;
    (void)FaultFlight::seconds_until(kRecovery_s, [&] { return (reply = flight_->reply(command)).has_value(); });
    return reply;
  }
  void expect_done(const std::optional<protocol::CommandReply>& reply) {
    ASSERT_TRUE(reply) << "nobody answered\n" << flight_->said_by_all();
    EXPECT_TRUE(reply->done) << reply->text;
  }

  std::optional<PrivateNetwork> network_;
  std::unique_ptr<FaultFlight> flight_;
};

}  // namespace gyre::test
