// What holds the load when things are not as planned: clocks that disagree (docs/design.md, fact 4), a carrier that is
// stuck (fact 5), a load that is pushed away (fact 6).

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/skew.hpp"
#include "common/mechanics/stiffness.hpp"
#include "common/mechanics/transition.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/mechanics/track.hpp"

namespace gyre::mechanics::test {
namespace {

/// What stays of the weight when carrier i is at time t + errors[i].
Vector6d residual(const Plan& plan, const std::vector<CarrierSlice>& all, double t_s,
                  const std::vector<double>& errors) {
  std::vector<Eigen::Vector3d> forces;
  for (std::size_t i = 0; i < all.size(); ++i) forces.push_back(force(all[i], t_s + errors[i]).value);
  return wrench(plan, forces) - holding_wrench(plan.load.mass_kg, plan.gravity_m_s2);
}

double greatest_arm(const Plan& plan) {
  double greatest_m = 0.0;
  for (const Eigen::Vector3d& arm : lever_arms(plan)) greatest_m = std::max(greatest_m, arm.norm());
  return greatest_m;
}

// ------------------------------------------------------------------------------------------------------------ clocks

RC_GTEST_PROP(Clocks, a_common_shift_moves_nobody_out_of_equilibrium, ()) {
  const Plan plan = random_plan();
  const std::vector<double> shift(plan.carriers.size(), real(-1e3, 1e3));
  RC_ASSERT(residual(plan, slices(plan), real(0.0, 100.0), shift).norm() <
            1e-12 * plan.load.mass_kg * plan.gravity_m_s2);
}

RC_GTEST_PROP(Clocks, each_edge_leaves_its_amplitude_times_rate_times_disagreement, ()) {
  const Plan plan = random_plan();
  std::vector<double> errors;
  for (std::size_t i = 0; i < plan.carriers.size(); ++i) errors.push_back(real(-1e-3, 1e-3));
  const double t_s = real(0.0, 1.0) * period_s(plan);
  const double rate = plan.cycle.rate_rad_s;
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);

  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  double bound = 0.0;
  double second_order = 0.0;
  for (const Edge& edge : plan.cycle.edges) {
    const std::size_t k = edge.from - 1;
    const std::size_t l = edge.to - 1;
    const double disagreement = errors[k] - errors[l];
    const double slope = edge.amplitude_n * rate * std::cos(rate * t_s + edge.phase_rad);
    linear += slope * disagreement * (arms[k] - arms[l]).normalized();
    bound += edge.amplitude_n * rate * std::abs(disagreement);
    second_order += edge.amplitude_n * rate * rate * 1e-6;
  }
  const Eigen::Vector3d left = residual(plan, slices(plan), t_s, errors).head<3>();
  RC_ASSERT(left.norm() <= bound + 1e-12);
  RC_ASSERT((left - linear).norm() <= second_order + 1e-12);
}

RC_GTEST_PROP(Clocks, the_skew_budget_keeps_its_promise, ()) {
  const Plan plan = random_plan();
  const std::vector<CarrierSlice> all = slices(plan);
  const double weight = plan.load.mass_kg * plan.gravity_m_s2;
  const SkewBudget budget = skew_budget(plan, all, period_s(plan));
  RC_ASSERT(std::abs(budget.budget_s * budget.residual_n_per_s - kSkewShare * weight) < 1e-12 * weight);
  RC_ASSERT(std::abs(budget.holdover_s * kHoldoverDrift - budget.budget_s) < 1e-12 * budget.budget_s);
  RC_ASSERT(budget.budget_s == skew_budget_s(all, weight));
  // The worst disagreement there is within the budget: every clock at one end or the other.
  std::vector<double> errors;
  for (std::size_t i = 0; i < all.size(); ++i) errors.push_back(whole(0, 1) == 0 ? 0.0 : budget.budget_s);
  const double t_s = real(0.0, 1.0) * period_s(plan);
  const Vector6d left = residual(plan, all, t_s, errors);
  RC_ASSERT(left.head<3>().norm() <= kSkewShare * weight * (1.0 + 1e-9));
  RC_ASSERT(left.tail<3>().norm() <= budget.budget_s * budget.residual_n_m_per_s * (1.0 + 1e-9));
  RC_ASSERT(budget.budget_s * budget.residual_n_m_per_s <= kSkewShare * weight * greatest_arm(plan) * (1.0 + 1e-9));
}

RC_GTEST_PROP(Clocks, the_skew_budget_keeps_its_promise_through_transitions_for_force_and_moment, ()) {
  const Plan below = random_plan();
  std::vector<Plan> plans{below};
  std::vector<TimedLayer> times{{nullptr, real(-5.0, 5.0), 0.0, 0.0}};
  for (std::size_t i = whole(1, kMaxLayers - 1); i > 0; --i) {
    plans.push_back(random_motion(below));
    if (whole(0, 1) == 0) plans.back().cycle.rate_rad_s = below.cycle.rate_rad_s;  // of one rate the bound is closer
    times.push_back({nullptr, real(-5.0, 5.0), real(0.0, 4.0), real(0.5, 8.0)});
  }
  std::vector<std::vector<CarrierSlice>> slices_of;
  for (const Plan& plan : plans) slices_of.push_back(slices(plan));
  std::vector<std::vector<TimedLayer>> stacks(below.carriers.size(), times);
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    for (std::size_t k = 0; k < times.size(); ++k) stacks[i][k].slice = &slices_of[k][i];
  }
  const double weight = below.load.mass_kg * below.gravity_m_s2;
  const double budget_s = skew_budget_s(stacks, weight);
  const double t_s = real(-1.0, 13.0);
  std::vector<Eigen::Vector3d> forces;
  for (const std::vector<TimedLayer>& stack : stacks) {
    const double error_s = whole(0, 2) == 0 ? real(0.0, budget_s) : static_cast<double>(whole(0, 1)) * budget_s;
    forces.push_back(evaluate_course(stack.data(), stack.size(), t_s + error_s).force_w_n.value);
  }
  const Vector6d left = wrench(below, forces) - holding_wrench(below.load.mass_kg, below.gravity_m_s2);
  RC_ASSERT(left.head<3>().norm() <= kSkewShare * weight * (1.0 + 1e-9));
  RC_ASSERT(left.tail<3>().norm() <= kSkewShare * weight * greatest_arm(below) * (1.0 + 1e-9));
}

