#include "common/mechanics/extremes.hpp"

#include <algorithm>
#include <cmath>

#include "common/mechanics/roots.hpp"

namespace gyre::mechanics {
namespace {

using Complex = TrigPolynomial::Complex;

/// How far F may be off where a cell is settled without its roots, relative to the greatest |F| seen.
constexpr double kTolerance = 1e-13;
double half_power(double base, int twice) {
  double result = (twice % 2 != 0) ? std::sqrt(base) : 1.0;
  double square = base;
  for (int n = std::abs(twice) / 2; n > 0; n /= 2, square *= square) {
    if (n % 2 != 0) result *= square;
  }
  return twice < 0 ? 1.0 / result : result;
}

/// F as a function, its critical polynomial, and the bounds that go with both.
class Quotient {
 public:
  Quotient(const TrigPolynomial& numerator, std::initializer_list<Factor> factors)
      : numerator_(numerator), factors_(factors) {
    // T = N' prod D_i + N sum (p_i / 2) D_i' prod_{j != i} D_j
    critical_ = numerator.derivative();
    double scale = critical_.bound();
    TrigPolynomial product(1.0);
    for (const Factor& f : factors_) {
      const TrigPolynomial turn = (0.5 * f.half_power) * (numerator * product) * f.base->derivative();
      critical_ = critical_ * *f.base;
      scale = std::max(scale * f.base->bound(), turn.bound());
      critical_ += turn;
      product = product * *f.base;
      // F' = T · prod D_i^(p_i/2 − 1); each power is monotone in D, so its greatest value is at an end.
      slope_factor_ *= std::max(half_power(f.range.min, f.half_power - 2), half_power(f.range.max, f.half_power - 2));
    }
    critical_ = critical_.trimmed(scale);
  }

  [[nodiscard]] double value(const Complex& z) const {
    double result = numerator_.value(z);
    for (const Factor& f : factors_) result *= half_power(f.base->value(z), f.half_power);
    return result;
  }
  [[nodiscard]] const TrigPolynomial& critical() const { return critical_; }
  [[nodiscard]] double slope_factor() const { return slope_factor_; }  ///< |F'| <= slope_factor |T|

 private:
  const TrigPolynomial& numerator_;
  boost::container::small_vector<Factor, 2> factors_;
  TrigPolynomial critical_;
  double slope_factor_ = 1.0;
};

}  // namespace

Range extremes(const TrigPolynomial& numerator, std::initializer_list<Factor> factors) {
  const Quotient quotient(numerator, factors);
  Range range;
  const auto candidate = [&](double psi) { range.include(quotient.value(on_circle(psi))); };
  candidate(0.0);
  bool constant = true;
  // F cannot change across the cell by more than rounding.
  const auto flat = [&](double h, double bound) {
    const double scale = std::max(std::abs(range.min), std::abs(range.max));
    const bool still = h * bound * quotient.slope_factor() <= kTolerance * scale;
    if (!still) constant = false;
    return still;
  };
  visit_roots(quotient.critical(), flat, candidate);
  if (constant) return range;
  const double rounding = 1e-13 * std::max(std::abs(range.min), std::abs(range.max));
  return {range.min - rounding, range.max + rounding};
}

}  // namespace gyre::mechanics
