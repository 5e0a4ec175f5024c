// Laws of a rigid body on elastic cables; every figure compared against is derived here or in a textbook.

#include "simulator/core/load_dynamics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstdio>

#include "common/base/angle.hpp"
#include "common/base/random_stream.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

using Eigen::Vector3d;
using rigs::anchor_at;

LoadIntegrator integrator(const RigidLoad& load, const LoadMotion& start, SurroundingsAt surroundings) {
  return {LoadDynamics(load), start, 0.0, std::move(surroundings)};
}

void advance(LoadIntegrator& integrator, double t_s) {
  const auto failure = integrator.advance_to(t_s);
  ASSERT_FALSE(failure) << failure->text;
}

TEST(LoadDynamics, FallsFreelyWhileTheCableIsSlack) {
  RigidLoad load = rigs::bob({1e4, 1e3});
  auto flight = integrator(load, {}, rigs::fixed({anchor_at({0, 0, 1}, 50.0)}));
  for (const double t_s : {0.5, 1.0, 2.0}) {
    advance(flight, t_s);
    EXPECT_NEAR(flight.motion().position_w_m.z(), -0.5 * load.gravity_m_s2 * t_s * t_s, 1e-7);
    EXPECT_NEAR(flight.motion().velocity_w_m_s.z(), -load.gravity_m_s2 * t_s, 1e-7);
  }
}

TEST(LoadDynamics, FreeTumblingKeepsAngularMomentumEnergyAndUnitQuaternion) {
  RigidLoad load = rigs::body();
  load.gravity_m_s2 = 0.0;
  LoadMotion start;
  // Near the middle axis: the one that flips over.
  start.angular_velocity_b_rad_s = {0.02, 4.0, 0.03};
  auto flight = integrator(load, start, rigs::fixed({}));
  const Vector3d momentum_w = load.inertia_b_kg_m2 * start.angular_velocity_b_rad_s;
  const double energy_j = 0.5 * start.angular_velocity_b_rad_s.dot(momentum_w);
  double least_spin = 4.0;
  for (double t_s = 0.1; t_s < 60.0; t_s += 0.1) {
    advance(flight, t_s);
    const LoadMotion& m = flight.motion();
    const Vector3d spin_momentum_b = load.inertia_b_kg_m2 * m.angular_velocity_b_rad_s;
    EXPECT_LT((m.orientation_w_b * spin_momentum_b - momentum_w).norm(), 1e-4 * momentum_w.norm()) << t_s;
    EXPECT_NEAR(0.5 * m.angular_velocity_b_rad_s.dot(spin_momentum_b), energy_j, 1e-4 * energy_j) << t_s;
    EXPECT_NEAR(m.orientation_w_b.norm(), 1.0, 1e-12);
    least_spin = std::min(least_spin, m.angular_velocity_b_rad_s.y());
  }
  EXPECT_LT(least_spin, -3.5) << "the test has to see it flip";
}

TEST(LoadDynamics, TheIntegratedQuaternionStaysUnitByItself) {
  const LoadDynamics dynamics(rigs::body());
  StateVector y = dynamics.pack({});
  y.segment<4>(6) << 1.01, 0, 0, 0;
  StateVector dy;
  dynamics.derivative(y, {}, dy);
  EXPECT_LT(dy(6), 0.0) << "too long: shrinks";
  y.segment<4>(6) << 0.99, 0, 0, 0;
  dynamics.derivative(y, {}, dy);
  EXPECT_GT(dy(6), 0.0) << "too short: grows";
}

TEST(LoadDynamics, PendulumHasTheAnalyticPeriod) {
  const double length_m = 2.0;
  const double amplitude_rad = 0.5;
  const RigidLoad load = rigs::bob({1e7, 1e3});
  LoadMotion start;
  start.position_w_m = {length_m * std::sin(amplitude_rad), 0.0, -length_m * std::cos(amplitude_rad)};
  auto flight = integrator(load, start, rigs::fixed({anchor_at(Vector3d::Zero(), length_m)}));

  // T = 4 √(l/g) K(sin(a/2)), K by the arithmetic-geometric mean.
  double a = 1.0;
  double g = std::cos(0.5 * amplitude_rad);
  for (int i = 0; i < 10; ++i) {
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
  }
  const double period_s = kTwoPi * std::sqrt(length_m / load.gravity_m_s2) / a;

  // The time of the tenth return from x < 0 to x > 0, interpolated.
  const double step_s = 0.002;
  double before = start.position_w_m.x();
  double crossing_s = 0.0;
  int crossings = 0;
  for (double t_s = step_s; crossings < 10; t_s += step_s) {
    ASSERT_LT(t_s, 100.0);
    advance(flight, t_s);
    const double x = flight.motion().position_w_m.x();
    if (before < 0.0 && x >= 0.0) {
      ++crossings;
      crossing_s = t_s - step_s * x / (x - before);
    }
    before = x;
  }
  EXPECT_NEAR(crossing_s / 9.75, period_s, 2e-5 * period_s);
}

