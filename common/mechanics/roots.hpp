#pragma once
// Every root of a trigonometric polynomial, found by proofs from its coefficients.
//
// Eigenvalues of a companion matrix find roots but say little when two of them meet. Here the circle is cut into cells,
// and each cell is settled: it holds no root; or it holds at most one, which Newton finds; or the caller says that it
// is flat enough to be done with. What is left is halved. Newton's condition is Kantorovich's.

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/trig_polynomial.hpp"

namespace gyre::mechanics {

/// exp(i psi).
[[nodiscard]] inline TrigPolynomial::Complex on_circle(double psi) {
  return {std::cos(psi), std::sin(psi)};
}

/// Calls `visit(psi)` at every root of t in [0, 2 pi]; one at the edge of two cells twice, and roots that meet
/// together. `flat(h, bound)`: whether a cell of half width h over which |t| <= bound needs no look; one that is
/// narrower than any root can be told from its neighbour is visited at its middle.
template <class Flat, class Visit>
class RootSearch {
 public:
  RootSearch(const TrigPolynomial& t, const Flat& flat, const Visit& visit)
      : t_(t), flat_(flat), visit_(visit), curvature_(t.bound(2)) {}

  void run() const {
    // About two cells per root: fewer are all halved, more are mostly empty.
    const int cells = 4 * std::max(1, t_.degree());
    const double h = kPi / cells;
    for (int i = 0; i < cells; ++i) settle(h * (2 * i + 1), h);
  }

 private:
  /// Cells narrower than this are settled by their middle: t is flat there to rounding, whatever its bound says.
  static constexpr double kNarrowest = 1e-8;

  void settle(double middle, double h) const {
    const auto [t, slope] = t_.jet(on_circle(middle));
    const double reach = std::abs(slope) * h + 0.5 * curvature_ * h * h;
    const bool flat = flat_(h, std::abs(t) + reach);
    if (!flat && std::abs(t) > reach) return;  // no root
    if (flat || h < kNarrowest) return visit_(middle);
    // |T'| >= 3 |T''| h: at most one root, and Newton from the middle converges to it if it is there.
    if (std::abs(slope) >= 3.0 * curvature_ * h) return visit_(newton(middle, h));
    settle(middle - 0.5 * h, 0.5 * h);
    settle(middle + 0.5 * h, 0.5 * h);
  }

  [[nodiscard]] double newton(double psi, double h) const {
    constexpr int kSteps = 6;  // quadratic from a Kantorovich start: 1e-16 in five
    const double low = psi - h;
    const double high = psi + h;
    for (int i = 0; i < kSteps; ++i) {
      const auto [t, slope] = t_.jet(on_circle(psi));
      const double next = std::clamp(psi - t / slope, low, high);
      if (std::abs(next - psi) < 1e-9) return next;  // 1e-9 squared is below rounding
      psi = next;
    }
    return psi;
  }

  const TrigPolynomial& t_;
  const Flat& flat_;
  const Visit& visit_;
  double curvature_;
};

template <class Flat, class Visit>
void visit_roots(const TrigPolynomial& t, const Flat& flat, const Visit& visit) {
  RootSearch<Flat, Visit>(t, flat, visit).run();
}

}  // namespace gyre::mechanics
