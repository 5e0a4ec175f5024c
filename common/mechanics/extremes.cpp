#include "common/mechanics/extremes.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"

namespace gyre::mechanics {
namespace {

using Complex = TrigPolynomial::Complex;

/// How far F may be off where a cell is settled without its roots, relative to the greatest |F| seen.
constexpr double kTolerance = 1e-13;
/// Cells narrower than this are settled by their midpoint: F is flat there to rounding, whatever T's bound says.
constexpr double kNarrowest = 1e-8;

Complex unit(double psi) {
  return {std::cos(psi), std::sin(psi)};
}

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
    curvature_ = critical_.bound(2);
  }

  [[nodiscard]] double value(const Complex& z) const {
    double result = numerator_.value(z);
    for (const Factor& f : factors_) result *= half_power(f.base->value(z), f.half_power);
    return result;
  }
  [[nodiscard]] const TrigPolynomial& critical() const { return critical_; }
  [[nodiscard]] double curvature() const { return curvature_; }        ///< bound of |T''|
  [[nodiscard]] double slope_factor() const { return slope_factor_; }  ///< |F'| <= slope_factor |T|

 private:
  const TrigPolynomial& numerator_;
  boost::container::small_vector<Factor, 2> factors_;
  TrigPolynomial critical_;
  double slope_factor_ = 1.0;
  double curvature_ = 0.0;
};

class Search {
 public:
  explicit Search(const Quotient& quotient) : quotient_(quotient) {}

  Range run() {
    candidate(unit(0.0));
    // About two cells per root: fewer are all halved, more are mostly empty.
    const int cells = 4 * std::max(1, quotient_.critical().degree());
    const double h = kPi / cells;
    for (int i = 0; i < cells; ++i) settle(h * (2 * i + 1), h);
    if (flat_) return {range_.min, range_.max};
    const double rounding = 1e-13 * std::max(std::abs(range_.min), std::abs(range_.max));
    return {range_.min - rounding, range_.max + rounding};
  }

 private:
  void candidate(const Complex& z) { range_.include(quotient_.value(z)); }

  void settle(double middle, double h) {
    const Complex z = unit(middle);
    const auto [t, slope] = quotient_.critical().jet(z);
    const double curvature = quotient_.curvature();
    const double reach = std::abs(slope) * h + 0.5 * curvature * h * h;
    const double scale = std::max(std::abs(range_.min), std::abs(range_.max));

    const bool still = h * (std::abs(t) + reach) * quotient_.slope_factor() <= kTolerance * scale;
    if (!still) flat_ = false;
    if (!still && std::abs(t) > reach) return;  // no root
    if (still || h < kNarrowest) return candidate(z);
    // |T'| >= 3 |T''| h: at most one root, and Newton from the middle converges to it if it is there.
    if (std::abs(slope) >= 3.0 * curvature * h) return candidate(newton(middle, h));
    settle(middle - 0.5 * h, 0.5 * h);
    settle(middle + 0.5 * h, 0.5 * h);
  }

  [[nodiscard]] Complex newton(double psi, double h) const {
    constexpr int kSteps = 6;  // quadratic from a Kantorovich start: 1e-16 in five
    const double low = psi - h;
    const double high = psi + h;
    for (int i = 0; i < kSteps; ++i) {
      const auto [t, slope] = quotient_.critical().jet(unit(psi));
      const double next = std::clamp(psi - t / slope, low, high);
      if (std::abs(next - psi) < 1e-9) return unit(next);  // F is flat here: 1e-9 squared is below rounding
      psi = next;
    }
    return unit(psi);
  }

  const Quotient& quotient_;
  Range range_;
  bool flat_ = true;
};

}  // namespace

Range extremes(const TrigPolynomial& numerator, std::initializer_list<Factor> factors) {
  const Quotient quotient(numerator, factors);
  return Search(quotient).run();
}

}  // namespace gyre::mechanics
