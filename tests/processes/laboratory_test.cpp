// A flight that is hurt on purpose, by what its processes do to themselves when they are asked: no root, no firewall.

#include <algorithm>

#include "common/dds/clock.hpp"
#include "tests/places.hpp"
#include "tests/processes/fault_fixture.hpp"

namespace gyre::test {
namespace {

using protocol::Disturbance;
using protocol::DisturbanceKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

const auto* const kTable = testing::AddGlobalTestEnvironment(new LossTable);

constexpr const char* kFoundAnew = "swarm time was found anew";

class LaboratoryTest : public FaultTest {
 protected:
  void fly_in_laboratory(const std::string& mission) {
    FaultFlight::Options options{mission, directory(), program_directory(), {}};
    options.laboratory = true;
    auto started = FaultFlight::start(options);
    ASSERT_TRUE(started) << started.error().text;
    flight_ = std::move(started).value();
    ASSERT_NO_FATAL_FAILURE(fly());
    const int processes = static_cast<int>(flight_->carriers().size()) + 2;
    const auto met = FaultFlight::seconds_until(kStart_s, [&] { return flight_->observer().disturbed() == processes; });
    ASSERT_TRUE(met) << "every process listens";
  }

  void lose(const std::string& process, double share, Duration duration = {}) {
    Disturbance d;
    d.process = process;
    d.kind = DisturbanceKind::kLosePackets;
    d.share = share;
    d.duration = duration;
    flight_->observer().disturb(d);
  }
  void shift(const std::string& process, Duration by) {
    Disturbance d;
    d.process = process;
    d.kind = DisturbanceKind::kShiftClock;
    d.shift = by;
    flight_->observer().disturb(d);
  }
  void push(const Eigen::Vector3d& force_w_n, Duration duration) {
    Disturbance d;
    d.process = "simulator";
    d.kind = DisturbanceKind::kPushLoad;
    d.force_w_n = force_w_n;
    d.duration = duration;
    flight_->observer().disturb(d);
  }

  /// How long it took until it was said; it has to be within the limit.
  std::optional<double> said_within(double limit_s, const std::string& process, const std::string& words) {
    const auto took =
        FaultFlight::seconds_until(limit_s, [&] { return flight_->said(process).find(words) != std::string::npos; });
    EXPECT_TRUE(took) << process << " does not say \"" << words << "\"\n" << flight_->said_by_all();
    return took;
  }
  [[nodiscard]] std::uint64_t missed(CarrierId carrier) const {
    return flight_->observer().ask(
        [&](const FlightRecord& record) { return record.carriers.at(carrier).statuses.back().message.beacons_missed; });
  }
  /// Away from where the mission has it, since then.
  [[nodiscard]] double moved_m(LocalTime since) const {
    return flight_->observer().ask([&](const FlightRecord& record) {
      return load_figures(record, flight_->mission().plan.load, since).displacement_max_m;
    });
  }
};

TEST_F(LaboratoryTest, AThirdOfAnAgentsPacketsIsLost) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  const std::uint64_t before = missed(3);
  lose(agent_name(3), 0.3);
  said_within(2.0, agent_name(3), "laboratory: 30 % of the packets are lost from now on");
  wait(6.0);
  const std::uint64_t lost = missed(3) - before;
  EXPECT_GT(lost, 40U) << "of 300";
  EXPECT_LT(lost, 150U) << "it is heard, too";
  lose(agent_name(3), 0.0);
  said_within(2.0, agent_name(3), "laboratory: 0 % of the packets");
  wait(0.5);
  const std::uint64_t healed = missed(3);
  wait(1.0);
  EXPECT_LT(missed(3), healed + 10) << "it is over";
  const Row& row = measure("laboratory: 30 % of one agent's packets", text("%d of 300 beacons missed", int(lost)));
  expect_unmoved(row);
}

TEST_F(LaboratoryTest, AThirdOfEverybodysPacketsIsLost) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  lose("coordinator", 0.3);
  for (const CarrierId id : flight_->carriers()) lose(agent_name(id), 0.3);
  for (const CarrierId id : flight_->carriers()) said_within(2.0, agent_name(id), "laboratory: 30 %");
  wait(6.0);
  std::uint64_t most = 0;
  for (const CarrierId id : flight_->carriers()) most = std::max(most, missed(id));
  EXPECT_GT(most, 80U) << "what both sides lose is half of all";
  const Row& row = measure("laboratory: 30 % of the coordinator's and each agent's packets",
                           text("up to %d of 300 beacons missed", int(most)));
  expect_unmoved(row);
}

TEST_F(LaboratoryTest, AnAgentsRadioIsOutForAWhileAndHealsByItself) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  lose(agent_name(3), 1.0, seconds(3));
  said_within(2.0, "coordinator", "agent 3 is silent");
  said_within(5.0, agent_name(3), "laboratory: no packet is lost on purpose any more");
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  expect_unmoved(measure("laboratory: every packet of an agent lost for 3 s",
                         text("it hears the coordinator again %.1f s after", *back)));
}

TEST_F(LaboratoryTest, AnAgentsClockLeaps) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  shift(agent_name(3), seconds(5));
  said_within(2.0, agent_name(3), "laboratory: this process's clock leaps by 5 s");
  const auto found = said_within(4.0, agent_name(3), kFoundAnew);
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(5.0);
  EXPECT_TRUE(flight_->all_flying());
  const Row& row = measure("laboratory: an agent's clock leaps by 5 s",
                           text("swarm time found anew after %.1f s", found.value_or(-1)));
  EXPECT_LT(row.load.displacement_max_m, kSwing_m);
  expect_continuous(row);
}

