// The laws of a carrier's reference on random geometries: equilibrium, kernel, derivatives, length laws.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/grasp.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

std::vector<Eigen::Vector3d> forces(const std::vector<CarrierSlice>& all, double t_s) {
  std::vector<Eigen::Vector3d> out;
  for (const CarrierSlice& slice : all) out.push_back(force(slice, t_s).value);
  return out;
}

double random_time(const Plan& plan) {
  return real(-2.0, 3.0) * period_s(plan);
}

RC_GTEST_PROP(Motion, the_forces_hold_the_load_at_every_moment, ()) {
  const Plan plan = random_plan();
  const Vector6d weight = holding_wrench(plan.load.mass_kg, plan.gravity_m_s2);
  RC_ASSERT((wrench(plan, forces(slices(plan), random_time(plan))) - weight).norm() < 1e-12 * weight.norm());
}

RC_GTEST_PROP(Motion, the_certificate_bounds_the_wrench_error_by_rounding, ()) {
  const Plan plan = random_plan();
  CertifyOptions figures_only;
  figures_only.separation = figures_only.stiffness = false;
  RC_ASSERT(certify(plan, figures_only).wrench_error_max_n < 1e-12 * plan.load.mass_kg * plan.gravity_m_s2);
}

RC_GTEST_PROP(Motion, internal_forces_lie_in_the_kernel_of_the_grasp_map, ()) {
  Plan plan = random_plan();
  const std::vector<Eigen::Vector3d> with = forces(slices(plan), random_time(plan));
  for (Edge& edge : plan.cycle.edges) edge.offset_n = edge.amplitude_n = 0.0;
  std::vector<Eigen::Vector3d> internal = forces(slices(plan), 0.0);
  double size = 0.0;
  for (std::size_t i = 0; i < internal.size(); ++i) {
    internal[i] = with[i] - internal[i];
    size += internal[i].norm();
  }
  RC_ASSERT(size > 0.0);
  RC_ASSERT(wrench(plan, internal).norm() < 1e-12 * plan.load.mass_kg * plan.gravity_m_s2);
}

RC_GTEST_PROP(Motion, the_particular_force_is_the_smallest_that_holds_the_load, ()) {
  const Plan plan = random_plan();
  const Vector6d weight = holding_wrench(plan.load.mass_kg, plan.gravity_m_s2);
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  const ParticularForce particular = particular_force(arms, weight);
  // Minimum norm: orthogonal to the kernel, which is f0 = G' y for the y of the normal equations.
  const GraspMap g = grasp_map(arms);
  const Vector6d y = (g * g.transpose()).ldlt().solve(weight);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const Eigen::Vector3d expected = g.middleCols<3>(3 * static_cast<Eigen::Index>(i)).transpose() * y;
    RC_ASSERT((particular.forces_w_n[i] - expected).norm() < 1e-9 * weight.norm());
  }
}

/// d/dt by differences of fourth order. A derivative of the next order that is wrong by a factor shows at once.
template <class Value>
auto difference(const Value& value, double t_s, double h) {
  return ((8.0 * (value(t_s + h) - value(t_s - h)) - (value(t_s + 2.0 * h) - value(t_s - 2.0 * h))) / (12.0 * h))
      .eval();
}

using Scalar = Eigen::Matrix<double, 1, 1>;
Scalar wrapped(double value) {
  return Scalar::Constant(value);
}
const Eigen::Vector3d& wrapped(const Eigen::Vector3d& value) {
  return value;
}

/// `part` picks a quantity of the reference; its first and second must be the derivatives of its value and its first.
template <class Part>
void check_derivatives(const CarrierSlice& slice, double t_s, const Part& part) {
  const double h = 2e-3 / slice.rate_rad_s;
  const auto now = part(evaluate(slice, t_s));
  const auto first = difference([&](double t) { return wrapped(part(evaluate(slice, t)).value).eval(); }, t_s, h);
  const auto second = difference([&](double t) { return wrapped(part(evaluate(slice, t)).first).eval(); }, t_s, h);
  const double w = slice.rate_rad_s;
  const double scale = wrapped(now.value).norm() + wrapped(now.first).norm() / w + wrapped(now.second).norm() / (w * w);
  RC_ASSERT((first - wrapped(now.first)).norm() < 1e-7 * scale * w);
  RC_ASSERT((second - wrapped(now.second)).norm() < 1e-7 * scale * w * w);
}

