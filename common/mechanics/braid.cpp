#include "common/mechanics/braid.hpp"

#include <algorithm>
#include <optional>

#include "common/mechanics/force_polynomial.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/roots.hpp"
#include "common/mechanics/segment.hpp"

namespace gyre::mechanics {
namespace {

/// T smaller than this share of its bound all along is rounding: the cables stay in one plane.
constexpr double kRounding = 1e-13;
/// Lines that meet are apart by rounding, and by what a root is off.
constexpr double kMeet_m = 1e-7;

struct Crossing {
  double up_m, apart_m;
};

/// Whether the cables themselves meet at a moment at which their lines do.
std::optional<Crossing> crossing(const CarrierSlice& first, const CarrierSlice& second, double t_s) {
  const Reference a = evaluate(first, t_s);
  const Reference b = evaluate(second, t_s);
  const ClosestPoints meet = closest_points({first.attachment_w_m, a.position_w_m.value - first.attachment_w_m},
                                            {second.attachment_w_m, b.position_w_m.value - second.attachment_w_m});
  if (meet.apart.norm() > kMeet_m) return std::nullopt;
  return Crossing{meet.s * a.length_m.value, (a.position_w_m.value - b.position_w_m.value).norm()};
}

/// Roots closer than this are one: of two that meet, or of a cell and its neighbour at the edge they share.
constexpr double kTold = 1e-7;

/// Each once, in [0, 2 pi).
std::vector<double> roots(const TrigPolynomial& t) {
  std::vector<double> found;
  const auto never = [](double, double) { return false; };
  visit_roots(t, never, [&found](double psi) {
    const bool last = psi >= kTwoPi - kTold;  // it is the one at 0, which may be found there, too
    found.push_back(last ? 0.0 : psi);
  });
  std::sort(found.begin(), found.end());
  const auto same = [](double a, double b) { return b - a < kTold; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

/// +1 where t goes from negative to positive, −1 the other way, 0 where it comes back.
int side_change(const TrigPolynomial& t, double root) {
  const auto side = [&](double psi) { return t.value(on_circle(psi)) > 0.0 ? 1 : 0; };
  return side(root + 2.0 * kTold) - side(root - 2.0 * kTold);
}

}  // namespace

std::vector<Braid> braids(const std::vector<CarrierSlice>& slices, double period_s) {
  std::vector<PolynomialVector> forces(slices.size());
  std::transform(slices.begin(), slices.end(), forces.begin(),
                 [](const CarrierSlice& slice) { return force_polynomial(slice, 1); });

  std::vector<Braid> out;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    for (std::size_t j = i + 1; j < slices.size(); ++j) {
      const PolynomialVector product = cross(forces[i], forces[j]);
      const Eigen::Vector3d w = slices[j].attachment_w_m - slices[i].attachment_w_m;
      const TrigPolynomial t = dot(w, product);  // T = w · (f_i × f_j)
      const double scale = w.norm() * (product[0].bound() + product[1].bound() + product[2].bound());
      if (t.bound() <= kRounding * scale) continue;
      Braid braid{slices[i].id, slices[j].id, 0, period_s, 0.0, 0.0};
      const double rate = slices[i].rate_rad_s;
      for (const double theta : roots(t)) {
        // Lengths may need several turns of the cycle to repeat.
        for (double t_s = theta / rate; t_s < period_s; t_s += kTwoPi / rate) {
          const std::optional<Crossing> met = crossing(slices[i], slices[j], t_s);
          if (!met) continue;
          braid.winding += side_change(t, theta);
          if (t_s >= braid.at_s) continue;
          braid.at_s = t_s;
          braid.up_m = met->up_m;
          braid.apart_m = met->apart_m;
        }
      }
      if (braid.at_s < period_s) out.push_back(braid);
    }
  }
  return out;
}

}  // namespace gyre::mechanics