// By less than a beacon may be late, so that by beacons alone it is not seen.
TEST_F(LaboratoryTest, AnAgentsClockLeapsALittle) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  for (const int leap_ms : {5, 50, 300}) {
    shift(agent_name(3), milliseconds(leap_ms));
    wait(2.0);
  }
  EXPECT_TRUE(flight_->all_flying());
  EXPECT_NE(flight_->said(agent_name(3)).find("this clock leapt by "), std::string::npos);
  const Row& row = measure("laboratory: an agent's clock leaps by 5, 50 and 300 ms", "");
  EXPECT_LT(row.load.displacement_max_m, 2e-3);
  expect_continuous(row);
}

TEST_F(LaboratoryTest, AnAgentsClockStandsStill) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  shift(agent_name(3), -seconds(2));
  said_within(2.0, agent_name(3), "laboratory: this process's clock stands still for 2 s");
  const auto found = said_within(6.0, agent_name(3), kFoundAnew);
  const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
  ASSERT_TRUE(back) << flight_->said_by_all();
  wait(5.0);
  EXPECT_TRUE(flight_->all_flying());
  const Row& row = measure("laboratory: an agent's clock stands still for 2 s",
                           text("swarm time found anew after %.1f s", found.value_or(-1)));
  EXPECT_LT(row.load.displacement_max_m, kSwing_m);
  expect_continuous(row);
}

TEST_F(LaboratoryTest, TheCoordinatorsClockIsShiftedWithinTheLease) {
  for (const Duration by : {Duration(seconds(2)), Duration(-seconds(2))}) {
    ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
    shift("coordinator", by);
    said_within(2.0, "coordinator", "laboratory: this process's clock");
    wait(6.0);
    const auto back = FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_flying(); });
    ASSERT_TRUE(back) << flight_->said_by_all();
    const Row& row = measure(text("laboratory: the coordinator's clock is shifted by %+.0f s", gyre::seconds(by)), "");
    expect_unmoved(row);  // by the freshest word of its agents, swarm time is what it was to a tenth of a millisecond
    flight_.reset();
  }
}

// By its clock nobody has said a word for so long: that is what a lease is for.
TEST_F(LaboratoryTest, TheCoordinatorsClockLeapsBeyondTheLease) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission_with(kStop)));
  shift("coordinator", seconds(8));
  said_within(2.0, "coordinator", "laboratory: this process's clock leaps by 8 s");
  const auto stopped = all_stop();
  ASSERT_TRUE(stopped) << flight_->said_by_all();
  ASSERT_TRUE(FaultFlight::seconds_until(kRecovery_s, [&] { return flight_->all_ready(); })) << flight_->said_by_all();
  wait(1.0);
  expect_done(ask(protocol::CommandKind::kEngage));
  ASSERT_NO_FATAL_FAILURE(fly());
  const Row& row = measure("laboratory: the coordinator's clock leaps by 8 s",
                           text("all at rest %.1f s after; engaged, they fly", *stopped));
  expect_unmoved(row);
}

TEST_F(LaboratoryTest, TheLoadIsPushed) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  const mechanics::Plan& plan = flight_->mission().plan;
  const double weight_n = plan.load.mass_kg * plan.gravity_m_s2;
  const LocalTime before = dds::now();
  EXPECT_LT(moved_m(LocalTime::min()), kStill_m);
  push({0.1 * weight_n, 0.0, 0.0}, milliseconds(200));
  said_within(2.0, "simulator", "laboratory: the load is pushed by (0.2943, 0, 0) N for 0.2 s");
  wait(8.0);
  const double most_m = moved_m(before);
  EXPECT_GT(most_m, 1e-3);
  EXPECT_LT(most_m, 0.1);
  const double at_the_end_m = moved_m(dds::now() - seconds(1));
  EXPECT_LE(at_the_end_m, most_m);
  EXPECT_TRUE(flight_->all_flying());
  expect_continuous(measure("laboratory: the load is pushed by a tenth of its weight for 0.2 s",
                            text("8 s after it swings by %.2f mm", 1e3 * at_the_end_m)));
}

TEST_F(LaboratoryTest, NonsenseIsDroppedCountedAndExplained) {
  ASSERT_NO_FATAL_FAILURE(fly_in_laboratory(mission()));
  push({1e3, 0.0, 0.0}, milliseconds(200));
  lose(agent_name(3), 1.0);
  lose("agent 101", 0.3);
  said_within(2.0, "simulator", "a push of 1000 N");
  said_within(2.0, agent_name(3), "give a duration");
  said_within(2.0, "coordinator", "names no process");
  const auto nonsense = [&](const std::string& process) {
    return flight_->observer().ask([&](const FlightRecord& record) {
      std::uint64_t most = 0;
      for (const auto& health : record.healths) {
        if (health.message.process == process) most = health.message.dropped.nonsense;
      }
      return most;
    });
  };
  EXPECT_TRUE(FaultFlight::seconds_until(
      5.0, [&] { return nonsense("simulator") >= 2 && nonsense(agent_name(3)) >= 2 && nonsense("coordinator") >= 1; }));
  wait(1.0);
  expect_unmoved(measure("laboratory: nonsense", ""));
}

TEST_F(LaboratoryTest, NobodyListensOutsideIt) {
  ASSERT_NO_FATAL_FAILURE(fly(mission()));
  lose("coordinator", 0.9);
  for (const CarrierId id : flight_->carriers()) shift(agent_name(id), seconds(5));
  wait(2.0);
  EXPECT_EQ(flight_->observer().disturbed(), 0);
  EXPECT_EQ(flight_->said_by_all().find("laboratory"), std::string::npos);
  EXPECT_TRUE(flight_->all_flying());
}

}  // namespace
}  // namespace gyre::test
