// The twin as a machine: what it does with setpoints, good and bad, with time, and with stalls.

#include "simulator/core/simulator.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "common/base/random_stream.hpp"
#include "tests/simulator/agents.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

using rigs::Agents;
using std::chrono::milliseconds;

constexpr LocalTime kStart(std::chrono::hours(5));

Simulator make(const SimulationSettings& settings = {}, const mechanics::Plan& plan = rigs::paper()) {
  auto made = Simulator::create(plan, settings, kStart);
  EXPECT_TRUE(made.ok()) << made.error().text;
  return std::move(made).value();
}

double displacement_m(const Simulator& simulator) {
  return (simulator.load().position_w_m - rigs::paper().load.position_w_m).norm();
}

TEST(Simulator, ComplainsOfCarriersThatNobodyLeadsAndOfTimeThatIsBehind) {
  const Agents agents(rigs::paper());
  Simulator simulator = make();
  const auto complaint = [&](Duration at) { return simulator.complaint(kStart + at).value_or("none"); };
  const auto lead = [&](std::size_t count, Duration at) {
    for (std::size_t i = 0; i < count; ++i) (void)simulator.step(kStart + at, agents.setpoint(i, at));
  };
  const auto advance_to = [&](Duration at) {
    while (simulator.simulated() < at) (void)simulator.step(kStart + at, Advance{});
  };
  EXPECT_EQ(complaint(milliseconds(0)), "no setpoints for carriers 1, 2, 3 and 4");
  lead(3, milliseconds(0));
  EXPECT_EQ(complaint(milliseconds(0)), "no setpoints for carrier 4");
  lead(4, milliseconds(10));
  EXPECT_EQ(complaint(milliseconds(10)), "none");
  lead(4, milliseconds(500));
  EXPECT_EQ(complaint(milliseconds(500)), "0.50 s behind real time");
  advance_to(milliseconds(500));
  EXPECT_EQ(complaint(milliseconds(500)), "none");
  advance_to(milliseconds(1510));
  EXPECT_EQ(complaint(milliseconds(1510)), "no setpoints for carriers 1, 2, 3 and 4");
}

TEST(Simulator, RestsUntilTheFirstSetpointAndPublishesAtItsRate) {
  Simulator simulator = make();
  int load_states = 0;
  LocalTime before{};
  for (int i = 0; i <= 1000; ++i) {
    const Outputs out = simulator.step(kStart + milliseconds(i), Advance{});
    EXPECT_FALSE(out.lag || out.dropped || out.failure);
    if (!out.load) continue;
    ++load_states;
    EXPECT_GT(out.load->stamp, before);
    before = out.load->stamp;
    ASSERT_EQ(out.carriers.size(), 4U);
    for (const protocol::CarrierState& carrier : out.carriers) {
      EXPECT_EQ(carrier.velocity_w_m_s.norm(), 0.0);
      EXPECT_GT(carrier.tension_n, 0.5);
      EXPECT_NEAR(carrier.tension_n, 1e4 * (carrier.cable_length_m - carrier.winch_length_m), 1e-4);
    }
  }
  EXPECT_EQ(load_states, 100);
  EXPECT_LT(displacement_m(simulator), 1e-9);
}

TEST(Simulator, BeginsWhereThePlanDoes) {
  const Agents agents(rigs::paper());
  Simulator simulator = make();
  Outputs out;
  for (int i = 0; i <= 20 && !out.load; ++i) out = simulator.step(kStart + milliseconds(i), Advance{});
  ASSERT_EQ(out.carriers.size(), agents.count());
  for (std::size_t i = 0; i < agents.count(); ++i) {
    const protocol::Setpoint first = agents.setpoint(i, {});
    EXPECT_LT((out.carriers[i].position_w_m - first.position_w_m).norm(), 1e-12);
    EXPECT_NEAR(out.carriers[i].winch_length_m, first.winch_length_m, 1e-12);
  }
}

TEST(Simulator, FliesThePaperWithTheLoadHangingStill) {
  mechanics::Plan lagging = rigs::paper();
  lagging.winch = {0.05, 0.3, 1.0};
  for (mechanics::Carrier& carrier : lagging.carriers) carrier.vehicle.time_constant_s = 0.1;
  for (const mechanics::Plan& plan : {rigs::paper(), lagging}) {
    const Agents agents(plan);
    Simulator simulator = make({}, plan);
    double furthest_m = 0.0;
    double fastest_m_s = 0.0;
    for (Duration t{}; t < std::chrono::seconds(60); t += milliseconds(10)) {
      for (std::size_t i = 0; i < agents.count(); ++i) {
        EXPECT_FALSE(simulator.step(kStart + t, agents.setpoint(i, t)).dropped);
      }
      const Outputs out = simulator.step(kStart + t + milliseconds(10), Advance{});
      EXPECT_FALSE(out.failure);
      furthest_m = std::max(furthest_m, displacement_m(simulator));
      for (const auto& carrier : out.carriers) fastest_m_s = std::max(fastest_m_s, carrier.velocity_w_m_s.norm());
    }
    EXPECT_LT(furthest_m, 1e-4);
    EXPECT_GT(fastest_m_s, 0.05) << "the carriers have to have flown";
  }
}