RC_GTEST_PROP(Motion, every_derivative_is_the_limit_of_differences, ()) {
  const Plan plan = random_plan();
  const double t_s = random_time(plan);
  for (const CarrierSlice& slice : slices(plan)) {
    check_derivatives(slice, t_s, [](const Reference& r) { return r.force_w_n; });
    check_derivatives(slice, t_s, [](const Reference& r) { return r.tension_n; });
    check_derivatives(slice, t_s, [](const Reference& r) { return r.direction_w; });
    check_derivatives(slice, t_s, [](const Reference& r) { return r.length_m; });
    check_derivatives(slice, t_s, [](const Reference& r) { return r.position_w_m; });
  }
}

// The clock tau passes at any pace: p(tau(t)), with tau = tau0 + pace t + rate t² / 2.
RC_GTEST_PROP(Motion, on_a_paced_clock_every_derivative_is_the_limit_of_differences, ()) {
  const Plan plan = random_plan();
  const double tau_s = random_time(plan);
  const double pace = real(-0.5, 1.5);
  for (const CarrierSlice& slice : slices(plan)) {
    const double w = slice.rate_rad_s;
    const double rate_1_s = real(-1.0, 1.0) * w;
    const auto at = [&](double t_s) {
      const Reference r = evaluate(slice, tau_s + pace * t_s + 0.5 * rate_1_s * t_s * t_s);
      return paced(r.position_w_m, pace + rate_1_s * t_s, rate_1_s);
    };
    const double h = 1e-3 / w;
    const auto now = at(0.0);
    const Eigen::Vector3d first = difference([&](double t) { return at(t).value; }, 0.0, h);
    const Eigen::Vector3d second = difference([&](double t) { return at(t).first; }, 0.0, h);
    const double scale = now.value.norm() + now.first.norm() / w + now.second.norm() / (w * w);
    RC_ASSERT((first - now.first).norm() < 1e-7 * scale * w);
    RC_ASSERT((second - now.second).norm() < 1e-7 * scale * w * w);
  }
}

RC_GTEST_PROP(Motion, the_direction_is_a_unit_vector_along_the_force_and_moves_across_itself, ()) {
  const Plan plan = random_plan();
  const double t_s = random_time(plan);
  for (const CarrierSlice& slice : slices(plan)) {
    const Reference r = evaluate(slice, t_s);
    const Eigen::Vector3d& q = r.direction_w.value;
    RC_ASSERT(std::abs(q.norm() - 1.0) < 1e-14);
    RC_ASSERT((r.tension_n.value * q - r.force_w_n.value).norm() < 1e-14 * r.tension_n.value);
    RC_ASSERT(std::abs(q.dot(r.direction_w.first)) < 1e-13 * (1.0 + r.direction_w.first.norm()));
    // q·q = 1 twice differentiated: q·q'' + |q'|² = 0
    RC_ASSERT(std::abs(q.dot(r.direction_w.second) + r.direction_w.first.squaredNorm()) <
              1e-12 * (1.0 + r.direction_w.second.norm()));
    // dq = (I − q q') df / |f|, the paper's own form
    const Eigen::Vector3d paper =
        (Eigen::Matrix3d::Identity() - q * q.transpose()) * r.force_w_n.first / r.tension_n.value;
    RC_ASSERT((paper - r.direction_w.first).norm() < 1e-12 * (1.0 + paper.norm()));
  }
}

