#pragma once
// The quintics by which anything here goes over from one motion to another without a step in value, rate or
// acceleration.
//
//   x    progress, 0 .. 1, of what takes the time T
//   w    smooth step from 0 to 1                                             w', w'' are 0 at both ends
//   v    what is left of a gap of 1 in value                                 v(0) = 1
//   s    what is left of a gap of 1 in slope                                 s'(0) = 1
//   c    what is left of a gap of 1 in curvature                             c''(0) = 1
//        of v, s and c everything else is 0 at both ends: value, slope, curvature (Hermite's basis)
//
//   w = 10x³ − 15x⁴ + 6x⁵          v = 1 − w          s = x − 6x³ + 8x⁴ − 3x⁵          c = (x² − 3x³ + 3x⁴ − x⁵) / 2
//
//   e(t) = e0 v(x) + e0' T s(x) + e0'' T² c(x)        closes a gap in value, rate and acceleration        x = (t − t0)
//   / T

#include <algorithm>

#include "common/mechanics/taylor.hpp"

namespace gyre::mechanics {

/// x with its derivatives, held at 1 from the end on. Before the start it is that of the start, pace and all: w and v
/// are at rest there, and of s nothing has been used up. `duration_s` > 0.
[[nodiscard]] inline Taylor<double> progress(double elapsed_s, double duration_s) {
  if (elapsed_s >= duration_s) return constant(1.0);
  const double pace = 1.0 / duration_s;
  return {std::max(0.0, elapsed_s) * pace, pace, 0.0};
}

template <class S>
[[nodiscard]] inline Taylor<S> smooth_step(const Taylor<S>& x) {
  const Taylor<S> square = x * x;
  return square * x * (constant(S(10)) - 15.0 * x + 6.0 * square);
}

/// w of something that began `elapsed_s` ago and takes `duration_s`; 0 before and 1 after.
[[nodiscard]] inline Taylor<double> smooth_step(double elapsed_s, double duration_s) {
  return smooth_step(progress(elapsed_s, duration_s));
}

/// The integral of the smooth step from 0 to x.
[[nodiscard]] constexpr double smooth_step_integral(double x) {
  return x * x * x * x * (2.5 + x * (-3.0 + x));
}

template <class S>
[[nodiscard]] inline Taylor<S> value_left(const Taylor<S>& x) {
  return constant(S(1)) - smooth_step(x);
}

template <class S>
[[nodiscard]] inline Taylor<S> slope_left(const Taylor<S>& x) {
  const Taylor<S> square = x * x;
  return x - square * x * (constant(S(6)) - 8.0 * x + 3.0 * square);
}

template <class S>
[[nodiscard]] inline Taylor<S> curvature_left(const Taylor<S>& x) {
  const Taylor<S> square = x * x;
  return 0.5 * (square * (constant(S(1)) - x * (constant(S(3)) - 3.0 * x + square)));
}

/// The integrals of v, s and c from 0 to x.
[[nodiscard]] constexpr double value_left_integral(double x) {
  return x - smooth_step_integral(x);
}
[[nodiscard]] constexpr double slope_left_integral(double x) {
  return x * x * (0.5 + x * x * (-1.5 + x * (1.6 - 0.5 * x)));
}
[[nodiscard]] constexpr double curvature_left_integral(double x) {
  return x * x * x * (1.0 / 6.0 + x * (-0.375 + x * (0.3 - x / 12.0)));
}

/// The greatest |w'| = |v'|, at x = 1/2.
inline constexpr double kStepSlopePeak = 15.0 / 8.0;
/// The greatest |w''| = |v''|: 10 / √3.
inline constexpr double kStepCurvaturePeak = 5.77350269189625765;
/// s' falls from 1 to −64/125, at x = 3/5, before it fades: what was not travelled is made up for.
inline constexpr double kSlopeLeftReturnPeak = 64.0 / 125.0;
/// The greatest |s''|: (224 + 152 √19) / 225.
inline constexpr double kSlopeLeftCurvaturePeak = 3.94023395296969947;

}  // namespace gyre::mechanics