/// How far the load goes in a flight whose setpoints arrive up to `lateness` late, and in which the first carrier's
/// clock is ahead of the swarm's by `skew`.
double furthest_m(Duration lateness, Duration skew) {
  const Agents agents(rigs::paper());
  RandomStream random(3, "lateness");
  Simulator simulator = make();
  double furthest = 0.0;
  for (Duration t{}; t < std::chrono::seconds(40); t += milliseconds(10)) {
    std::multimap<LocalTime, protocol::Setpoint> arrivals;
    for (std::size_t i = 0; i < agents.count(); ++i) {
      const Duration late = from_seconds(random.uniform() * seconds(lateness));
      arrivals.emplace(kStart + t + late, agents.setpoint(i, i == 0 ? t + skew : t));
    }
    for (const auto& [arrived, setpoint] : arrivals) {
      EXPECT_FALSE(simulator.step(arrived, setpoint).dropped);
    }
    static_cast<void>(simulator.step(kStart + t + milliseconds(10), Advance{}));
    furthest = std::max(furthest, displacement_m(simulator));
  }
  return furthest;
}

TEST(Simulator, LateSetpointsMoveNothingBecauseTheyAreStamped) {
  // Taken to hold at their arrival they would move it by 0.19 mm.
  EXPECT_LT(furthest_m(milliseconds(9), {}), 5e-5);
}

TEST(Simulator, ACarrierWhoseClockIsWrongMovesTheLoadAllTheSame) {
  const double late_m = furthest_m(milliseconds(9), {});
  EXPECT_GT(furthest_m(milliseconds(9), milliseconds(100)), 20.0 * late_m);
}

TEST(Simulator, HowOftenItIsCalledChangesNothing) {
  const Agents agents(rigs::paper());
  const auto fly = [&agents](Duration step) {
    Simulator simulator = make();
    for (Duration t{}; t < std::chrono::seconds(5); t += milliseconds(20)) {
      for (std::size_t i = 0; i < agents.count(); ++i) {
        static_cast<void>(simulator.step(kStart + t, agents.setpoint(i, t)));
      }
      for (Duration now = t + step; now <= t + milliseconds(20); now += step) {
        static_cast<void>(simulator.step(kStart + now, Advance{}));
      }
    }
    return simulator.load();
  };
  const LoadMotion fine = fly(milliseconds(1));
  const LoadMotion coarse = fly(milliseconds(20));
  EXPECT_EQ(fine.position_w_m, coarse.position_w_m);
  EXPECT_EQ(fine.velocity_w_m_s, coarse.velocity_w_m_s);
}

TEST(Simulator, NonsenseIsDroppedCountedAndReported) {
  const Agents agents(rigs::paper());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<protocol::Setpoint> nonsense(11, agents.setpoint(0, Duration{}));
  nonsense[0].carrier = 77;
  nonsense[1].position_w_m.x() = nan;
  nonsense[2].velocity_w_m_s.y() = infinity;
  nonsense[3].acceleration_w_m_s2.z() = -infinity;
  nonsense[4].winch_length_m = nan;
  nonsense[5].winch_rate_m_s = nan;
  nonsense[6].position_w_m.x() = 1e6;
  nonsense[7].winch_length_m = -0.1;
  nonsense[8].velocity_w_m_s.x() = 1e4;
  nonsense[9].acceleration_w_m_s2.x() = 1e9;
  nonsense[10].winch_acceleration_m_s2 = nan;

  Simulator simulator = make();
  int reports = 0;
  for (std::size_t i = 0; i < nonsense.size(); ++i) {
    const Outputs out = simulator.step(kStart + milliseconds(i), nonsense[i]);
    if (out.dropped) {
      ++reports;
      EXPECT_FALSE(out.dropped->latest.empty());
    }
  }
  EXPECT_EQ(reports, 1) << "the first at once, the rest within the second together";
  const Outputs later = simulator.step(kStart + milliseconds(1100), Advance{});
  ASSERT_TRUE(later.dropped);
  EXPECT_EQ(later.dropped->counts.nonsense, nonsense.size());
  EXPECT_LT(displacement_m(simulator), 1e-9) << "none of it was flown";
}

