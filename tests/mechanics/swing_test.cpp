// Does a swing die out: the load's linear motion against the wrench of its cables, and Floquet's verdict on missions
// whose exponents were found independently of this code.

#include "common/mechanics/swing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mission/mission.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/places.hpp"

namespace gyre::mechanics::test {
namespace {

Plan mission(const std::string& path) {
  const auto read = mission::read_mission_file(gyre::test::source_directory() + "/" + path + ".textproto");
  if (!read) ADD_FAILURE() << read.error().text;
  return read.value().plan;
}

Plan braid() {
  return mission("tests/data/missions/fixed-wing-braid");
}

double growth(const Plan& plan, const SwingCase& asked = {}) {
  return swing_growth(plan, slices(plan), period_s(plan), asked);
}

Swings look(const Plan& plan) {
  const std::vector<CarrierSlice> all = slices(plan);
  return swings(plan, all, period_s(plan), least_stiffness(plan, all, period_s(plan)));
}

// --------------------------------------------------------------------------------------------- the linear equation

RC_GTEST_PROP(Swing, the_linear_equation_is_the_derivative_of_the_wrench, ()) {
  const Plan plan = random_plan();
  const std::vector<CarrierSlice> all = slices(plan);
  const double t_s = real(0.0, 1.0) * period_s(plan);
  const double pace = real(0.1, 1.0);
  const LinearMoment m = linear_moment(plan, all, t_s);
  constexpr double kStep = 1e-3;
  Matrix6d by_place, by_velocity;
  for (int i = 0; i < 6; ++i) {
    const Vector6d zero = Vector6d::Zero();
    const auto moved = [&](double by) { return wrench_of_moving(plan, all, t_s, pace, by * Vector6d::Unit(i), zero); };
    const auto moving = [&](double by) { return wrench_of_moving(plan, all, t_s, pace, zero, by * Vector6d::Unit(i)); };
    by_place.col(i) =
        (8.0 * (moved(kStep) - moved(-kStep)) - (moved(2.0 * kStep) - moved(-2.0 * kStep))) / (12.0 * kStep);
    by_velocity.col(i) = (moving(kStep) - moving(-kStep)) / (2.0 * kStep);
  }
  const Matrix6d held = m.stiffness + pace * m.circulation;
  RC_ASSERT((held + by_place).norm() < 1e-8 * held.norm());
  RC_ASSERT((m.damping + by_velocity).norm() < 1e-8 * m.damping.norm());
  // The turning of cables is seen by this comparison, and not lost beside their stiffness.
  RC_ASSERT((m.stiffness + by_place).norm() > 0.5 * pace * m.circulation.norm());
}

RC_GTEST_PROP(Swing, at_rest_it_is_the_eigenvalues_and_within_the_proven_bound, ()) {
  RandomPlan wish;
  wish.carriers_max = 5;
  const Plan moving = random_plan(wish);
  Plan plan = still_plan(moving, real(0.0, kTwoPi));
  plan.cable.stiffness_n_m *= real(0.0, 1.0) < 0.5 ? 1.0 : 1e-3;
  const std::vector<CarrierSlice> all = slices(plan);
  const LinearMoment m = linear_moment(plan, all, 0.0);
  Eigen::Matrix<double, 12, 12> a = Eigen::Matrix<double, 12, 12>::Zero();
  const Matrix6d inertia = load_inertia(plan.load);
  a.topRightCorner<6, 6>().setIdentity();
  a.bottomLeftCorner<6, 6>() = -inertia.inverse() * m.stiffness;
  a.bottomRightCorner<6, 6>() = -inertia.inverse() * m.damping;
  const double known = a.eigenvalues().real().maxCoeff();
  RC_ASSERT(m.circulation.norm() == 0.0);
  const double found = growth(plan, {1.0, 1.0, 4096});
  RC_ASSERT(std::abs(found - known) < 1e-4 * (1.0 + std::abs(known)));
  const double bound = std::sqrt(std::max(0.0, -least_stiffness(plan, all, period_s(plan))));
  RC_ASSERT(known <= bound + 1e-6 * (1.0 + bound));
}

TEST(Swing, a_load_a_thousand_times_as_heavy_on_cables_as_much_stiffer_swings_the_same) {
  const Plan light = polygon_plan(3);
  Plan heavy = light;
  heavy.load.mass_kg *= 1e3;
  heavy.load.inertia_b_kg_m2 *= 1e3;
  heavy.cable.stiffness_n_m *= 1e3;
  heavy.cable.damping_n_s_m *= 1e3;
  for (Edge& edge : heavy.cycle.edges) edge.amplitude_n *= 1e3;
  EXPECT_NEAR(growth(heavy), growth(light), 1e-9);
}

// ------------------------------------------------------------------------------------------------------- missions

TEST(Swing, missions_have_the_exponents_that_were_found_independently) {
  struct Known {
    const char* path;
    double growth_1_s, to;
  };
  for (const Known& known :
       {Known{"deploy/missions/paper", -0.024, 5e-4}, Known{"deploy/missions/paper-fixed", -0.015, 5e-4},
        Known{"deploy/missions/paper-headings", -0.00004, 5e-6},
        Known{"tests/data/missions/fixed-wing-braid", -0.00034, 5e-6},
        Known{"deploy/missions/hex-multirotor", -0.0025, 5e-5}, Known{"deploy/missions/tri-mixed", -0.00069, 5e-6},
        Known{"deploy/missions/penta-tilted", -0.190, 5e-4}, Known{"deploy/missions/pair-unrestricted", 0.0, 5e-6}}) {
    EXPECT_NEAR(look(mission(known.path)).growth_1_s, known.growth_1_s, known.to) << known.path;
  }
}

TEST(Swing, the_braided_trio_grows_at_other_rates_and_at_a_smaller_amplitude) {
  // At 0.6 to 1.6 times its rate, which is what a pace is.
  double fastest = -1.0;
  int growing = 0;
  constexpr int kRates = 200;
  for (int i = 0; i <= kRates; ++i) {
    const double g = growth(braid(), {0.6 + i * 1.0 / kRates, 1.0, 256});
    fastest = std::max(fastest, g);
    if (g > kNeutralGrowth_1_s) ++growing;
  }
  EXPECT_NEAR(fastest, 0.055, 0.003);
  EXPECT_NEAR(static_cast<double>(growing) / kRates, 0.44, 0.12);
  Plan smaller = braid();
  for (Edge& edge : smaller.cycle.edges) edge.amplitude_n *= 0.80;
  EXPECT_NEAR(growth(smaller), 0.0022, 3e-4);
  EXPECT_GT(least_stiffness(braid(), slices(braid()), period_s(braid())), 0.3) << "positive stiffness is not enough";
}

TEST(Swing, a_pace_is_a_rate) {
  for (const double pace : {0.5, 0.76, 1.3}) {
    Plan faster = braid();
    faster.cycle.rate_rad_s *= pace;
    EXPECT_NEAR(growth(faster), growth(braid(), {pace, 1.0, 512}), 1e-9) << pace;
  }
}

// ---------------------------------------------------------------------------------------------------- the figures

RC_GTEST_PROP(Swing, random_plans_have_numbers_that_twice_the_steps_agree_with, ()) {
  RandomPlan wish;
  wish.carriers_max = 6;
  wish.mixed_laws = real(0.0, 1.0) < 0.5;
  const Plan plan = random_plan(wish);
  const Swings found = look(plan);
  RC_ASSERT(std::isfinite(found.growth_1_s) && std::isfinite(found.worst_1_s));
  RC_ASSERT(found.worst_1_s >= found.growth_1_s);
  RC_ASSERT(found.paces.front().pace == 0.0 && found.paces.back().pace == 1.0);
  RC_ASSERT(found.paces.back().growth_1_s == found.growth_1_s);
  for (const PaceGrowth& p : found.paces) RC_ASSERT(std::isfinite(p.growth_1_s));
  // As good as a rest, or as many steps have it, where these are enough for this motion.
  const double bound = std::sqrt(std::max(0.0, -least_stiffness(plan, slices(plan), period_s(plan))));
  const double coarse = growth(plan, {1.0, 1.0, 1500});
  const double fine = growth(plan, {1.0, 1.0, 3000});
  if (std::abs(fine - coarse) > 0.01 * std::abs(fine) || found.growth_1_s == bound) return;
  RC_ASSERT(std::abs(found.growth_1_s - fine) < 2.0 * kNeutralGrowth_1_s + 0.05 * std::abs(fine));
}

TEST(Swing, between_two_paces_it_is_the_faster_growth_of_both) {
  Swings s;
  s.paces = {{0.0, 0.0}, {0.4, 0.01}, {0.6, -0.02}, {1.0, -0.01}};
  EXPECT_EQ(s.growth_at(0.4), 0.01);
  EXPECT_EQ(s.growth_at(0.6), -0.02);
  EXPECT_EQ(s.growth_at(0.2), 0.01);
  EXPECT_EQ(s.growth_at(0.5), 0.01);
  EXPECT_EQ(s.growth_at(0.8), -0.01);
  EXPECT_EQ(s.growth_at(-0.1), 0.0);
  EXPECT_EQ(s.growth_at(1.2), -0.01);
}

TEST(Swing, the_grid_of_paces_has_what_is_found_there) {
  const Swings found = look(braid());
  ASSERT_GT(found.paces.size(), 10U);
  for (const PaceGrowth& p : found.paces) {
    if (p.pace == 0.0) continue;
    EXPECT_NEAR(p.growth_1_s, growth(braid(), {p.pace, 1.0, 1024}), 5e-4) << p.pace;
  }
  EXPECT_GT(found.growth_at(0.76), 0.03);
  EXPECT_LT(found.growth_at(0.3), kNeutralGrowth_1_s);
}

TEST(Swing, nothing_grows_at_paces_that_are_passed_over_as_a_sequence_of_rests) {
  // What the grid leaves out, looked at densely, with all the steps it takes.
  for (const char* path :
       {"deploy/missions/tri-mixed", "deploy/missions/hex-multirotor", "deploy/missions/penta-tilted"}) {
    const Plan plan = mission(path);
    const Swings found = look(plan);
    const double slowest = found.paces.size() > 2 ? found.paces[1].pace : 1.0;
    for (double pace = 0.06; pace < slowest; pace += 0.02) {
      EXPECT_LE(growth(plan, {pace, 1.0, 4096}), kNeutralGrowth_1_s) << path << " at " << pace;
    }
  }
}

TEST(Swing, a_plan_that_depends_on_the_third_digit_of_its_inertia_is_refused) {
  const Certificate pair = certify(mission("deploy/missions/pair-unrestricted"));
  EXPECT_LT(pair.swings->growth_1_s, kNeutralGrowth_1_s) << "as it is, nothing grows";
  EXPECT_GT(pair.swings->worst_1_s, 0.1);
  ASSERT_EQ(pair.reasons.size(), 2U) << "its cables cross, and";
  EXPECT_EQ(pair.reasons.back().rule, Rule::kSwing);
  CertifyOptions still;
  still.non_stop = still.separation = false;
  EXPECT_TRUE(certify(mission("deploy/missions/pair-unrestricted"), still).admissible());
  CertifyOptions without;
  without.swings = false;
  EXPECT_FALSE(certify(mission("deploy/missions/pair-unrestricted"), without).swings);
}

TEST(Swing, paces_at_which_one_grows_are_a_caution_that_names_them) {
  const Certificate trio = certify(braid());
  ASSERT_EQ(trio.cautions.size(), 1U);
  EXPECT_EQ(trio.cautions.front().rule, Rule::kSwing);
  EXPECT_NE(trio.cautions.front().text.find("0.72 .. 0.76, 0.84"), std::string::npos) << trio.cautions.front().text;
  EXPECT_TRUE(certify(mission("deploy/missions/hex-multirotor")).cautions.empty());
}

}  // namespace
}  // namespace gyre::mechanics::test
