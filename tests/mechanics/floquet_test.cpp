// Floquet multipliers against what is known without them: constant coefficients, Mathieu's equation, another
// integrator.

#include "common/mechanics/floquet.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

using MomentAt = std::function<LinearMoment(double t_s)>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

double growth(const Matrix6d& inertia, const MomentAt& at, double period_s, std::size_t steps, double pace = 1.0) {
  std::vector<LinearMoment> moments;
  for (std::size_t k = 0; k < steps; ++k) {
    for (const double node : radau_nodes()) {
      moments.push_back(at(period_s * (static_cast<double>(k) + node) / static_cast<double>(steps)));
    }
  }
  return floquet_growth(inertia, moments, period_s, pace);
}

/// (x, x')' = A (x, x')
Matrix12d first_order(const Matrix6d& inertia, const LinearMoment& m, double pace) {
  Matrix12d a = Matrix12d::Zero();
  a.topRightCorner<6, 6>().setIdentity();
  a.bottomLeftCorner<6, 6>() = -inertia.inverse() * (m.stiffness + pace * m.circulation);
  a.bottomRightCorner<6, 6>() = -inertia.inverse() * m.damping;
  return a;
}

/// By the classical Runge-Kutta method: another integrator, explicit, for what is not stiff.
double growth_by_runge_kutta(const Matrix6d& inertia, const MomentAt& at, double period_s, int steps, double pace) {
  Matrix12d phi = Matrix12d::Identity();
  const double h = period_s / pace / steps;
  for (int k = 0; k < steps; ++k) {
    const auto a = [&](double part) { return first_order(inertia, at(period_s * (k + part) / steps), pace); };
    const Matrix12d k1 = a(0.0) * phi;
    const Matrix12d k2 = a(0.5) * (phi + 0.5 * h * k1);
    const Matrix12d k3 = a(0.5) * (phi + 0.5 * h * k2);
    const Matrix12d k4 = a(1.0) * (phi + h * k3);
    phi += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return std::log(phi.eigenvalues().cwiseAbs().maxCoeff()) / (period_s / pace);
}

Matrix6d random_matrix(double size) {
  Matrix6d m;
  for (int i = 0; i < 36; ++i) m(i / 6, i % 6) = real(-size, size);
  return m;
}

Matrix6d random_positive(double least) {
  const Matrix6d m = random_matrix(1.0);
  return m * m.transpose() + least * Matrix6d::Identity();
}

RC_GTEST_PROP(Floquet, constant_coefficients_grow_by_their_eigenvalues, ()) {
  const Matrix6d inertia = random_positive(0.3);
  const double pace = real(0.3, 1.5);
  LinearMoment m;
  m.stiffness = random_positive(0.0) - real(0.0, 2.0) * Matrix6d::Identity();
  m.damping = random_positive(0.0) * real(0.0, 0.5);
  m.circulation = random_matrix(0.3);
  const double known = first_order(inertia, m, pace).eigenvalues().real().maxCoeff();
  const double found = growth(
      inertia, [&m](double) { return m; }, 3.0, 300, pace);
  RC_ASSERT(std::abs(found - known) < 1e-6 * (1.0 + std::abs(known)));
}

RC_GTEST_PROP(Floquet, periodic_coefficients_grow_as_another_integrator_has_it, ()) {
  const Matrix6d inertia = random_positive(0.5);
  const LinearMoment mean{random_positive(0.5), 0.2 * random_positive(0.0), random_matrix(0.2)};
  const LinearMoment swing{0.6 * random_matrix(1.0), 0.1 * random_matrix(1.0), random_matrix(0.2)};
  const double pace = real(0.3, 1.5);
  const double period_s = real(1.0, 4.0);
  const auto at = [&](double t_s) {
    const double s = std::sin(kTwoPi * t_s / period_s);
    return LinearMoment{mean.stiffness + s * swing.stiffness, mean.damping + s * swing.damping,
                        mean.circulation + s * swing.circulation};
  };
  const double other = growth_by_runge_kutta(inertia, at, period_s, 3000, pace);
  RC_ASSERT(std::abs(growth(inertia, at, period_s, 300, pace) - other) < 1e-6 * (1.0 + std::abs(other)));
}

/// x'' + (a − 2 q cos 2t) x = 0, six times.
MomentAt mathieu(double a, double q) {
  return [a, q](double t_s) {
    return LinearMoment{(a - 2.0 * q * std::cos(2.0 * t_s)) * Matrix6d::Identity(), Matrix6d::Zero(), Matrix6d::Zero()};
  };
}

TEST(Floquet, mathieus_equation_has_its_textbook_tongues) {
  const Matrix6d one = Matrix6d::Identity();
  // In the middle of the first, a = 1, the exponent is q/2 for small q; its edges are at a = 1 ± q.
  for (const double q : {0.01, 0.05, 0.1}) {
    EXPECT_NEAR(growth(one, mathieu(1.0, q), kPi, 200), 0.5 * q, 0.2 * q * q);
    EXPECT_NEAR(growth(one, mathieu(1.0 + 1.2 * q, q), kPi, 200), 0.0, 1e-9);
    EXPECT_NEAR(growth(one, mathieu(1.0 - 1.2 * q, q), kPi, 200), 0.0, 1e-9);
    EXPECT_GT(growth(one, mathieu(1.0 + 0.8 * q, q), kPi, 200), 0.1 * q);
  }
  // An upside-down pendulum whose pivot shakes stands: a < 0, and above −q²/2.
  EXPECT_NEAR(growth(one, mathieu(-0.05, 0.5), kPi, 200), 0.0, 1e-9);
  EXPECT_GT(growth(one, mathieu(-0.2, 0.5), kPi, 200), 0.1);
}

TEST(Floquet, errors_shrink_with_the_fifth_power_of_the_step) {
  const Matrix6d one = Matrix6d::Identity();
  const auto at = mathieu(6.0, 2.5);
  const double exact = growth(one, at, kPi, 2000);
  const double coarse = std::abs(growth(one, at, kPi, 16) - exact);
  const double fine = std::abs(growth(one, at, kPi, 32) - exact);
  EXPECT_GT(coarse, 16.0 * fine);
  EXPECT_GT(fine, 0.0);
}

TEST(Floquet, what_is_stiff_dies_out_and_hides_nothing) {
  // One freedom of six is a pendulum; the others' rates are up to a million times its own.
  Matrix6d inertia = Matrix6d::Identity();
  LinearMoment m;
  m.stiffness.diagonal() << 1.0, 1e4, 1e5, 1e6, 1e4, 1e8;
  m.damping.diagonal() << 0.002, 1e3, 1e6, 1e3, 1e4, 1e4;
  EXPECT_NEAR(growth(
                  inertia, [&m](double) { return m; }, 20.0, 100),
              -0.001, 1e-6);
  // Where everything is, nothing is lost in rounding, however long the period: the slowest is k/c = 0.1.
  m.stiffness.diagonal() << 1e5, 1e5, 1e5, 1e5, 1e5, 1e5;
  m.damping.diagonal() << 1e6, 1e6, 1e6, 1e6, 1e6, 1e6;
  EXPECT_NEAR(growth(
                  inertia, [&m](double) { return m; }, 1e5, 1e5),
              -0.1, 1e-3);
}

TEST(Floquet, what_is_no_number_grows_by_none) {
  LinearMoment m;
  m.stiffness(2, 3) = std::nan("");
  EXPECT_TRUE(std::isnan(growth(
      Matrix6d::Identity(), [&m](double) { return m; }, 1.0, 10)));
}

}  // namespace
}  // namespace gyre::mechanics::test