RC_GTEST_PROP(Motion, every_length_law_does_what_it_is_named_for, ()) {
  const Plan plan = random_plan();
  const double t_s = random_time(plan);
  for (const CarrierSlice& slice : slices(plan)) {
    const Reference r = evaluate(slice, t_s);
    const Oscillation& profile = slice.law.profile;
    const double phase = plan.cycle.rate_rad_s * profile.harmonic.ratio() * t_s + profile.phase_rad;
    const double target = profile.mean + profile.swing * std::sin(phase);
    const double rate = profile.swing * plan.cycle.rate_rad_s * profile.harmonic.ratio() * std::cos(phase);
    if (slice.law.is_projection()) {
      const Eigen::Vector3d& u = slice.law.direction;
      RC_ASSERT(std::abs(u.dot(r.position_w_m.value) - target) < 1e-12 * (1.0 + r.length_m.value));
      RC_ASSERT(std::abs(u.dot(r.position_w_m.first) - rate) < 1e-11);
    } else {
      RC_ASSERT(std::abs(r.length_m.value - target) < 1e-12);
      RC_ASSERT(std::abs(r.length_m.first - rate) < 1e-12);
    }
    RC_ASSERT((r.position_w_m.value - slice.attachment_w_m - r.length_m.value * r.direction_w.value).norm() < 1e-12);
  }
}

RC_GTEST_PROP(Motion, it_repeats_after_its_period, ()) {
  const Plan plan = random_plan();
  const double t_s = random_time(plan);
  for (const CarrierSlice& slice : slices(plan)) {
    const Eigen::Vector3d later = evaluate(slice, t_s + period_s(plan)).position_w_m.value;
    RC_ASSERT((later - evaluate(slice, t_s).position_w_m.value).norm() < 1e-10);
  }
}

/// Every number of a slice.
std::vector<double*> numbers_of(CarrierSlice& s) {
  std::vector<double*> out{&s.rate_rad_s, &s.cable_stiffness_n_m, &s.law.profile.mean, &s.law.profile.swing,
                           &s.law.profile.phase_rad};
  for (EdgePush* push : {&s.incoming, &s.outgoing}) {
    out.insert(out.end(), {&push->offset_n, &push->amplitude_n, &push->phase_rad});
  }
  for (Eigen::Vector3d* v :
       {&s.attachment_w_m, &s.particular_force_w_n, &s.incoming.direction, &s.outgoing.direction, &s.law.direction}) {
    out.insert(out.end(), {&v->x(), &v->y(), &v->z()});
  }
  return out;
}

RC_GTEST_PROP(Slice, it_is_alike_but_for_rounding_and_not_beyond, ()) {
  const CarrierSlice slice = slices(random_plan()).front();
  CarrierSlice other = slice;
  const std::vector<double*> numbers = numbers_of(other);
  for (double* number : numbers) *number += 1e-12 * std::max(1.0, std::abs(*number)) * real(-1.0, 1.0);
  RC_ASSERT(alike(slice, other));
  for (double* number : numbers) {
    const double before = *number;
    *number += 1e-8 * std::max(1.0, std::abs(before));
    RC_ASSERT(!alike(slice, other));
    *number = std::numeric_limits<double>::quiet_NaN();
    RC_ASSERT(!alike(slice, other));
    *number = before;
  }
  for (int* number : {&other.law.profile.harmonic.numerator, &other.law.profile.harmonic.denominator}) {
    ++*number;
    RC_ASSERT(!alike(slice, other));
    --*number;
  }
  ++other.id;
  RC_ASSERT(!alike(slice, other));
  --other.id;
  other.law.kind = slice.law.kind == LengthLaw::Kind::kFixed ? LengthLaw::Kind::kSine : LengthLaw::Kind::kFixed;
  RC_ASSERT(!alike(slice, other));
}

TEST(Period, it_is_the_least_common_one_of_the_cycle_and_every_profile) {
  Plan plan = polygon_plan(3);
  const double cycle_s = 2.0 * kPi / plan.cycle.rate_rad_s;
  EXPECT_DOUBLE_EQ(period_s(plan), cycle_s);
  plan.carriers[0].law = LengthLaw::sine({3.0, 0.5, {1, 2}, 0.0});
  plan.carriers[1].law = LengthLaw::sine({3.0, 0.5, {5, 3}, 0.0});
  EXPECT_DOUBLE_EQ(period_s(plan), 6.0 * cycle_s);
  plan.carriers[1].law.profile.swing = 0.0;  // what does not move has no period
  EXPECT_DOUBLE_EQ(period_s(plan), 2.0 * cycle_s);
}

