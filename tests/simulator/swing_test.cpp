// A second opinion on swings: the nonlinear load on its elastic cables, pushed by a millimetre, swings on or dies out
// as Floquet's multipliers of its linear motion have it.

#include "common/mechanics/swing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "common/mission/mission.hpp"
#include "tests/places.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

mechanics::Plan mission(const std::string& path) {
  const auto read = mission::read_mission_file(test::source_directory() + "/" + path + ".textproto");
  if (!read) ADD_FAILURE() << read.error().text;
  return read.value().plan;
}

LoadIntegrator flight(const mechanics::Plan& plan, const LoadMotion& start) {
  return {LoadDynamics(rigid_load(plan)), start, 0.0, rigs::planned(plan, rigs::Stretch::kCompensated)};
}

/// How far apart two motions of one load are, its radius of gyration taken for the arm of its turns [m].
double apart_m(const mechanics::Plan& plan, const LoadMotion& a, const LoadMotion& b) {
  const double arm_m = std::sqrt(plan.load.inertia_b_kg_m2.trace() / plan.load.mass_kg);
  return std::hypot((a.position_w_m - b.position_w_m).norm(),
                    arm_m * a.orientation_w_b.angularDistance(b.orientation_w_b));
}

/// Of the greatest distance in the windows that begin at `early_s` and at `late_s` [1/s]: of a load that was pushed
/// from one that was not, so that what both do, because cables give, is no swing.
double growth_seen(const mechanics::Plan& plan, double early_s, double late_s, double window_s) {
  LoadMotion still{plan.load.position_w_m, Eigen::Vector3d::Zero(), plan.load.orientation_w_b, Eigen::Vector3d::Zero()};
  LoadMotion pushed = still;
  pushed.position_w_m += Eigen::Vector3d(0.8e-3, 0.6e-3, 0.0);
  pushed.orientation_w_b = pushed.orientation_w_b * Eigen::AngleAxisd(1e-3, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0);
  LoadIntegrator quiet = flight(plan, still);
  LoadIntegrator swinging = flight(plan, pushed);
  double early_m = 0.0;
  double late_m = 0.0;
  for (double t_s = 0.1; t_s <= late_s + window_s; t_s += 0.1) {
    for (LoadIntegrator* one : {&quiet, &swinging}) {
      const auto failure = one->advance_to(t_s);
      EXPECT_FALSE(failure) << failure->text;
    }
    const double now_m = apart_m(plan, quiet.motion(), swinging.motion());
    if (t_s >= early_s && t_s < early_s + window_s) early_m = std::max(early_m, now_m);
    if (t_s >= late_s) late_m = std::max(late_m, now_m);
  }
  return std::log(late_m / early_m) / (late_s - early_s);
}

double growth(const mechanics::Plan& plan) {
  return mechanics::swing_growth(plan, mechanics::slices(plan), mechanics::period_s(plan), {1.0, 1.0, 4096});
}

TEST(Swing, DiesOutInThePapersMotionAsItsMultipliersHaveIt) {
  const mechanics::Plan plan = rigs::paper();
  const double period_s = mechanics::period_s(plan);
  const double seen = growth_seen(plan, period_s, 3.0 * period_s, 0.5 * period_s);
  std::printf("  paper: simulated %.4f, multipliers %.4f 1/s\n", seen, growth(plan));
  EXPECT_NEAR(seen, growth(plan), 0.15 * std::abs(growth(plan)));
}

TEST(Swing, GrowsInTheBraidedTrioAtOtherRatesAsItsMultipliersHaveIt) {
  for (const double pace : {0.76, 1.27}) {
    mechanics::Plan plan = mission("tests/data/missions/fixed-wing-braid");
    plan.cycle.rate_rad_s *= pace;
    const double period_s = mechanics::period_s(plan);
    const double seen = growth_seen(plan, 4.0 * period_s, 10.0 * period_s, 2.0 * period_s);
    std::printf("  trio at %.2f of its rate: simulated %.4f, multipliers %.4f 1/s\n", pace, seen, growth(plan));
    EXPECT_GT(growth(plan), 0.03);
    EXPECT_NEAR(seen, growth(plan), 0.15 * growth(plan));
  }
}

TEST(Swing, GoesOnInTheBraidedTrioAtItsOwnRate) {
  const mechanics::Plan plan = mission("tests/data/missions/fixed-wing-braid");
  EXPECT_NEAR(growth_seen(plan, 0.0, 300.0, 60.0), growth(plan), 2e-3);
}

}  // namespace
}  // namespace gyre::simulator