TEST(Simulator, OldAndRepeatedSetpointsAreDroppedButANewSwarmIsHeard) {
  const Agents agents(rigs::paper());
  Simulator simulator = make();
  const auto send = [&](Duration at, Duration swarm_time) {
    static_cast<void>(simulator.step(kStart + at, agents.setpoint(0, swarm_time)));
  };
  send(milliseconds(0), milliseconds(100));
  send(milliseconds(10), milliseconds(100));
  send(milliseconds(20), milliseconds(90));
  send(milliseconds(30), milliseconds(110));
  Outputs out;
  for (int ms = 100; ms <= 1100; ms += 100) out = simulator.step(kStart + milliseconds(ms), Advance{});
  ASSERT_TRUE(out.dropped);
  EXPECT_EQ(out.dropped->counts.duplicate, 1U);
  EXPECT_EQ(out.dropped->counts.late, 1U);
  EXPECT_EQ(out.dropped->counts.nonsense, 0U);
  send(milliseconds(1200), milliseconds(5));
  EXPECT_FALSE(simulator.step(kStart + milliseconds(2200), Advance{}).dropped);
}

TEST(Simulator, AfterAStallTheMotionIsMadeUpForAndThePublicationsAreNot) {
  Simulator simulator = make();
  static_cast<void>(simulator.step(kStart + milliseconds(10), Advance{}));
  LocalTime now = kStart + std::chrono::seconds(5);
  int publications = 0;
  int lag_reports = 0;
  int calls = 0;
  while (simulator.simulated() < now - kStart) {
    ASSERT_LT(++calls, 1000);
    const Outputs out = simulator.step(now, Advance{});
    publications += out.load ? 1 : 0;
    if (out.lag) {
      ++lag_reports;
      EXPECT_GT(out.lag->behind, milliseconds(4900));
      EXPECT_EQ(out.lag->skipped, Duration{});
    }
  }
  EXPECT_EQ(lag_reports, 1);
  EXPECT_LE(publications, 2);
  EXPECT_GE(publications, 1);
}

TEST(Simulator, AStallLongerThanItCanMakeUpForIsSkippedAndSaid) {
  Simulator simulator = make();
  const LocalTime now = kStart + std::chrono::minutes(10);
  const Outputs out = simulator.step(now, Advance{});
  ASSERT_TRUE(out.lag);
  EXPECT_EQ(out.lag->skipped, std::chrono::minutes(10) - kLongestCatchUp);
  int calls = 0;
  while (simulator.next_due() <= now && ++calls < 1000) static_cast<void>(simulator.step(now, Advance{}));
  EXPECT_LT(calls, 1000);
  EXPECT_EQ(simulator.simulated(), kLongestCatchUp);
}

TEST(Simulator, OneThatIsAlwaysTooSlowStillPublishesAndSaysSoOncePerSecond) {
  Simulator simulator = make();
  // Each call gets half of what it would need.
  int lag_reports = 0;
  int publications = 0;
  const Duration need = kTicksPerAdvance * SimulationSettings{}.tick;
  for (Duration t{}; t < std::chrono::seconds(20); t += 2 * need) {
    const Outputs out = simulator.step(kStart + t, Advance{});
    lag_reports += out.lag ? 1 : 0;
    publications += out.load ? 1 : 0;
  }
  EXPECT_GE(lag_reports, 15);
  EXPECT_LE(lag_reports, 20);
  EXPECT_GT(publications, 40);
}

TEST(Simulator, CarriersComeToRestWhenTheAgentsFallSilent) {
  const Agents agents(rigs::paper(), 2.0);
  Simulator simulator = make();
  Duration t{};
  for (; t < std::chrono::seconds(5); t += milliseconds(10)) {
    for (std::size_t i = 0; i < agents.count(); ++i) {
      static_cast<void>(simulator.step(kStart + t, agents.setpoint(i, t)));
    }
    static_cast<void>(simulator.step(kStart + t + milliseconds(10), Advance{}));
  }
  Outputs out;
  for (const Duration end = t + std::chrono::seconds(4); t < end; t += milliseconds(10)) {
    out = simulator.step(kStart + t + milliseconds(10), Advance{});
  }
  ASSERT_EQ(out.carriers.size(), 4U);
  for (const protocol::CarrierState& carrier : out.carriers) {
    EXPECT_LT(carrier.velocity_w_m_s.norm(), 1e-12);
    EXPECT_NEAR(carrier.winch_rate_m_s, 0.0, 1e-12);
    EXPECT_GT(carrier.tension_n, 0.0) << "the load is still carried";
  }
}

