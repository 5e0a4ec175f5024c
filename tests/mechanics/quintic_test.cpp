// The quintics against their laws: what they are at both ends, their derivatives against differences, their peaks.

#include "common/mechanics/quintic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gyre::mechanics {
namespace {

using Number = Taylor<double>;
using Quintic = Number (*)(const Number&);

constexpr Quintic kStep = [](const Number& x) { return smooth_step(x); };
constexpr Quintic kAll[] = {kStep, value_left<double>, slope_left<double>, curvature_left<double>};

Number at(Quintic quintic, double x) {
  return quintic(Number{x, 1.0, 0.0});
}
void expect_near(const Number& a, const Number& b, double within) {
  EXPECT_NEAR(a.value, b.value, within);
  EXPECT_NEAR(a.first, b.first, within);
  EXPECT_NEAR(a.second, b.second, within);
}

/// The greatest that `figure` is over [0, 1].
template <class Figure>
double greatest(Figure figure) {
  constexpr int kCount = 100'000;
  double most = figure(0.0);
  for (int i = 1; i <= kCount; ++i) most = std::max(most, figure(static_cast<double>(i) / kCount));
  return most;
}

TEST(Quintic, it_begins_with_what_it_is_of_and_nothing_else) {
  expect_near(at(kStep, 0.0), {0.0, 0.0, 0.0}, 0.0);
  expect_near(at(value_left, 0.0), {1.0, 0.0, 0.0}, 0.0);
  expect_near(at(slope_left, 0.0), {0.0, 1.0, 0.0}, 0.0);
  expect_near(at(curvature_left, 0.0), {0.0, 0.0, 1.0}, 0.0);
}

TEST(Quintic, it_ends_with_nothing_left) {
  expect_near(at(kStep, 1.0), {1.0, 0.0, 0.0}, 1e-13);
  expect_near(at(value_left, 1.0), {0.0, 0.0, 0.0}, 1e-13);
  expect_near(at(slope_left, 1.0), {0.0, 0.0, 0.0}, 1e-13);
  expect_near(at(curvature_left, 1.0), {0.0, 0.0, 0.0}, 1e-13);
}

TEST(Quintic, it_is_one) {  // sixth differences of polynomials of degree 5 are zero, and fifth ones are not
  constexpr double kPitch = 0.125;
  for (const Quintic quintic : kAll) {
    const auto difference = [quintic](const std::vector<double>& weights) {
      double sum = 0.0;
      for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] * at(quintic, kPitch * static_cast<double>(i)).value;
      return sum;
    };
    EXPECT_NEAR(difference({1, -6, 15, -20, 15, -6, 1}), 0.0, 1e-13);
    EXPECT_GT(std::abs(difference({-1, 5, -10, 10, -5, 1})), 1e-4);
  }
}

TEST(Quintic, its_derivatives_are_its_own) {
  const double h = 1e-4;
  for (const Quintic quintic : kAll) {
    for (double x = h; x < 1.0 - h; x += 0.01) {
      const Number before = at(quintic, x - h);
      const Number after = at(quintic, x + h);
      EXPECT_NEAR((after.value - before.value) / (2.0 * h), at(quintic, x).first, 1e-6) << x;
      EXPECT_NEAR((after.first - before.first) / (2.0 * h), at(quintic, x).second, 1e-5) << x;
    }
  }
}

TEST(Quintic, the_step_only_rises_and_is_the_same_backwards) {
  double before = 0.0;
  for (double x = 0.01; x < 1.0; x += 0.01) {
    EXPECT_GT(at(kStep, x).value, before);
    EXPECT_NEAR(at(kStep, x).value + at(kStep, 1.0 - x).value, 1.0, 1e-14);
    before = at(kStep, x).value;
  }
}

TEST(Quintic, the_integrals_grow_as_what_they_are_of) {
  using Integral = double (*)(double);
  const std::pair<Quintic, Integral> pairs[] = {{kStep, smooth_step_integral},
                                                {value_left, value_left_integral},
                                                {slope_left, slope_left_integral},
                                                {curvature_left, curvature_left_integral}};
  const double h = 1e-4;
  for (const auto& [quintic, integral] : pairs) {
    EXPECT_EQ(integral(0.0), 0.0);
    for (double x = h; x < 1.0 - h; x += 0.01) {
      EXPECT_NEAR((integral(x + h) - integral(x - h)) / (2.0 * h), at(quintic, x).value, 1e-7) << x;
    }
  }
  EXPECT_NEAR(smooth_step_integral(1.0), 0.5, 1e-15);
}

TEST(Quintic, its_peaks_are_attained_and_never_passed) {
  const auto slope = [](double x) { return std::abs(at(kStep, x).first); };
  const auto curvature = [](double x) { return std::abs(at(kStep, x).second); };
  const auto going_back = [](double x) { return -at(slope_left, x).first; };
  const auto slowing = [](double x) { return std::abs(at(slope_left, x).second); };
  EXPECT_NEAR(greatest(slope), kStepSlopePeak, 1e-8);
  EXPECT_NEAR(greatest(curvature), kStepCurvaturePeak, 1e-8);
  EXPECT_NEAR(greatest(going_back), kSlopeLeftReturnPeak, 1e-8);
  EXPECT_NEAR(greatest(slowing), kSlopeLeftCurvaturePeak, 1e-8);
}

TEST(Progress, it_is_held_outside_its_window) {
  for (const double t_s : {-1e9, -1e-9, 0.0}) {
    EXPECT_EQ(progress(t_s, 3.0).value, 0.0);
    expect_near(smooth_step(t_s, 3.0), {0.0, 0.0, 0.0}, 0.0);
  }
  for (const double t_s : {3.0, 3.1, 1e9}) {
    expect_near(progress(t_s, 3.0), {1.0, 0.0, 0.0}, 0.0);
    expect_near(smooth_step(t_s, 3.0), {1.0, 0.0, 0.0}, 0.0);
  }
}

TEST(Progress, a_gap_closes_from_what_it_was_on_its_own_clock) {
  const double duration_s = 4.0;
  const Number gap{0.3, -0.7, 1.1};
  const auto left = [&](double t_s) {
    const Number x = progress(t_s, duration_s);
    return gap.value * value_left(x) + (gap.first * duration_s) * slope_left(x) +
           (gap.second * duration_s * duration_s) * curvature_left(x);
  };
  expect_near(left(0.0), gap, 1e-15);
  expect_near(left(duration_s), {0.0, 0.0, 0.0}, 1e-12);
}

TEST(Progress, an_early_reversal_costs_almost_nothing) {
  // 5 % of the duration late is 0.1 % of the change.
  EXPECT_NEAR(smooth_step(0.05, 1.0).value, 1e-3, 2e-4);
}

}  // namespace
}  // namespace gyre::mechanics
