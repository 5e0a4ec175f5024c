#pragma once
// The one place where the paper's formulas stand: what a carrier has to do at time t.
//
//   symbol   meaning                                            shape   frame   unit
//   f        force of the cable on the load                     3       W       N
//   s        tension, |f|                                       1       -       N
//   q        cable direction, attachment to carrier, unit       3       W       -
//   l        cable length                                       1       -       m
//   p        carrier position                                   3       W       m
//   t        time since the plan's epoch (theta = rate · t)     1       -       s
//
// Every quantity carries its exact first and second time derivative (taylor.hpp).
//
// Nothing here can fail, and nothing is checked: what is asked of a valid plan's slice at a finite time is finite where
// a motion is. Where it is not, the result says so by not being finite, and judging that is up to whoever flies it:
//
//   f = 0, a slack cable        force and a free law's length as ever, tension 0; its derivatives, the direction, the
//                               position and a projection's length are NaN: a slack cable has no direction
//   u·q = 0 under a projection  force, tension and direction as ever; length and position are infinite or NaN
//   input that is not finite    at least the position is not, either
//
// Source: Franchi, Landi, Gabellieri: local force, carrier position, direction, length laws; docs/design.md, The
// mechanics.

#include <cmath>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/taylor.hpp"

namespace gyre::mechanics {

template <class S>
struct BasicReference {
  TaylorVector<S> force_w_n;
  Taylor<S> tension_n;
  TaylorVector<S> direction_w;
  Taylor<S> length_m;
  TaylorVector<S> position_w_m;
};

using Reference = BasicReference<double>;

/// mean + swing sin(rate · t + phase).
template <class S>
[[nodiscard]] inline Taylor<S> oscillation(double mean, double swing, double rate_rad_s, double phase_rad,
                                           const S& t_s) {
  using std::cos;
  using std::sin;
  const S angle = rate_rad_s * t_s + phase_rad;
  const S sine = swing * sin(angle);
  const S cosine = swing * cos(angle);
  return {S(mean + sine), S(rate_rad_s * cosine), S(-(rate_rad_s * rate_rad_s) * sine)};
}

/// From the internal forces along both edges.
template <class S>
[[nodiscard]] inline TaylorVector<S> force(const CarrierSlice& c, const Taylor<S>& lambda_in,
                                           const Taylor<S>& lambda_out) {
  // f_i = f0_i + lambda_in delta_i + lambda_out deltabar_i
  return constant_vector<S>(c.particular_force_w_n) + lambda_in * c.incoming.direction +
         lambda_out * c.outgoing.direction;
}

template <class S>
[[nodiscard]] inline TaylorVector<S> force(const CarrierSlice& c, const S& t_s) {
  // lambda_j = offset_j + amplitude_j sin(theta + phase_j)
  return force(c, oscillation(c.incoming.offset_n, c.incoming.amplitude_n, c.rate_rad_s, c.incoming.phase_rad, t_s),
               oscillation(c.outgoing.offset_n, c.outgoing.amplitude_n, c.rate_rad_s, c.outgoing.phase_rad, t_s));
}

/// The law's length for a cable that points along q; `profile` is its s*(t) or l*(t).
template <class S>
[[nodiscard]] inline Taylor<S> length(const CarrierSlice& c, const TaylorVector<S>& q, const Taylor<S>& profile) {
  if (!c.law.is_projection()) return profile;
  // l = (s*(t) − u·B) / (u·q)
  return (profile - constant(S(c.law.direction.dot(c.attachment_w_m)))) / dot(c.law.direction, q);
}

/// At time t; q need not be the plan's own direction (transition.hpp).
template <class S>
[[nodiscard]] inline Taylor<S> length(const CarrierSlice& c, const TaylorVector<S>& q, const S& t_s) {
  const Oscillation& profile = c.law.profile;
  return length(c, q,
                profile.constant() ? constant(S(profile.mean))
                                   : oscillation(profile.mean, profile.swing, c.rate_rad_s * profile.harmonic.ratio(),
                                                 profile.phase_rad, t_s));
}

/// What follows from a force and a length: direction, tension, position.
template <class S>
[[nodiscard]] inline BasicReference<S> hang(const CarrierSlice& c, const TaylorVector<S>& f, const Taylor<S>& s,
                                            const TaylorVector<S>& q, const Taylor<S>& l) {
  // p_i = p_L + r_i + l_i q_i
  return {f, s, q, l, constant_vector<S>(c.attachment_w_m) + l * q};
}

/// What the winch has paid out: the cable, short by what its tension stretches it, l − s / k. A stiffness of 0: no
/// stretch is compensated, and it is l.
template <class S>
[[nodiscard]] inline Taylor<S> paid_out(const BasicReference<S>& r, double stiffness_n_m) {
  return stiffness_n_m > 0.0 ? r.length_m - (1.0 / stiffness_n_m) * r.tension_n : r.length_m;
}

template <class S>
[[nodiscard]] inline BasicReference<S> evaluate(const CarrierSlice& c, const S& t_s) {
  const TaylorVector<S> f = force(c, t_s);
  const Taylor<S> s = norm(f);
  const TaylorVector<S> q = f / s;
  return hang(c, f, s, q, length(c, q, t_s));
}

}  // namespace gyre::mechanics
