#pragma once
// A number that knows how it changes with N others: forward derivatives, exact, through any formula that is written
// over its arithmetic.
//
//   symbol    meaning                                shape
//   value     a                                      1
//   slope     da/dx, x the N variables               N
//
//   (a + b)' = a' + b'     (a b)' = a' b + a b'     (a / b)' = (a' − (a / b) b') / b     √a' = a' / (2 √a)
//
// With it the paper's formulas, written once over Taylor<S> (taylor.hpp), give gradients of everything a carrier does
// by everything that decides it: its share of a plan is ten numbers, however many carriers there are.

#include <Eigen/Core>
#include <cmath>

namespace gyre::design {

template <int N>
struct Dual {
  using Slope = Eigen::Matrix<double, N, 1>;

  double value = 0.0;
  Slope slope = Slope::Zero();

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: a constant is a number, too
  Dual(double number, const Slope& changes) : value(number), slope(changes) {}

  /// The variable of that index.
  static Dual variable(double value, int index) { return {value, Slope::Unit(index)}; }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Dual operator*(double k, const Dual& a) { return {k * a.value, k * a.slope}; }
  friend Dual operator*(const Dual& a, double k) { return k * a; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.value;
    const double quotient = a.value * inverse;
    return {quotient, (a.slope - quotient * b.slope) * inverse};
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope * (0.5 / root)};
  }
};

}  // namespace gyre::design

namespace Eigen {
template <int N>
struct NumTraits<gyre::design::Dual<N>> : GenericNumTraits<double> {
  using Real = gyre::design::Dual<N>;
  using NonInteger = gyre::design::Dual<N>;
  using Nested = gyre::design::Dual<N>;
  // NOLINTBEGIN(readability-identifier-naming): Eigen's names
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = N,
    MulCost = 2 * N
  };
  // NOLINTEND(readability-identifier-naming)
};
}  // namespace Eigen
