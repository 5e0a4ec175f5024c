#include "common/mechanics/trig_polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace gyre::mechanics {

TrigPolynomial TrigPolynomial::sine(double amplitude, int harmonic, double phase_rad) {
  TrigPolynomial t;
  t.c_.resize(static_cast<std::size_t>(harmonic) + 1);
  // a sin(k psi + phase) = (a / 2i) e^(i phase) z^k + its conjugate
  t.c_.back() = 0.5 * amplitude * Complex(std::sin(phase_rad), -std::cos(phase_rad));
  return t;
}

double TrigPolynomial::value(const Complex& z) const {
  Complex sum(0.0, 0.0);
  for (std::size_t k = c_.size() - 1; k > 0; --k) sum = (sum + c_[k]) * z;
  return c_[0].real() + 2.0 * sum.real();
}

TrigPolynomial::Jet TrigPolynomial::jet(const Complex& z) const {
  // d/dpsi z^k = i k z^k, and Re(i w) = −Im(w).
  Complex sum(0.0, 0.0);
  Complex slope(0.0, 0.0);
  for (std::size_t k = c_.size() - 1; k > 0; --k) {
    sum = (sum + c_[k]) * z;
    slope = (slope + static_cast<double>(k) * c_[k]) * z;
  }
  return {c_[0].real() + 2.0 * sum.real(), -2.0 * slope.imag()};
}

TrigPolynomial TrigPolynomial::derivative() const {
  TrigPolynomial out = *this;
  for (std::size_t k = 0; k < c_.size(); ++k) out.c_[k] = Complex(0.0, static_cast<double>(k)) * c_[k];
  return out;
}

double TrigPolynomial::bound(int order) const {
  double sum = order == 0 ? std::abs(c_[0]) : 0.0;
  for (std::size_t k = 1; k < c_.size(); ++k) {
    double weight = 2.0;
    for (int i = 0; i < order; ++i) weight *= static_cast<double>(k);
    sum += weight * std::abs(c_[k]);
  }
  return sum;
}

TrigPolynomial TrigPolynomial::trimmed(double scale) const {
  constexpr double kRounding = 1e-14;
  TrigPolynomial out = *this;
  while (out.c_.size() > 1 && std::abs(out.c_.back()) <= kRounding * scale) out.c_.pop_back();
  return out;
}

TrigPolynomial& TrigPolynomial::operator+=(const TrigPolynomial& other) {
  if (other.c_.size() > c_.size()) c_.resize(other.c_.size());
  for (std::size_t k = 0; k < other.c_.size(); ++k) c_[k] += other.c_[k];
  return *this;
}

TrigPolynomial& TrigPolynomial::operator-=(const TrigPolynomial& other) {
  if (other.c_.size() > c_.size()) c_.resize(other.c_.size());
  for (std::size_t k = 0; k < other.c_.size(); ++k) c_[k] -= other.c_[k];
  return *this;
}

TrigPolynomial& TrigPolynomial::operator*=(double k) {
  for (Complex& c : c_) c *= k;
  return *this;
}

TrigPolynomial operator*(const TrigPolynomial& a, const TrigPolynomial& b) {
  TrigPolynomial out;
  out.c_.resize(a.c_.size() + b.c_.size() - 1);
  // The product of two positive powers, and of a positive with a negative one: (z^i)(z^j), (z^i)(z^−j).
  for (std::size_t i = 0; i < a.c_.size(); ++i) {
    for (std::size_t j = 0; j < b.c_.size(); ++j) {
      out.c_[i + j] += a.c_[i] * b.c_[j];
      if (i == 0 || j == 0) continue;
      if (i >= j) out.c_[i - j] += a.c_[i] * std::conj(b.c_[j]);
      if (j >= i) out.c_[j - i] += std::conj(a.c_[i]) * b.c_[j];
    }
  }
  out.c_[0] = out.c_[0].real();
  return out;
}

}  // namespace gyre::mechanics