TEST(Clocks, a_change_of_plan_asks_more_of_them_than_either_plan_the_more_the_shorter_it_is) {
  Plan calm = paper_plan();
  for (Edge& edge : calm.cycle.edges) edge.amplitude_n *= 0.5;
  const std::vector<CarrierSlice> a = slices(paper_plan());
  const std::vector<CarrierSlice> b = slices(calm);
  const double weight = 0.3 * 9.81;
  const auto budget_s = [&](double duration_s) {
    std::vector<std::vector<TimedLayer>> stacks;
    for (std::size_t i = 0; i < a.size(); ++i) stacks.push_back({{&a[i], 0, 0, 0}, {&b[i], 0, 0, duration_s}});
    return skew_budget_s(stacks, weight);
  };
  EXPECT_LT(budget_s(5.0), budget_s(20.0));
  EXPECT_LT(budget_s(20.0), skew_budget_s(a, weight));
  EXPECT_NEAR(budget_s(1e9), skew_budget_s(a, weight), 1e-6);
  // Half the amplitude, at the same phases: apart by half of what the paper's turns by, 15/8 / 5 s of that, and its
  // rate.
  EXPECT_NEAR(1.0 / budget_s(5.0), (1.0 + 0.5 * kStepSlopePeak / 5.0 / 0.08) / skew_budget_s(a, weight), 1e-6);
}

TEST(Clocks, one_clock_off_displaces_the_papers_load_as_measured_in_simulated_dynamics) {
  const Plan plan = paper_plan();
  EXPECT_NEAR(certify(plan).skew->displacement_m_per_s, 0.018, 0.001);
  // Slow next to the load's own modes (1 rad/s is not), so that statics tell what dynamics do.
  ASSERT_LT(plan.cycle.rate_rad_s, 0.1 * std::sqrt(certify(plan).stiffness_min_1_s2.value()));
}

TEST(Clocks, a_plan_that_does_not_move_has_all_the_time_there_is) {
  const Certificate certificate = certify(still_plan(paper_plan(), 0.3), {true, true, false});
  EXPECT_EQ(certificate.skew->residual_n_per_s, 0.0);
  EXPECT_EQ(certificate.skew->budget_s, std::numeric_limits<double>::infinity());
}

// ------------------------------------------------------------------------------------------------------------- stuck

TEST(Stuck, one_carrier_alone_leaves_more_than_the_papers_whole_weight_unbalanced) {
  const Plan plan = paper_plan();
  const std::vector<CarrierSlice> all = slices(plan);
  const auto worst = [&](std::size_t stuck) {
    double share = 0.0;
    sample(0.0, period_s(plan), 200, [&](double stuck_s) {
      sample(0.0, period_s(plan), 200, [&](double now_s) {
        std::vector<double> errors(all.size(), 0.0);
        errors[stuck] = stuck_s - now_s;
        const double left = residual(plan, all, now_s, errors).head<3>().norm();
        share = std::max(share, left / (plan.load.mass_kg * plan.gravity_m_s2));
      });
    });
    return share;
  };
  EXPECT_NEAR(worst(0), 1.14, 0.005);  // fact 5
  for (std::size_t stuck = 0; stuck < all.size(); ++stuck) EXPECT_GT(worst(stuck), 1.0);
}