TEST(Simulator, AVehicleThatHoldsStandsWhileTheOthersGoOnAlongTheirPaths) {
  const Agents agents(rigs::paper(), 2.0);
  SimulationSettings settings;
  settings.holds = {2};
  Simulator simulator = make(settings);
  Duration t{};
  std::vector<protocol::CarrierState> states;
  const auto advance = [&] {
    t += milliseconds(10);
    const std::vector<protocol::CarrierState> before = std::move(states);
    states = simulator.step(kStart + t, Advance{}).carriers;
    for (std::size_t i = 0; i < before.size(); ++i) {
      // 0.1 m/s braked within 0.2 s: 1 m/s2.
      EXPECT_LT((states[i].position_w_m - before[i].position_w_m).norm(), 0.003) << i << " at " << seconds(t);
      EXPECT_LT((states[i].velocity_w_m_s - before[i].velocity_w_m_s).norm(), 0.02) << i << " at " << seconds(t);
    }
  };
  const auto lead = [&] {
    for (std::size_t i = 0; i < agents.count(); ++i) (void)simulator.step(kStart + t, agents.setpoint(i, t));
    advance();
  };
  const auto astray_m = [&](std::size_t i) {
    return (states[i].position_w_m - agents.setpoint(i, t).position_w_m).norm();
  };
  for (std::size_t i = 0; i < agents.count(); ++i) {
    (void)simulator.step(kStart, agents.status(i));
    (void)simulator.step(kStart, agents.held(i));
  }
  while (t < std::chrono::seconds(5)) lead();
  EXPECT_GT(states[1].velocity_w_m_s.norm(), 0.01) << "it has to have something to brake";

  // The last setpoint held 10 ms ago.
  while (t < milliseconds(5250)) advance();
  const Eigen::Vector3d stands_w_m = states[1].position_w_m;
  EXPECT_LT(states[1].velocity_w_m_s.norm(), 1e-12);
  EXPECT_NEAR(states[1].winch_rate_m_s, 0.0, 1e-12);
  while (t < std::chrono::seconds(9)) advance();
  EXPECT_EQ(states[1].position_w_m, stands_w_m);
  EXPECT_GT(astray_m(1), 0.03);
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_LT(astray_m(i), 1e-6) << i;

  while (t < std::chrono::seconds(13)) lead();
  EXPECT_LT(astray_m(1), 1e-6) << "it has caught up";
}

TEST(Simulator, SurvivesTeleportingCarriers) {
  const Agents agents(rigs::paper());
  Simulator simulator = make();
  for (int i = 0; i < 300; ++i) {
    const Duration t = milliseconds(10 * i);
    for (std::size_t c = 0; c < agents.count(); ++c) {
      protocol::Setpoint s = agents.setpoint(c, t);
      s.position_w_m.z() += (i / 50) % 2 == 0 ? 0.0 : 2.0;
      static_cast<void>(simulator.step(kStart + t, s));
    }
    static_cast<void>(simulator.step(kStart + t + milliseconds(10), Advance{}));
    ASSERT_TRUE(simulator.load().position_w_m.allFinite());
  }
  EXPECT_EQ(simulator.simulated(), std::chrono::seconds(3));
}

TEST(Simulator, RefusesWhatCannotHangAtRest) {
  mechanics::Plan soft = rigs::paper();
  soft.cable.stiffness_n_m = 0.5;
  const auto too_soft = Simulator::create(soft, {}, kStart);
  ASSERT_FALSE(too_soft.ok());
  EXPECT_NE(too_soft.error().text.find("carrier 1"), std::string::npos) << too_soft.error().text;

  mechanics::Plan unset = rigs::paper();
  unset.cable.stiffness_n_m = 0.0;
  EXPECT_FALSE(Simulator::create(unset, {}, kStart).ok());

  SimulationSettings settings;
  settings.tick = Duration{};
  EXPECT_FALSE(Simulator::create(rigs::paper(), settings, kStart).ok());
}

TEST(Simulator, TheSameSeedGivesTheSameFlight) {
  const auto fly = [](std::uint64_t seed) {
    SimulationSettings settings;
    settings.wind.gust_deviation_n = 0.1;
    settings.seed = seed;
    Simulator simulator = make(settings);
    for (int i = 1; i <= 200; ++i) static_cast<void>(simulator.step(kStart + milliseconds(10 * i), Advance{}));
    return simulator.load().position_w_m;
  };
  const Eigen::Vector3d once = fly(5);
  EXPECT_EQ(once, fly(5));
  EXPECT_NE(once, fly(6));
  EXPECT_GT((once - rigs::paper().load.position_w_m).norm(), 1e-6);
}

}  // namespace
}  // namespace gyre::simulator
