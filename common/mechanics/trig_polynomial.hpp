#pragma once
// Trigonometric polynomials: the algebra in which every figure of a periodic motion can be written exactly.
//
//   T(psi) = sum over k = −N..N of c_k z^k,   z = exp(i psi),   c_(−k) = conj(c_k)         (real for real psi)
//
// Sums, products and derivatives of such polynomials are such polynomials, so numerators and denominators of tensions,
// lengths, speeds and accelerations come out of ordinary arithmetic.

#include <boost/container/small_vector.hpp>
#include <complex>
#include <cstddef>

namespace gyre::mechanics {

class TrigPolynomial {
 public:
  using Complex = std::complex<double>;

  TrigPolynomial() : TrigPolynomial(0.0) {}
  explicit TrigPolynomial(double constant) : c_(1, Complex(constant, 0.0)) {}

  /// amplitude · sin(harmonic · psi + phase_rad), harmonic >= 1.
  static TrigPolynomial sine(double amplitude, int harmonic, double phase_rad);

  [[nodiscard]] int degree() const { return static_cast<int>(c_.size()) - 1; }
  /// At psi = arg z, |z| = 1.
  [[nodiscard]] double value(const Complex& z) const;
  /// Value and derivative together.
  struct Jet {
    double value, slope;
  };
  [[nodiscard]] Jet jet(const Complex& z) const;

  [[nodiscard]] TrigPolynomial derivative() const;
  /// A bound of |T^(order)| that holds for every psi.
  [[nodiscard]] double bound(int order = 0) const;
  /// Without the leading coefficients that are rounding: products that cancel by algebra leave them behind, and a
  /// lower degree means fewer roots to look for. `scale` is the size of what cancelled.
  [[nodiscard]] TrigPolynomial trimmed(double scale) const;

  TrigPolynomial& operator+=(const TrigPolynomial& other);
  TrigPolynomial& operator-=(const TrigPolynomial& other);
  TrigPolynomial& operator*=(double k);
  friend TrigPolynomial operator*(const TrigPolynomial& a, const TrigPolynomial& b);

 private:
  boost::container::small_vector<Complex, 12> c_;  // k = 0..N
};

inline TrigPolynomial operator+(TrigPolynomial a, const TrigPolynomial& b) {
  return a += b;
}
inline TrigPolynomial operator-(TrigPolynomial a, const TrigPolynomial& b) {
  return a -= b;
}
inline TrigPolynomial operator*(double k, TrigPolynomial a) {
  return a *= k;
}
TrigPolynomial operator*(const TrigPolynomial& a, const TrigPolynomial& b);

}  // namespace gyre::mechanics
