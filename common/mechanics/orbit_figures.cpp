#include "common/mechanics/orbit_figures.hpp"

#include <cmath>

#include "common/mechanics/extremes.hpp"
#include "common/mechanics/force_polynomial.hpp"

namespace gyre::mechanics {
namespace {

using Polynomial = TrigPolynomial;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// a' d − power · a d', times d^-(power + 1) the derivative of a d^-power; the leading terms may cancel by algebra.
PolynomialVector quotient_derivative(const PolynomialVector& a, const Polynomial& d, double power) {
  const Polynomial slope = d.derivative();
  PolynomialVector out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Polynomial first = a[i].derivative() * d;
    const Polynomial second = power * (a[i] * slope);
    out[i] = (first - second).trimmed(first.bound() + second.bound());
  }
  return out;
}

Range square_root(const Range& r) {
  return {std::sqrt(std::max(0.0, r.min)), std::sqrt(std::max(0.0, r.max))};
}
Range scaled(const Range& r, double k) {
  return {r.min * k, r.max * k};
}

/// The polynomials of one carrier's orbit in its base angle.
struct Orbit {
  double base_rate_rad_s;
  PolynomialVector f;
  Polynomial m;
  Polynomial sigma;
};

Orbit orbit_of(const CarrierSlice& c) {
  const Oscillation& profile = c.law.profile;
  const int denominator = profile.constant() ? 1 : profile.harmonic.denominator;
  Orbit orbit{c.rate_rad_s / denominator, force_polynomial(c, denominator), {}, Polynomial(profile.mean)};
  orbit.m = dot(orbit.f, orbit.f);
  if (!profile.constant())
    orbit.sigma += Polynomial::sine(profile.swing, profile.harmonic.numerator, profile.phase_rad);
  if (c.law.is_projection()) orbit.sigma -= Polynomial(c.law.direction.dot(c.attachment_w_m));
  return orbit;
}

/// Speed and acceleration of sigma f d^(-half_power / 2): d = g, half_power 2, or d = M, half_power 1.
void motion_figures(const Orbit& orbit, const Factor& d, CarrierFigures& figures) {
  const PolynomialVector position{orbit.sigma * orbit.f[0], orbit.sigma * orbit.f[1], orbit.sigma * orbit.f[2]};
  const double power = 0.5 * d.half_power;
  const PolynomialVector v = quotient_derivative(position, *d.base, power);
  const PolynomialVector a = quotient_derivative(v, *d.base, power + 1.0);
  const double w = orbit.base_rate_rad_s;
  figures.speed_m_s =
      scaled(square_root(extremes(dot(v, v), {{d.base, d.range, -2 * (d.half_power + 2)}})), std::abs(w));
  figures.acceleration_max_m_s2 =
      w * w * square_root(extremes(dot(a, a), {{d.base, d.range, -2 * (d.half_power + 4)}})).max;
}

void free_figures(const CarrierSlice& c, const Orbit& orbit, const Factor& m, CarrierFigures& figures) {
  figures.length_m = extremes(orbit.sigma);
  figures.winch_rate_m_s = scaled(extremes(orbit.sigma.derivative()), orbit.base_rate_rad_s);
  figures.altitude_m = extremes(orbit.sigma * orbit.f[2], {{m.base, m.range, -1}});
  figures.altitude_m.min += c.attachment_w_m.z();
  figures.altitude_m.max += c.attachment_w_m.z();
  motion_figures(orbit, {m.base, m.range, 1}, figures);
}

void projection_figures(const CarrierSlice& c, Orbit& orbit, const Factor& m, CarrierFigures& figures) {
  const Eigen::Vector3d& u = c.law.direction;
  Polynomial g = dot(u, orbit.f);
  Range g_range = extremes(g);
  if (g_range.min <= 0.0 && g_range.max >= 0.0) {
    figures.direction_cosine_min = 0.0;
    figures.length_m = figures.winch_rate_m_s = figures.altitude_m = {-kInfinity, kInfinity};
    figures.speed_m_s = {0.0, kInfinity};
    figures.acceleration_max_m_s2 = kInfinity;
    return;
  }
  if (g_range.max < 0.0) {  // the cable points against u: l = sigma / g is the same with both signs turned
    g *= -1.0;
    orbit.sigma *= -1.0;
    g_range = {-g_range.max, -g_range.min};
  }
  figures.direction_cosine_min = extremes(g, {{m.base, m.range, -1}}).min;
  figures.length_m = extremes(orbit.sigma, {{m.base, m.range, 1}, {&g, g_range, -2}});

  // dl/dpsi = P / (√M g²),  P = sigma' M g + sigma (M' g / 2 − M g')
  const Polynomial first = orbit.sigma.derivative() * orbit.m * g;
  const Polynomial second = orbit.sigma * (0.5 * (orbit.m.derivative() * g));
  const Polynomial third = orbit.sigma * (orbit.m * g.derivative());
  const Polynomial p = (first + second - third).trimmed(first.bound() + second.bound() + third.bound());
  figures.winch_rate_m_s = scaled(extremes(p, {{m.base, m.range, -1}, {&g, g_range, -4}}), orbit.base_rate_rad_s);

  if (c.law.kind == LengthLaw::Kind::kLevel) {
    figures.altitude_m = {c.law.profile.mean, c.law.profile.mean};  // by construction; f_z / g is one to the bit
  } else {
    figures.altitude_m = extremes(orbit.sigma * orbit.f[2], {{&g, g_range, -2}});
    figures.altitude_m.min += c.attachment_w_m.z();
    figures.altitude_m.max += c.attachment_w_m.z();
  }
  motion_figures(orbit, {&g, g_range, 2}, figures);
}

}  // namespace

CarrierFigures orbit_figures(const CarrierSlice& slice) {
  Orbit orbit = orbit_of(slice);
  CarrierFigures figures;
  figures.id = slice.id;

  const Range m_range = extremes(orbit.m);
  figures.tension_n = square_root(m_range);
  const double rounding = 1e-12 * m_range.max;
  if (m_range.min <= rounding) {  // the cable goes slack: it has no direction at that moment
    figures.vertical_cosine = {-1.0, 1.0};
    if (slice.law.is_projection()) figures.direction_cosine_min = 0.0;
    figures.length_m = figures.winch_rate_m_s = figures.altitude_m = {-kInfinity, kInfinity};
    figures.speed_m_s = {0.0, kInfinity};
    figures.acceleration_max_m_s2 = kInfinity;
    return figures;
  }
  const Factor m{&orbit.m, m_range, 0};
  figures.vertical_cosine = extremes(orbit.f[2], {{m.base, m.range, -1}});
  if (slice.law.is_projection()) {
    projection_figures(slice, orbit, m, figures);
  } else {
    free_figures(slice, orbit, m, figures);
  }
  return figures;
}

}  // namespace gyre::mechanics
