// Extremes of quotients of trigonometric polynomials against brute force, and the algebra against pointwise arithmetic.

#include "common/mechanics/extremes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

using Complex = TrigPolynomial::Complex;

Complex unit(double psi) {
  return std::polar(1.0, psi);
}

TrigPolynomial random_polynomial(int degree) {
  TrigPolynomial p(real(-2.0, 2.0));
  for (int k = 1; k <= degree; ++k) p += TrigPolynomial::sine(real(-2.0, 2.0), k, real(-kPi, kPi));
  return p;
}

/// Positive everywhere, but as close to zero as `margin` of its mean.
TrigPolynomial random_positive(int degree, double margin) {
  TrigPolynomial p;
  double swing = 0.0;
  for (int k = 1; k <= degree; ++k) {
    const double amplitude = real(-1.0, 1.0);
    swing += std::abs(amplitude);
    p += TrigPolynomial::sine(amplitude, k, real(-kPi, kPi));
  }
  return p + TrigPolynomial((1.0 + margin) * (swing + 0.1));
}

/// Dense sampling; between samples F can rise by no more than its greatest second difference.
struct Sampled {
  Range range;
  double curvature = 0.0;
};

template <class Function>
Sampled sampled(const Function& f, int count) {
  Sampled out;
  const double step = 2.0 * kPi / count;
  double before = f(-step);
  double at = f(0.0);
  for (int i = 0; i < count; ++i) {
    const double after = f(step * (i + 1));
    out.range.include(at);
    out.curvature = std::max(out.curvature, std::abs(after - 2.0 * at + before));
    before = at;
    at = after;
  }
  return out;
}

/// Never inside the samples, and never further outside than sampling can have missed.
void check_holds(const Range& exact, const Sampled& s) {
  const double size = std::max(std::abs(s.range.min), std::abs(s.range.max));
  RC_ASSERT(exact.min <= s.range.min + 1e-13 * size);
  RC_ASSERT(exact.max >= s.range.max - 1e-13 * size);
  RC_ASSERT(exact.min >= s.range.min - s.curvature - 1e-12 * size);
  RC_ASSERT(exact.max <= s.range.max + s.curvature + 1e-12 * size);
}

RC_GTEST_PROP(Polynomial, arithmetic_is_pointwise, ()) {
  const TrigPolynomial a = random_polynomial(static_cast<int>(whole(0, 7)));
  const TrigPolynomial b = random_polynomial(static_cast<int>(whole(0, 7)));
  const Complex z = unit(real(-10.0, 10.0));
  const double scale = (1.0 + a.bound()) * (1.0 + b.bound());
  const auto same = [&](double x, double y) { return std::abs(x - y) < 1e-13 * scale; };
  RC_ASSERT(same((a + b).value(z), a.value(z) + b.value(z)));
  RC_ASSERT(same((a - b).value(z), a.value(z) - b.value(z)));
  RC_ASSERT(same((a * b).value(z), a.value(z) * b.value(z)));
  RC_ASSERT(same((-1.5 * a).value(z), -1.5 * a.value(z)));
  RC_ASSERT(same(a.jet(z).value, a.value(z)));
  RC_ASSERT((a * b).degree() == a.degree() + b.degree());
}

RC_GTEST_PROP(Polynomial, a_sine_is_a_sine, ()) {
  const double amplitude = real(-3.0, 3.0);
  const int harmonic = static_cast<int>(whole(1, 9));
  const double phase = real(-kPi, kPi);
  const double psi = real(-10.0, 10.0);
  const double value = TrigPolynomial::sine(amplitude, harmonic, phase).value(unit(psi));
  RC_ASSERT(std::abs(value - amplitude * std::sin(harmonic * psi + phase)) < 1e-13);
}

RC_GTEST_PROP(Polynomial, the_derivative_is_the_slope_and_obeys_the_product_rule, ()) {
  const TrigPolynomial a = random_polynomial(5);
  const TrigPolynomial b = random_polynomial(3);
  const double psi = real(-kPi, kPi);
  const double h = 1e-4;
  const double difference = (a.value(unit(psi + h)) - a.value(unit(psi - h))) / (2.0 * h);
  RC_ASSERT(std::abs(a.derivative().value(unit(psi)) - difference) < 1e-5);
  RC_ASSERT(std::abs(a.derivative().value(unit(psi)) - a.jet(unit(psi)).slope) < 1e-12);
  const TrigPolynomial rule = a.derivative() * b + a * b.derivative() - (a * b).derivative();
  RC_ASSERT(rule.bound() < 1e-12 * (1.0 + a.bound()) * (1.0 + b.bound()) * 8.0);
}

RC_GTEST_PROP(Polynomial, its_bounds_hold_and_trimming_removes_rounding_only, ()) {
  const TrigPolynomial a = random_polynomial(6);
  const Complex z = unit(real(-kPi, kPi));
  RC_ASSERT(std::abs(a.value(z)) <= a.bound() * (1.0 + 1e-14));
  RC_ASSERT(std::abs(a.derivative().value(z)) <= a.bound(1) * (1.0 + 1e-14));
  RC_ASSERT(std::abs(a.derivative().derivative().value(z)) <= a.bound(2) * (1.0 + 1e-14));
  const TrigPolynomial noisy = a + TrigPolynomial::sine(1e-17 * a.bound(), 9, 1.0);
  RC_ASSERT(noisy.degree() == 9);
  RC_ASSERT(noisy.trimmed(a.bound()).degree() <= 6);
  RC_ASSERT(std::abs(noisy.trimmed(a.bound()).value(z) - a.value(z)) < 1e-13 * a.bound());
}

