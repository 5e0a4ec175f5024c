#include "common/mechanics/orbit_figures.hpp"

#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/extremes.hpp"
#include "common/mechanics/force_polynomial.hpp"
#include "common/mechanics/transition_figures.hpp"

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
/// Of a sum whose parts are not at their extremes together.
Range operator-(const Range& a, const Range& b) {
  return {a.min - b.max, a.max - b.min};
}
double magnitude(const Range& r) {
  return std::max(std::abs(r.min), std::abs(r.max));
}

/// Where the carrier has no bounded motion.
void unbounded(CarrierFigures& figures, bool pulls) {
  figures.length_m = figures.winch_rate_m_s = figures.altitude_m = {-kInfinity, kInfinity};
  figures.paid_out_m = figures.paid_out_rate_m_s = {-kInfinity, kInfinity};
  figures.speed_m_s = {0.0, kInfinity};
  figures.acceleration_max_m_s2 = figures.winch_acceleration_max_m_s2 = kInfinity;
  if (!pulls) return;
  figures.thrust_max_n = kInfinity;
  figures.bank_max_rad = kPi;
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

/// Speed and acceleration of sigma f d^(-half_power / 2): d = g, half_power 2, or d = M, half_power 1. Returns A.
PolynomialVector motion_figures(const Orbit& orbit, const Factor& d, CarrierFigures& figures) {
  const PolynomialVector position{orbit.sigma * orbit.f[0], orbit.sigma * orbit.f[1], orbit.sigma * orbit.f[2]};
  const double power = 0.5 * d.half_power;
  const PolynomialVector v = quotient_derivative(position, *d.base, power);
  PolynomialVector a = quotient_derivative(v, *d.base, power + 1.0);
  const double w = orbit.base_rate_rad_s;
  figures.speed_m_s =
      scaled(square_root(extremes(dot(v, v), {{d.base, d.range, -2 * (d.half_power + 2)}})), std::abs(w));
  figures.acceleration_max_m_s2 =
      w * w * square_root(extremes(dot(a, a), {{d.base, d.range, -2 * (d.half_power + 4)}})).max;
  return a;
}

void free_figures(const CarrierSlice& c, const Orbit& orbit, const Factor& m, CarrierFigures& figures) {
  const double w = orbit.base_rate_rad_s;
  const Polynomial slope = orbit.sigma.derivative();
  figures.length_m = extremes(orbit.sigma);
  figures.winch_rate_m_s = scaled(extremes(slope), w);
  figures.altitude_m = extremes(orbit.sigma * orbit.f[2], {{m.base, m.range, -1}});
  figures.altitude_m.min += c.attachment_w_m.z();
  figures.altitude_m.max += c.attachment_w_m.z();
  motion_figures(orbit, {m.base, m.range, 1}, figures);

  figures.paid_out_m = figures.length_m;
  figures.paid_out_rate_m_s = figures.winch_rate_m_s;
  Range second = scaled(extremes(slope.derivative()), w * w);
  if (c.cable_stiffness_n_m > 0.0) {
    // s = √M,  s' = M' / (2 √M),  s'' = (M'' M − M'²/2) / (2 M^(3/2))
    const double compliance = 1.0 / c.cable_stiffness_n_m;
    const Polynomial turn = m.base->derivative();
    figures.paid_out_m = figures.length_m - scaled(figures.tension_n, compliance);
    figures.paid_out_rate_m_s =
        figures.winch_rate_m_s - scaled(extremes(0.5 * turn, {{m.base, m.range, -1}}), w * compliance);
    const Polynomial bend = 0.5 * (turn.derivative() * *m.base) - 0.25 * (turn * turn);
    second = second - scaled(extremes(bend, {{m.base, m.range, -3}}), w * w * compliance);
  }
  figures.winch_acceleration_max_m_s2 = magnitude(second);
}

/// sigma √M / g with its derivative by psi, P / (√M g²), as in the header.
struct WinchMotion {
  Range length, slope;
  Polynomial p;
};
WinchMotion winch_motion(const Polynomial& sigma, const Factor& m, const Factor& g) {
  const Polynomial& square = *m.base;
  const Polynomial first = sigma.derivative() * square * *g.base;
  const Polynomial second = sigma * (0.5 * (square.derivative() * *g.base));
  const Polynomial third = sigma * (square * g.base->derivative());
  const Polynomial p = (first + second - third).trimmed(first.bound() + second.bound() + third.bound());
  return {extremes(sigma, {{m.base, m.range, 1}, {g.base, g.range, -2}}),
          extremes(p, {{m.base, m.range, -1}, {g.base, g.range, -4}}), p};
}

/// max |Q / (M^(3/2) g³)|.
double bend_max(const Polynomial& p, const Factor& m, const Factor& g) {
  const Polynomial first = p.derivative() * *m.base * *g.base;
  const Polynomial second = p * (0.5 * (m.base->derivative() * *g.base) + 2.0 * (*m.base * g.base->derivative()));
  const Polynomial q = (first - second).trimmed(first.bound() + second.bound());
  return magnitude(extremes(q, {{m.base, m.range, -3}, {g.base, g.range, -6}}));
}

/// Takes up what a vehicle pulls, N d^(-half_power / 2).
void include_pull(const PolynomialVector& n, std::initializer_list<Factor> square_factors, CarrierFigures& figures) {
  const Polynomial square = dot(n, n);
  const double thrust_n = square_root(extremes(square, square_factors)).max;
  const Range range = extremes(square);
  // A vehicle that once need not pull at all may do so in any direction.
  const double bank_rad = range.min <= 1e-12 * range.max
                              ? kPi
                              : std::acos(std::clamp(extremes(n[2], {{&square, range, -1}}).min, -1.0, 1.0));
  figures.thrust_max_n = std::max(thrust_n, figures.thrust_max_n.value_or(0.0));
  figures.bank_max_rad = std::max(bank_rad, figures.bank_max_rad.value_or(0.0));
}

/// At rest, and at full pace N / g³ as in the header; `a` is A.
void pull_figures(const VehicleWeight& vehicle, const Orbit& orbit, const PolynomialVector& a, const Factor& g,
                  CarrierFigures& figures) {
  const double w = orbit.base_rate_rad_s;
  const Polynomial cube = *g.base * *g.base * *g.base;
  PolynomialVector held = orbit.f;
  held[2] += Polynomial(vehicle.mass_kg * vehicle.gravity_m_s2);
  PolynomialVector n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = (vehicle.mass_kg * w * w) * a[i] + held[i] * cube;
  include_pull(held, {}, figures);
  include_pull(n, {{g.base, g.range, -12}}, figures);
}

void projection_figures(const CarrierSlice& c, const std::optional<VehicleWeight>& vehicle, Orbit& orbit,
                        const Factor& m, CarrierFigures& figures) {
  const Eigen::Vector3d& u = c.law.direction;
  Polynomial g = dot(u, orbit.f);
  Range g_range = extremes(g);
  if (g_range.min <= 0.0 && g_range.max >= 0.0) {
    figures.direction_cosine_min = 0.0;
    return unbounded(figures, vehicle.has_value());
  }
  if (g_range.max < 0.0) {  // the cable points against u: l = sigma / g is the same with both signs turned
    g *= -1.0;
    orbit.sigma *= -1.0;
    g_range = {-g_range.max, -g_range.min};
  }
  const Factor along{&g, g_range, 2};
  const double rate = orbit.base_rate_rad_s;
  figures.direction_cosine_min = extremes(g, {{m.base, m.range, -1}}).min;
  const WinchMotion cable = winch_motion(orbit.sigma, m, along);
  figures.length_m = cable.length;
  figures.winch_rate_m_s = scaled(cable.slope, rate);
  const WinchMotion paid_out =
      c.cable_stiffness_n_m > 0.0 ? winch_motion(orbit.sigma - (1.0 / c.cable_stiffness_n_m) * g, m, along) : cable;
  figures.paid_out_m = paid_out.length;
  figures.paid_out_rate_m_s = scaled(paid_out.slope, rate);
  figures.winch_acceleration_max_m_s2 = rate * rate * bend_max(paid_out.p, m, along);

  if (c.law.kind == LengthLaw::Kind::kLevel) {
    figures.altitude_m = {c.law.profile.mean, c.law.profile.mean};  // by construction; f_z / g is one to the bit
  } else {
    figures.altitude_m = extremes(orbit.sigma * orbit.f[2], {{&g, g_range, -2}});
    figures.altitude_m.min += c.attachment_w_m.z();
    figures.altitude_m.max += c.attachment_w_m.z();
  }
  const PolynomialVector a = motion_figures(orbit, along, figures);
  if (vehicle) pull_figures(*vehicle, orbit, a, along, figures);
}

}  // namespace

