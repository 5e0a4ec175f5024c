// What the search is told of a motion is the motion, and its gradients are its changes.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/design/closed_form.hpp"
#include "common/design/effort.hpp"
#include "common/design/judge.hpp"
#include "tests/design/asked.hpp"

namespace gyre::design {
namespace {

using mechanics::test::random_plan;
using mechanics::test::real;

constexpr int kSamples = 8;

/// A random plan with everything open, limits of all kinds, and a place in the middle of its variables.
struct Case {
  Requirements requirements;
  Scales scales;
  Unknowns unknowns;
  std::vector<Demand> demands;
  Eigen::VectorXd x;

  explicit Case(mechanics::Plan plan) {
    for (std::size_t i = 0; i < plan.carriers.size(); ++i) {
      plan.carriers[i].vehicle.mass_kg = 1.0;
      plan.carriers[i].vehicle.thrust_max_n = 30.0;
      plan.carriers[i].vehicle.bank_max_rad = 0.7;
      plan.carriers[i].radius_m = 0.1;
      const bool swings = plan.carriers[i].law.profile.swing != 0.0;
      requirements.open.laws.push_back({false, true, swings, swings});
    }
    plan.limits = {1.0, 50.0, 0.5, 30.0, 1.0, 0.5, 8.0, 6.0, 0.4, 0.3, 0.5};
    plan.winch.acceleration_max_m_s2 = 3.0;
    requirements.open.edges.assign(plan.cycle.edges.size(), {true, true, true});
    requirements.open.rate = true;
    requirements.want.amplitude_max_n = 4.0;
    requirements.given = plan;
    scales = scales_of(requirements);
    unknowns = whole_of(plan, requirements.open, bounds_of(requirements, scales));
    demands = demands_of(requirements, scales);
    x = unknowns.start;
  }
};

RC_GTEST_PROP(Gradient, TheSampledMotionIsTheMotion, ()) {
  const Case c(random_plan());
  SampledMotion motion(c.requirements.given, c.unknowns, kSamples);
  const Eigen::VectorXd at = c.x * real(0.97, 1.03);
  motion.evaluate(at);
  const mechanics::Plan plan = plan_at(c.requirements.given, c.unknowns, at);
  const std::vector<mechanics::CarrierSlice> slices = mechanics::slices(plan);
  for (std::size_t k = 0; k < motion.samples(); ++k) {
    const double t_s = kTwoPi * static_cast<double>(k) / (kSamples * plan.cycle.rate_rad_s);
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const mechanics::Reference now = mechanics::evaluate(slices[i], t_s);
      const Moment& moment = motion.moment(i, k);
      for (int axis = 0; axis < 3; ++axis)
        RC_ASSERT(std::abs(moment.position_w_m[axis].value - now.position_w_m.value[axis]) < 1e-8);
      RC_ASSERT(std::abs(moment[Figure::kTension].value - now.tension_n.value) < 1e-8);
      RC_ASSERT(std::abs(moment[Figure::kSpeed].value - now.position_w_m.first.norm()) < 1e-6);
      RC_ASSERT(std::abs(moment[Figure::kAcceleration].value - now.position_w_m.second.norm()) < 1e-6);
      RC_ASSERT(std::abs(moment[Figure::kWinchRate].value - now.length_m.first) < 1e-8);
    }
  }
}

RC_GTEST_PROP(Gradient, OfEveryDemandIsItsChange, ()) {
  const Case c(random_plan({3, 6}));
  SampledMotion motion(c.requirements.given, c.unknowns, kSamples);
  motion.evaluate(c.x);
  const Judge judge(c.requirements.given, c.unknowns, c.demands, motion);  // sides as they are at x
  const auto found = judge.find(c.x, -std::numeric_limits<double>::infinity()).rows;
  const Judged& judged = found[static_cast<std::size_t>(*rc::gen::inRange<std::size_t>(0, found.size()))];

  Eigen::VectorXd gradient(c.x.size());
  Eigen::VectorXd unused(c.x.size());
  const double here = judge.residual(judged.row, c.x, gradient);
  RC_ASSERT(std::abs(here - judged.residual) <= 1e-12 * std::max(1.0, std::abs(here)));
  for (Eigen::Index g = 0; g < c.x.size(); ++g) {
    const auto moved = [&](double by) {
      const Eigen::VectorXd there = c.x + by * Eigen::VectorXd::Unit(c.x.size(), g);
      motion.evaluate(there);
      return judge.residual(judged.row, there, unused);
    };
    // A distance has a kink where another point becomes the closest: one of both sides is smooth there.
    const double step = 1e-6;
    const double forward = (moved(step) - here) / step;
    const double backward = (here - moved(-step)) / step;
    const double tolerance = 2e-3 * std::max({1.0, std::abs(gradient[g]), std::abs(here)});
    RC_ASSERT(std::min(std::abs(forward - gradient[g]), std::abs(backward - gradient[g])) < tolerance);
  }
}

RC_GTEST_PROP(Gradient, OfEveryEffortIsItsChange, ()) {
  const Case c(random_plan({3, 6}));
  SampledMotion motion(c.requirements.given, c.unknowns, kSamples);
  for (const Objective objective : {Objective::kLeastEverything, Objective::kLeastWinchWork}) {
    const auto at = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
      motion.evaluate(x);
      return effort(objective, motion, c.scales, c.requirements.given.gravity_m_s2, gradient);
    };
    Eigen::VectorXd gradient(c.x.size());
    Eigen::VectorXd unused(c.x.size());
    const double here = at(c.x, gradient);
    RC_ASSERT(here > 0.0);
    for (Eigen::Index g = 0; g < c.x.size(); ++g) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(c.x.size(), g);
      const double change = (at(c.x + step, unused) - at(c.x - step, unused)) / 2e-5;
      RC_ASSERT(std::abs(change - gradient[g]) < 1e-4 * std::max({1.0, here, std::abs(change)}));
    }
  }
}

RC_GTEST_PROP(Unknowns, BothSetsBeginAtThePlanItself, ()) {
  const Case c(random_plan());
  const mechanics::Plan& plan = c.requirements.given;
  const Bounds bounds{1e-9, 1e9, 1e9, -1e9, 1e9, 1e9};  // so wide that none of them moves it
  for (const Unknowns& unknowns :
       {family_of(plan, c.requirements.open, bounds), whole_of(plan, c.requirements.open, bounds)}) {
    const mechanics::Plan same = plan_at(plan, unknowns, unknowns.start);
    const auto a = mechanics::slices(plan);
    const auto b = mechanics::slices(same);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto now = [](const mechanics::CarrierSlice& slice) { return mechanics::evaluate(slice, 0.3); };
      RC_ASSERT((now(a[i]).position_w_m.value - now(b[i]).position_w_m.value).norm() < 1e-8);
    }
  }
}

}  // namespace
}  // namespace gyre::design