// So it is the clock that has to stop, everybody's: whatever was under way, and in whatever transition.
RC_GTEST_PROP(Stuck, all_that_stand_still_at_one_plan_time_hold_the_load, ()) {
  const Plan below = random_plan();
  const Plan above = random_motion(below);
  const std::vector<CarrierSlice> a = slices(below);
  const std::vector<CarrierSlice> b = slices(above);
  const double t_s = real(-1.0, 6.0);
  std::vector<Eigen::Vector3d> forces;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::vector<TimedLayer> layers{{&a[i], 0.5, 0.0, 0.0}, {&b[i], -0.5, 0.0, 5.0}};
    const Reference moving = evaluate_course(layers.data(), layers.size(), t_s);
    const TaylorVector<double> stands = paced(moving.position_w_m, 0.0, 0.0);
    RC_ASSERT(stands.value == moving.position_w_m.value);
    RC_ASSERT(stands.first.norm() == 0.0);
    RC_ASSERT(stands.second.norm() == 0.0);
    forces.push_back(paced(moving.force_w_n, 0.0, 0.0).value);
  }
  const Vector6d weight = holding_wrench(below.load.mass_kg, below.gravity_m_s2);
  RC_ASSERT((wrench(below, forces) - weight).norm() < 1e-12 * weight.norm());
}

// --------------------------------------------------------------------------------------------------------- stiffness

RC_GTEST_PROP(Stiffness, it_is_the_derivative_of_the_wrench, ()) {
  const Plan plan = random_plan();
  const std::vector<CarrierSlice> all = slices(plan);
  const double t_s = real(0.0, 1.0) * period_s(plan);
  const Matrix6d k = load_stiffness(plan, all, t_s);
  Matrix6d difference;
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 6; ++i) {
    const auto moved = [&](double by) {
      return wrench_of_moving(plan, all, t_s, 0.0, by * Vector6d::Unit(i), Vector6d::Zero());
    };
    difference.col(i) =
        (8.0 * (moved(kStep) - moved(-kStep)) - (moved(2.0 * kStep) - moved(-2.0 * kStep))) / (12.0 * kStep);
  }
  RC_ASSERT((k + difference).norm() < 1e-9 * k.norm());
  RC_ASSERT((k - k.transpose()).norm() < 1e-12 * k.norm());
}

RC_GTEST_PROP(Stiffness, the_least_is_below_every_sampled_eigenvalue_and_attained, ()) {
  RandomPlan wish;
  wish.carriers_max = 5;
  wish.mixed_laws = false;  // one turn, which the samples below are dense for
  const Plan plan = random_plan(wish);
  const std::vector<CarrierSlice> all = slices(plan);
  const double least = least_stiffness(plan, all, period_s(plan));
  const Eigen::LLT<Matrix6d> inertia(load_inertia(plan.load));
  Track sampled;
  sample(0.0, period_s(plan), 1500, [&](double t_s) {
    const Matrix6d half = inertia.matrixL().solve(load_stiffness(plan, all, t_s));
    const Matrix6d whole_matrix = inertia.matrixL().solve(half.transpose());
    sampled.add(Eigen::SelfAdjointEigenSolver<Matrix6d>(whole_matrix, Eigen::EigenvaluesOnly).eigenvalues()(0));
  });
  RC_ASSERT(least <= sampled.range().min + 1e-4 * sampled.size());
  RC_ASSERT(least >= sampled.range().min - 4.0 * sampled.missed() - 1e-2 * sampled.size());
}

TEST(Stiffness, the_papers_load_is_stable_level_and_fixed) {
  EXPECT_NEAR(certify(paper_plan()).stiffness_min_1_s2.value(), 18.0, 0.05);
  EXPECT_NEAR(certify(reference_plan("paper-fixed")).stiffness_min_1_s2.value(), 9.2, 0.05);
}

TEST(Stiffness, one_cable_is_a_pendulum) {
  Plan plan;
  plan.load.mass_kg = 2.0;
  plan.load.inertia_b_kg_m2 = 0.1 * Eigen::Matrix3d::Identity();
  plan.gravity_m_s2 = 9.81;
  plan.cable = {1e4, 1e3};
  plan.cycle.rate_rad_s = 1.0;
  plan.carriers.push_back({1, Eigen::Vector3d::Zero(), LengthLaw::fixed(3.0)});
  const Matrix6d k = load_stiffness(plan, slices(plan), 0.0);
  EXPECT_NEAR(k(0, 0) / plan.load.mass_kg, 9.81 / 3.0, 1e-12);  // g / l
  EXPECT_NEAR(k(2, 2), 1e4, 1e-9);
  EXPECT_LT((k.bottomRightCorner<3, 3>().norm()), 1e-12);
}

}  // namespace
}  // namespace gyre::mechanics::test
