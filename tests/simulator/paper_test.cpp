// The paper's own example on a real load: does the equilibrium hold when the load has mass and the cables give?

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdio>

#include "common/base/angle.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/stiffness.hpp"
#include "common/mechanics/transition.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

struct Deviation {
  double displacement_m = 0.0;
  double rotation_deg = 0.0;
};

/// The furthest the load gets from where the plan holds it.
Deviation furthest(const mechanics::Plan& plan, const SurroundingsAt& surroundings, double until_s) {
  const LoadMotion start{plan.load.position_w_m, Eigen::Vector3d::Zero(), plan.load.orientation_w_b,
                         Eigen::Vector3d::Zero()};
  LoadIntegrator flight(LoadDynamics(rigid_load(plan)), start, 0.0, surroundings);
  Deviation out;
  for (double t_s = 0.05; t_s <= until_s; t_s += 0.05) {
    const auto failure = flight.advance_to(t_s);
    EXPECT_FALSE(failure) << failure->text;
    const LoadMotion& m = flight.motion();
    out.displacement_m = std::max(out.displacement_m, (m.position_w_m - plan.load.position_w_m).norm());
    out.rotation_deg =
        std::max(out.rotation_deg, degrees(m.orientation_w_b.angularDistance(plan.load.orientation_w_b)));
  }
  return out;
}

TEST(Paper, LoadHangsStillWhenStretchIsCompensated) {
  const mechanics::Plan plan = rigs::paper();
  const Deviation level = furthest(plan, rigs::planned(plan, rigs::Stretch::kCompensated), mechanics::period_s(plan));
  std::printf("  paper, stretch compensated: %.5f mm, %.6f deg\n", 1e3 * level.displacement_m, level.rotation_deg);
  EXPECT_LT(level.displacement_m, 1e-4);
  EXPECT_LT(level.rotation_deg, 0.01);
}

TEST(Paper, LoadSagsByHalfAMillimetreWhenStretchIsIgnored) {
  const mechanics::Plan plan = rigs::paper();
  const Deviation level = furthest(plan, rigs::planned(plan, rigs::Stretch::kIgnored), mechanics::period_s(plan));
  std::printf("  paper, stretch ignored: %.4f mm, %.5f deg\n", 1e3 * level.displacement_m, level.rotation_deg);
  EXPECT_GT(level.displacement_m, 4e-4);
  EXPECT_LT(level.displacement_m, 7e-4);
}

TEST(Paper, HangsAtRestForMinutes) {
  const mechanics::Plan plan = rigs::paper();
  const Deviation rest = furthest(plan, rigs::resting(plan, rigs::Stretch::kCompensated), 300.0);
  EXPECT_LT(rest.displacement_m, 1e-9);
  EXPECT_LT(rest.rotation_deg, 1e-7);
}

// docs/design.md, fact 6: a small wrench w displaces the load by K⁻¹ w. The force rises slowly and the swing it leaves
// is averaged out.
TEST(Paper, WindDisplacesTheLoadByItsStiffness) {
  const mechanics::Plan plan = rigs::paper();
  const Eigen::Vector3d force_w_n(0.004, -0.003, 0.002);
  const SurroundingsAt calm = rigs::resting(plan, rigs::Stretch::kCompensated);
  const double rise_s = 30.0;
  const LoadMotion start{plan.load.position_w_m, Eigen::Vector3d::Zero(), plan.load.orientation_w_b,
                         Eigen::Vector3d::Zero()};
  LoadIntegrator flight(LoadDynamics(rigid_load(plan)), start, 0.0, [&](double t_s, Surroundings& out) {
    calm(t_s, out);
    out.force_w_n = mechanics::smooth_step(t_s, rise_s).value * force_w_n;
  });
  mechanics::Vector6d mean = mechanics::Vector6d::Zero();
  int samples = 0;
  for (double t_s = 0.02; t_s < rise_s + 30.0; t_s += 0.02) {
    ASSERT_FALSE(flight.advance_to(t_s));
    if (t_s < rise_s) continue;
    const LoadMotion& m = flight.motion();
    mean.head<3>() += m.position_w_m - plan.load.position_w_m;
    mean.tail<3>() += 2.0 * (m.orientation_w_b * plan.load.orientation_w_b.conjugate()).vec();
    ++samples;
  }
  mean /= samples;

  mechanics::Vector6d wrench;
  wrench << force_w_n, Eigen::Vector3d::Zero();
  const mechanics::Matrix6d stiffness = mechanics::load_stiffness(plan, mechanics::slices(plan), 0.0);
  const mechanics::Vector6d expected = stiffness.fullPivLu().solve(wrench);
  EXPECT_LT((mean - expected).norm(), 0.02 * expected.norm()) << mean.transpose() << "\n" << expected.transpose();
  EXPECT_GT(expected.head<3>().norm(), 1e-5) << "the test has to see it move";
}

}  // namespace
}  // namespace gyre::simulator