TEST(LoadDynamics, SpringHasItsFrequencyAndItsDamping) {
  const mechanics::Cable cable{200.0, 0.8};
  const RigidLoad load = rigs::bob(cable);
  const double m = load.mass_kg;
  const double sag_m = m * load.gravity_m_s2 / cable.stiffness_n_m;
  LoadMotion start;
  start.position_w_m.z() = -1.0 - sag_m - 0.05;
  auto flight = integrator(load, start, rigs::fixed({anchor_at(Vector3d::Zero(), 1.0)}));

  // m z'' = −k z − c z':  z = z0 exp(−ζt) (cos ωt + (ζ/ω) sin ωt)
  const double zeta = cable.damping_n_s_m / (2.0 * m);
  const double omega = std::sqrt(cable.stiffness_n_m / m - zeta * zeta);
  for (double t_s = 0.01; t_s < 5.0; t_s += 0.01) {
    advance(flight, t_s);
    const double expected =
        -0.05 * std::exp(-zeta * t_s) * (std::cos(omega * t_s) + zeta / omega * std::sin(omega * t_s));
    EXPECT_NEAR(flight.motion().position_w_m.z() + 1.0 + sag_m, expected, 2e-6) << t_s;
  }
}

double energy_j(const LoadDynamics& dynamics, const LoadMotion& m, const std::vector<Anchor>& anchors) {
  const RigidLoad& load = dynamics.load();
  double energy = load.mass_kg * (0.5 * m.velocity_w_m_s.squaredNorm() + load.gravity_m_s2 * m.position_w_m.z()) +
                  0.5 * m.angular_velocity_b_rad_s.dot(load.inertia_b_kg_m2 * m.angular_velocity_b_rad_s);
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const double stretch_m = std::max(0.0, dynamics.pull(i, m, anchors[i]).length_m - anchors[i].unstretched_length_m);
    energy += 0.5 * load.cable.stiffness_n_m * stretch_m * stretch_m;
  }
  return energy;
}

// A load dropped into its cables: slack, taut, slack again, tumbling; nothing may push it or feed it.
TEST(LoadDynamics, DroppedIntoItsCablesOnlyLosesEnergyAndIsNeverPushed) {
  RigidLoad load = rigs::body();
  load.attachments_b_m = {{0.3, 0, 0.05}, {-0.2, 0.25, 0.05}, {-0.2, -0.25, 0.0}};
  load.cable = {2000.0, 20.0};
  const std::vector<Anchor> anchors = {anchor_at({0.5, 0, 1}, 1.2), anchor_at({-0.4, 0.5, 1}, 1.1),
                                       anchor_at({-0.4, -0.4, 1}, 1.3)};
  LoadMotion start;
  start.position_w_m.z() = 0.6;
  start.angular_velocity_b_rad_s = {1.0, -2.0, 0.5};
  auto flight = integrator(load, start, rigs::fixed(anchors));
  const LoadDynamics& dynamics = flight.dynamics();

  double energy = energy_j(dynamics, start, anchors);
  const double energy_at_start = energy;
  int transitions = 0;
  std::vector<bool> taut(anchors.size(), false);
  for (double t_s = 0.002; t_s < 10.0; t_s += 0.002) {
    advance(flight, t_s);
    const double now = energy_j(dynamics, flight.motion(), anchors);
    EXPECT_LT(now, energy + 1e-5) << t_s;
    energy = std::min(energy, now);
    for (std::size_t i = 0; i < anchors.size(); ++i) {
      const CablePull pull = dynamics.pull(i, flight.motion(), anchors[i]);
      EXPECT_GE(pull.tension_n, 0.0);
      const bool slack = pull.length_m <= anchors[i].unstretched_length_m;
      EXPECT_TRUE(!slack || pull.tension_n == 0.0);
      if ((pull.tension_n > 0.0) != taut[i]) ++transitions;
      taut[i] = pull.tension_n > 0.0;
    }
  }
  EXPECT_GT(transitions, 6) << "the test has to see cables go taut and slack";
  EXPECT_LT(energy, energy_at_start - 1.0) << "damping has to have done something";
}

TEST(LoadDynamics, ACableThatShortensFasterThanItPullsGoesSlackInsteadOfPushing) {
  const LoadDynamics dynamics(rigs::bob({1e4, 1e3}));
  const Anchor anchor = anchor_at({0, 0, 1.001}, 1.0);
  LoadMotion rising;
  EXPECT_NEAR(dynamics.pull(0, rising, anchor).tension_n, 1e4 * 0.001, 1e-9);
  rising.velocity_w_m_s.z() = 0.005;  // k (l − l0) = 10 N, c l' = −5 N
  EXPECT_NEAR(dynamics.pull(0, rising, anchor).tension_n, 5.0, 1e-9);
  rising.velocity_w_m_s.z() = 0.05;  // c l' = −50 N
  EXPECT_EQ(dynamics.pull(0, rising, anchor).tension_n, 0.0);
}

TEST(LoadDynamics, AnAnchorOnTheAttachmentPullsNowhere) {
  const LoadDynamics dynamics(rigs::bob({1e4, 1e3}));
  Surroundings surroundings;
  surroundings.anchors = {anchor_at(Vector3d::Zero(), 0.0)};
  StateVector dy;
  dynamics.derivative(dynamics.pack({}), surroundings, dy);
  EXPECT_TRUE(dy.allFinite());
}

