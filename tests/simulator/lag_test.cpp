// What lags of winches and vehicles cost at the load, unknown, made up for, and made up for wrongly: six multirotors.

#include <gtest/gtest.h>

#include <cstdio>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/lag.hpp"
#include "common/mission/mission.hpp"
#include "simulator/core/simulator.hpp"
#include "tests/places.hpp"
#include "tests/simulator/agents.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

using rigs::Agents;
using std::chrono::milliseconds;

mechanics::Plan hex(double winch_lag_s, double vehicle_lag_s = 0.0) {
  mechanics::Plan plan =
      mission::read_mission_file(test::source_directory() + "/deploy/missions/hex-multirotor.textproto").value().plan;
  plan.winch.time_constant_s = winch_lag_s;
  for (mechanics::Carrier& carrier : plan.carriers) carrier.vehicle.time_constant_s = vehicle_lag_s;
  return plan;
}

/// How far its load moves while agents that know of the lags of `known` fly the machines of `flown`.
double moved_mm(const mechanics::Plan& known, const mechanics::Plan& flown, double lag_error = 0.0,
                Duration for_so_long = std::chrono::seconds(30)) {
  const Agents agents(known, 10.0);
  SimulationSettings settings;
  settings.lag_error = lag_error;
  Simulator simulator = Simulator::create(flown, settings, LocalTime{}).value();
  double furthest_m = 0.0;
  for (Duration t{}; t < for_so_long; t += milliseconds(10)) {
    for (std::size_t i = 0; i < agents.count(); ++i) {
      EXPECT_FALSE(simulator.step(LocalTime(t), agents.setpoint(i, t)).dropped);
    }
    (void)simulator.step(LocalTime(t + milliseconds(10)), Advance{});
    furthest_m = std::max(furthest_m, (simulator.load().position_w_m - flown.load.position_w_m).norm());
  }
  return 1e3 * furthest_m;
}

struct Lag {
  double winch_s;
  double unknown_mm;  ///< docs/design.md, fact 9
};

TEST(Lag, OfWinchesThatNobodyMakesUpForMovesTheLoadByMillimetres) {
  for (const Lag& lag : {Lag{0.02, 6.6}, Lag{0.05, 16.0}, Lag{0.1, 33.0}}) {
    const double unknown_mm = moved_mm(hex(0.0), hex(lag.winch_s));
    const double known_mm = moved_mm(hex(lag.winch_s), hex(lag.winch_s));
    const double wrong_mm = moved_mm(hex(lag.winch_s), hex(lag.winch_s), 0.2);
    std::printf("  winches that lag by %3.0f ms: %.2f mm; made up for %.4f mm; by a fifth too little %.2f mm\n",
                1e3 * lag.winch_s, unknown_mm, known_mm, wrong_mm);
    EXPECT_NEAR(unknown_mm, lag.unknown_mm, 0.1 * lag.unknown_mm);
    EXPECT_LT(known_mm, 0.05);
    EXPECT_NEAR(wrong_mm, 0.2 * unknown_mm, 0.1 * unknown_mm);
  }
}

TEST(Lag, TheCertificateSaysWhatAFifthOfItWrongCosts) {
  const auto compare = [](const mechanics::Plan& plan, Duration for_so_long) {
    const double said_mm = 1e3 * mechanics::certify(plan).lag_error_displacement_m.value();
    const double simulated_mm = moved_mm(plan, plan, mechanics::kLagError, for_so_long);
    std::printf("  lags a fifth wrong: %.3f mm by the certificate, %.3f mm simulated\n", said_mm, simulated_mm);
    return simulated_mm / said_mm;
  };
  mechanics::Plan slow = rigs::paper();
  for (const auto& [winch_s, vehicle_s] : {std::pair(0.1, 0.0), std::pair(0.0, 0.1)}) {
    slow.winch.time_constant_s = winch_s;
    for (mechanics::Carrier& carrier : slow.carriers) carrier.vehicle.time_constant_s = vehicle_s;
    EXPECT_NEAR(compare(slow, std::chrono::seconds(100)), 1.0, 0.06) << "slow next to the load's own modes";
    // Of six multirotors the load's mass adds a fifth, at half the frequency of its softest mode.
    EXPECT_NEAR(compare(hex(winch_s, vehicle_s), std::chrono::seconds(30)), 1.18, 0.05);
  }
  EXPECT_EQ(mechanics::certify(hex(0.0)).lag_error_displacement_m, 0.0);
}

TEST(Lag, OfVehiclesIsMadeUpForAsWell) {
  EXPECT_GT(moved_mm(hex(0.0), hex(0.0, 0.1)), 5.0);
  EXPECT_LT(moved_mm(hex(0.0, 0.1), hex(0.0, 0.1)), 0.05);
}

TEST(Lag, ThatWinchAndVehicleShareIsNearlyHarmless) {
  EXPECT_LT(moved_mm(hex(0.0), hex(0.1, 0.1)), 0.2 * moved_mm(hex(0.0), hex(0.1)));
}

}  // namespace
}  // namespace gyre::simulator
