#pragma once
// Truncated Taylor arithmetic: a quantity travels with its first and second time derivative, so the paper's formulas
// are written once, as they stand in the paper, and every derivative of them is exact.
//
// S is the arithmetic underneath: double to fly, an interval to prove bounds (transition_figures.cpp).
//
//   a·b   (ab)' = a'b + ab'       (ab)'' = a''b + 2a'b' + ab''
//   a/b   c = a/b                 c' = (a' − c b')/b        c'' = (a'' − 2c'b' − c b'')/b
//   √a    r = √a                  r' = a'/(2r)              r'' = (a''/2 − r'²)/r

#include <Eigen/Core>
#include <cmath>

namespace gyre::mechanics {

template <class S>
struct Taylor {
  S value{};
  S first{};   // d/dt
  S second{};  // d²/dt²
};

template <class S>
struct TaylorVector {
  using Vector = Eigen::Matrix<S, 3, 1>;
  Vector value = Vector::Constant(S(0));
  Vector first = Vector::Constant(S(0));
  Vector second = Vector::Constant(S(0));
};

template <class S>
[[nodiscard]] inline Taylor<S> constant(const S& value) {
  return {value, S(0), S(0)};
}

template <class S>
[[nodiscard]] inline TaylorVector<S> constant_vector(const Eigen::Vector3d& v) {
  TaylorVector<S> out;
  for (int i = 0; i < 3; ++i) out.value[i] = S(v[i]);
  return out;
}

template <class S>
[[nodiscard]] inline Taylor<S> operator+(const Taylor<S>& a, const Taylor<S>& b) {
  return {S(a.value + b.value), S(a.first + b.first), S(a.second + b.second)};
}

template <class S>
[[nodiscard]] inline Taylor<S> operator-(const Taylor<S>& a, const Taylor<S>& b) {
  return {S(a.value - b.value), S(a.first - b.first), S(a.second - b.second)};
}

template <class S>
[[nodiscard]] inline Taylor<S> operator*(const Taylor<S>& a, const Taylor<S>& b) {
  return {S(a.value * b.value), S(a.first * b.value + a.value * b.first),
          S(a.second * b.value + 2.0 * a.first * b.first + a.value * b.second)};
}

template <class S>
[[nodiscard]] inline Taylor<S> operator*(double k, const Taylor<S>& a) {
  return {S(k * a.value), S(k * a.first), S(k * a.second)};
}

template <class S>
[[nodiscard]] inline Taylor<S> operator/(const Taylor<S>& a, const Taylor<S>& b) {
  const S inverse = 1.0 / b.value;
  const S c = a.value * inverse;
  const S c1 = (a.first - c * b.first) * inverse;
  return {c, c1, S((a.second - 2.0 * c1 * b.first - c * b.second) * inverse)};
}

template <class S>
[[nodiscard]] inline Taylor<S> sqrt(const Taylor<S>& a) {
  using std::sqrt;
  const S r = sqrt(a.value);
  const S inverse = 1.0 / r;
  const S r1 = 0.5 * a.first * inverse;
  return {r, r1, S((0.5 * a.second - r1 * r1) * inverse)};
}

template <class S>
[[nodiscard]] inline TaylorVector<S> operator+(const TaylorVector<S>& a, const TaylorVector<S>& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

template <class S>
[[nodiscard]] inline TaylorVector<S> operator-(const TaylorVector<S>& a, const TaylorVector<S>& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}

/// A scalar that moves along a direction that does not.
template <class S>
[[nodiscard]] inline TaylorVector<S> operator*(const Taylor<S>& k, const Eigen::Vector3d& v) {
  TaylorVector<S> out;
  for (int i = 0; i < 3; ++i) {
    out.value[i] = k.value * v[i];
    out.first[i] = k.first * v[i];
    out.second[i] = k.second * v[i];
  }
  return out;
}

template <class S>
[[nodiscard]] inline TaylorVector<S> operator*(const Taylor<S>& k, const TaylorVector<S>& v) {
  TaylorVector<S> out;
  for (int i = 0; i < 3; ++i) {
    out.value[i] = k.value * v.value[i];
    out.first[i] = k.first * v.value[i] + k.value * v.first[i];
    out.second[i] = k.second * v.value[i] + 2.0 * k.first * v.first[i] + k.value * v.second[i];
  }
  return out;
}

template <class S>
[[nodiscard]] inline TaylorVector<S> operator/(const TaylorVector<S>& v, const Taylor<S>& k) {
  return (constant(S(1)) / k) * v;
}

template <class S>
[[nodiscard]] inline Taylor<S> dot(const TaylorVector<S>& a, const TaylorVector<S>& b) {
  Taylor<S> out = constant(S(0));
  for (int i = 0; i < 3; ++i) {
    out = out + Taylor<S>{a.value[i], a.first[i], a.second[i]} * Taylor<S>{b.value[i], b.first[i], b.second[i]};
  }
  return out;
}

template <class S>
[[nodiscard]] inline Taylor<S> dot(const Eigen::Vector3d& a, const TaylorVector<S>& b) {
  Taylor<S> out = constant(S(0));
  for (int i = 0; i < 3; ++i) out = out + a[i] * Taylor<S>{b.value[i], b.first[i], b.second[i]};
  return out;
}

/// |v|, where a square has to stay one: intervals know a² >= 0 only when they are told it is a square.
template <class S>
[[nodiscard]] inline Taylor<S> norm(const TaylorVector<S>& v) {
  return sqrt(dot(v, v));
}

/// The same quantity when its clock tau passes at `pace` = d tau / dt, which changes by `rate`: x' = pace x_tau,
/// x'' = pace² x_tautau + pace' x_tau.
template <class Quantity>
[[nodiscard]] inline Quantity paced(const Quantity& x, double pace, double rate) {
  Quantity out = x;
  out.first = pace * x.first;
  out.second = pace * pace * x.second + rate * x.first;
  return out;
}

/// What whoever follows with a first-order lag T, y' = (asked − y) / T, has to be asked for to do x: x + T x', and its
/// rate. The second derivative stays that of x; the one after it, which would belong there, is not carried. It matters
/// to whoever extrapolates: over a hundredth of a second by nothing.
template <class Quantity>
[[nodiscard]] inline Quantity led(const Quantity& x, double lag_s) {
  Quantity out = x;
  out.value = x.value + lag_s * x.first;
  out.first = x.first + lag_s * x.second;
  return out;
}

}  // namespace gyre::mechanics