TEST(LoadDynamics, JacobianIsTheDerivativeOfTheDerivative) {
  RigidLoad load = rigs::body();
  load.inertia_b_kg_m2(0, 1) = load.inertia_b_kg_m2(1, 0) = 0.004;
  load.attachments_b_m = {{0.3, 0, 0.05}, {-0.2, 0.25, 0.05}, {-0.2, -0.25, 0.0}};
  load.cable = {300.0, 20.0};
  const LoadDynamics dynamics(load);
  RandomStream random(7, "jacobian");
  const auto vector = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
  int slack = 0;
  for (int trial = 0; trial < 50; ++trial) {
    Surroundings surroundings;
    surroundings.force_w_n = vector();
    for (int i = 0; i < 3; ++i) {
      surroundings.anchors.push_back({Vector3d(0, 0, 2) + 0.4 * vector(), vector(), 1.3, 0.2 * random.normal()});
    }
    StateVector y;
    for (int i = 0; i < y.size(); ++i) y(i) = 0.3 * random.normal();
    y.segment<4>(6) += Eigen::Vector4d(1, 0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      if (dynamics.pull(i, dynamics.unpack(y), surroundings.anchors[i]).tension_n == 0.0) ++slack;
    }

    StateMatrix exact;
    dynamics.jacobian(y, surroundings, exact);
    for (int column = 0; column < y.size(); ++column) {
      const double h = 1e-6;
      StateVector after;
      StateVector before;
      StateVector shifted = y;
      shifted(column) = y(column) + h;
      dynamics.derivative(shifted, surroundings, after);
      shifted(column) = y(column) - h;
      dynamics.derivative(shifted, surroundings, before);
      const StateVector difference = (after - before) / (2.0 * h);
      EXPECT_LT((difference - exact.col(column)).norm(), 1e-5 * (1.0 + exact.norm())) << trial << ", " << column;
    }
  }
  EXPECT_GT(slack, 10);
  EXPECT_LT(slack, 140);
}

// Why the integrator is implicit: explicit ones crawl.
TEST(LoadDynamics, ThePapersLoadIsStiff) {
  const mechanics::Plan plan = rigs::paper();
  const LoadDynamics dynamics(rigid_load(plan));
  const SurroundingsAt planned = rigs::planned(plan, rigs::Stretch::kCompensated);
  Surroundings surroundings;
  surroundings.anchors.resize(4);
  double fastest_1_s = 0.0;
  for (double t_s = 0.0; t_s < mechanics::period_s(plan); t_s += 1.0) {
    planned(t_s, surroundings);
    StateMatrix jacobian;
    dynamics.jacobian(dynamics.pack({}), surroundings, jacobian);
    fastest_1_s = std::max(fastest_1_s, jacobian.eigenvalues().cwiseAbs().maxCoeff());
  }
  std::printf("  fastest mode of the paper's load: %.3g 1/s\n", fastest_1_s);
  EXPECT_GT(fastest_1_s, 3e4);
}

TEST(LoadIntegrator, AccuracyDoesNotDependOnWhereTheWorldHasItsZero) {
  RigidLoad near = rigs::bob({1e4, 1e3});
  RigidLoad far = near;
  far.origin_w_m = {3e5, -2e5, 1e3};
  LoadMotion start;
  start.position_w_m = {0.3, 0.0, -1.0};
  LoadMotion far_start = start;
  far_start.position_w_m += far.origin_w_m;
  auto here = integrator(near, start, rigs::fixed({anchor_at(Vector3d::Zero(), 1.0)}));
  auto there = integrator(far, far_start, rigs::fixed({anchor_at(far.origin_w_m, 1.0)}));
  advance(here, 10.0);
  advance(there, 10.0);
  EXPECT_LT((there.motion().position_w_m - far.origin_w_m - here.motion().position_w_m).norm(), 1e-5);
}

TEST(LoadIntegrator, SaysWhyItCannotGoOnAndKeepsTheMotion) {
  const RigidLoad load = rigs::bob({1e4, 1e3});
  LoadMotion start;
  start.position_w_m.z() = -1.0;
  bool broken = false;
  auto flight = integrator(load, start, [&broken](double /*t_s*/, Surroundings& out) {
    out.anchors[0] = anchor_at(Vector3d::Zero(), 1.0);
    if (broken) out.anchors[0].position_w_m.x() = std::nan("");
  });
  advance(flight, 0.1);
  const Vector3d place = flight.motion().position_w_m;
  broken = true;
  const auto failure = flight.advance_to(0.2);
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->text.find("cannot be integrated"), std::string::npos) << failure->text;
  EXPECT_EQ(flight.motion().position_w_m, place);
  EXPECT_EQ(flight.time_s(), 0.1);
  broken = false;
  advance(flight, 0.3);
  EXPECT_TRUE(flight.motion().position_w_m.allFinite());
}

}  // namespace
}  // namespace gyre::simulator
