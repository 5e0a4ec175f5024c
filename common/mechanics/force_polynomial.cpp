#include "common/mechanics/force_polynomial.hpp"

namespace gyre::mechanics {

PolynomialVector force_polynomial(const CarrierSlice& c, int denominator) {
  const auto lambda = [denominator](const EdgePush& edge) {
    return TrigPolynomial(edge.offset_n) + TrigPolynomial::sine(edge.amplitude_n, denominator, edge.phase_rad);
  };
  // f_i = f0_i + lambda_in delta_i + lambda_out deltabar_i
  const TrigPolynomial in = lambda(c.incoming);
  const TrigPolynomial out = lambda(c.outgoing);
  PolynomialVector f;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    f[i] = TrigPolynomial(c.particular_force_w_n[axis]) + c.incoming.direction[axis] * in +
           c.outgoing.direction[axis] * out;
  }
  return f;
}

TrigPolynomial dot(const PolynomialVector& a, const PolynomialVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

TrigPolynomial dot(const Eigen::Vector3d& a, const PolynomialVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

PolynomialVector cross(const PolynomialVector& a, const PolynomialVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace gyre::mechanics