CarrierFigures orbit_figures(const CarrierSlice& slice, const std::optional<VehicleWeight>& vehicle) {
  Orbit orbit = orbit_of(slice);
  CarrierFigures figures;
  figures.id = slice.id;

  const Range m_range = extremes(orbit.m);
  figures.tension_n = square_root(m_range);
  const double rounding = 1e-12 * m_range.max;
  if (m_range.min <= rounding) {  // the cable goes slack: it has no direction at that moment
    figures.vertical_cosine = {-1.0, 1.0};
    if (slice.law.is_projection()) figures.direction_cosine_min = 0.0;
    unbounded(figures, vehicle.has_value());
    return figures;
  }
  const Factor m{&orbit.m, m_range, 0};
  figures.vertical_cosine = extremes(orbit.f[2], {{m.base, m.range, -1}});
  if (slice.law.is_projection()) {
    projection_figures(slice, vehicle, orbit, m, figures);
    return figures;
  }
  free_figures(slice, orbit, m, figures);
  if (vehicle) {
    const CarrierFigures enclosed =
        transition_figures({{&slice, 0.0, 0.0, 0.0}}, 0.0, kTwoPi / std::abs(orbit.base_rate_rad_s), vehicle);
    figures.thrust_max_n = enclosed.thrust_max_n;
    figures.bank_max_rad = enclosed.bank_max_rad;
  }
  return figures;
}

}  // namespace gyre::mechanics