RC_GTEST_PROP(Motion, the_force_of_an_orbit_runs_on_an_ellipse, ()) {
  const Plan plan = random_plan();
  const double rate = plan.cycle.rate_rad_s;
  const double theta = real(-10.0, 10.0);
  for (const CarrierSlice& slice : slices(plan)) {
    const auto f = [&](double angle) { return force(slice, angle / rate).value; };
    // f = c + u cos theta + v sin theta, from three points of it.
    const Eigen::Vector3d c = 0.5 * (f(0.0) + f(kPi));
    const Eigen::Vector3d u = f(0.0) - c;
    const Eigen::Vector3d v = f(0.5 * kPi) - c;
    RC_ASSERT((c + u * std::cos(theta) + v * std::sin(theta) - f(theta)).norm() < 1e-11 * (1.0 + c.norm()));
  }
}

RC_GTEST_PROP(Motion, a_level_carriers_speed_follows_from_a_polynomial_of_degree_one, ()) {
  RandomPlan level;
  level.mixed_laws = false;
  const Plan plan = random_plan(level);
  const double rate = plan.cycle.rate_rad_s;
  for (const CarrierSlice& slice : slices(plan)) {
    const auto w = [&](double theta) -> Eigen::Vector2d {
      const TaylorVector<double> f = force(slice, theta / rate);
      // W = f_xy' f_z − f_xy f_z', primes by theta
      return (f.first.head<2>() * f.value.z() - f.value.head<2>() * f.first.z()) / rate;
    };
    const Eigen::Vector2d mean = 0.5 * (w(0.0) + w(kPi));
    const double theta = real(-kPi, kPi);
    const Eigen::Vector2d degree_one =
        mean + (w(0.0) - mean) * std::cos(theta) + (w(0.5 * kPi) - mean) * std::sin(theta);
    const Reference r = evaluate(slice, theta / rate);
    const double scale = r.tension_n.value * r.tension_n.value;
    RC_ASSERT((degree_one - w(theta)).norm() < 1e-11 * scale);

    const double drop = slice.law.profile.mean - slice.attachment_w_m.z();
    const double f_z = r.force_w_n.value.z();
    const double speed = std::abs(drop * rate) * w(theta).norm() / (f_z * f_z);
    RC_ASSERT(std::abs(speed - r.position_w_m.first.norm()) < 1e-10 * (1.0 + speed));
  }
}

RC_GTEST_PROP(Motion, a_level_carrier_stops_exactly_when_its_direction_does, ()) {
  RandomPlan level;
  level.mixed_laws = false;
  Plan plan = random_plan(level);
  // Equal phases: every force runs on a line, and stands still at both ends of it.
  for (Edge& edge : plan.cycle.edges) edge.phase_rad = 0.0;
  const double stop_s = 0.5 * kPi / plan.cycle.rate_rad_s;
  for (const CarrierSlice& slice : slices(plan)) {
    const Reference stopped = evaluate(slice, stop_s);
    RC_ASSERT(stopped.direction_w.first.norm() < 1e-12);
    RC_ASSERT(stopped.position_w_m.first.norm() < 1e-11);
    const double t_s = real(0.1, 0.9) * stop_s;
    const Reference moving = evaluate(slice, t_s);
    if (moving.direction_w.first.norm() > 1e-9) RC_ASSERT(moving.position_w_m.first.norm() > 0.0);
    // |v| lies between l |q'| (turning alone) and l |q'| / |q_z| (and paying out as the altitude asks).
    const double turning = moving.length_m.value * moving.direction_w.first.norm();
    RC_ASSERT(moving.position_w_m.first.norm() >= turning * (1.0 - 1e-12));
    RC_ASSERT(moving.position_w_m.first.norm() <= turning / moving.direction_w.value.z() * (1.0 + 1e-9));
  }
}

}  // namespace
}  // namespace gyre::mechanics::test