RC_GTEST_PROP(Extremes, of_random_quotients_are_those_of_brute_force, ()) {
  const TrigPolynomial n = random_polynomial(static_cast<int>(whole(0, 5)));
  const double margin = std::pow(10.0, real(-2.0, 0.5));
  const TrigPolynomial d = random_positive(static_cast<int>(whole(1, 3)), margin);
  const TrigPolynomial e = random_positive(static_cast<int>(whole(1, 2)), margin);
  const int p = static_cast<int>(whole(0, 8)) - 6;
  const int q = static_cast<int>(whole(0, 4)) - 3;
  const Range exact = extremes(n, {{&d, extremes(d), p}, {&e, extremes(e), q}});
  check_holds(exact, sampled(
                         [&](double psi) {
                           const Complex z = unit(psi);
                           return n.value(z) * std::pow(d.value(z), 0.5 * p) * std::pow(e.value(z), 0.5 * q);
                         },
                         20000));
}

RC_GTEST_PROP(Extremes, of_high_degrees_are_those_of_brute_force, ()) {
  const TrigPolynomial n = random_polynomial(static_cast<int>(whole(20, 40)));
  check_holds(extremes(n), sampled([&](double psi) { return n.value(unit(psi)); }, 40000));
}

RC_GTEST_PROP(Extremes, a_square_that_touches_zero_is_found_to_touch_it, ()) {
  // (r − 1)² (...)²: minimum and critical point meet in a double root of the function.
  const double root = real(-kPi, kPi);
  const TrigPolynomial touching = TrigPolynomial(1.0) - TrigPolynomial::sine(1.0, 1, 0.5 * kPi - root);  // 1 − cos
  const TrigPolynomial square = touching * touching * random_positive(2, 0.5);
  const Range exact = extremes(square);
  RC_ASSERT(std::abs(exact.min) <= 2e-13 * exact.max);
}

RC_GTEST_PROP(Extremes, where_critical_points_meet_none_is_lost, ()) {
  // sin + (1/2)(1 + e) sin 2: two critical points join in an inflection at e = 0 and vanish on one side of it.
  const double e = std::pow(10.0, real(-14.0, -1.0)) * (whole(0, 1) == 0 ? 1.0 : -1.0);
  const double phase = real(-kPi, kPi);
  const TrigPolynomial n = TrigPolynomial::sine(1.0, 1, phase) + TrigPolynomial::sine(-0.5 * (1.0 + e), 2, 2.0 * phase);
  check_holds(extremes(n), sampled([&](double psi) { return n.value(unit(psi)); }, 20000));
}

RC_GTEST_PROP(Extremes, of_a_constant_are_the_constant_to_the_bit, ()) {
  const double value = real(-5.0, 5.0);
  const Range exact = extremes(TrigPolynomial(value));
  RC_ASSERT(exact.min == value);
  RC_ASSERT(exact.max == value);
}

RC_GTEST_PROP(Extremes, of_what_is_constant_by_algebra_stay_within_rounding, ()) {
  // N = D^2 over D^(4/2): constant, but nothing in the coefficients says so.
  const TrigPolynomial d = random_positive(static_cast<int>(whole(1, 3)), real(0.1, 2.0));
  const double value = real(0.1, 5.0);
  const Range exact = extremes(value * (d * d), {{&d, extremes(d), -4}});
  RC_ASSERT(std::abs(exact.min / value - 1.0) < 1e-12);
  RC_ASSERT(std::abs(exact.max / value - 1.0) < 1e-12);
}

RC_GTEST_PROP(Extremes, of_what_is_almost_constant_keep_its_swing, ()) {
  const double swing = std::pow(10.0, real(-9.0, -3.0));
  const Range exact = extremes(TrigPolynomial(1.0) + TrigPolynomial::sine(swing, static_cast<int>(whole(1, 5)), 0.7));
  RC_ASSERT(std::abs(exact.span() - 2.0 * swing) < 1e-12);
}

RC_GTEST_PROP(Extremes, a_peak_too_narrow_for_sampling_is_found, ()) {
  // 1 / (1 + m − cos)^k peaks at 1 / m^k within about sqrt(m) of the root.
  const double m = std::pow(10.0, real(-6.0, -2.0));
  const double root = real(-kPi, kPi);
  const TrigPolynomial d = TrigPolynomial(1.0 + m) - TrigPolynomial::sine(1.0, 1, 0.5 * kPi - root);
  const Range exact = extremes(TrigPolynomial(1.0), {{&d, extremes(d), -4}});
  RC_ASSERT(std::abs(exact.max * m * m - 1.0) < 1e-8);
  RC_ASSERT(std::abs(exact.min - 1.0 / ((2.0 + m) * (2.0 + m))) < 2e-13 * exact.max);  // rounding of the peak
}

}  // namespace
}  // namespace gyre::mechanics::test
