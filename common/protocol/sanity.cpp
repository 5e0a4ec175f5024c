#include "common/protocol/sanity.hpp"

#include <cmath>

namespace gyre::protocol {
namespace {

/// Nothing Gyre carries is this far, this fast, this heavy or this strong; a number beyond is a broken message.
constexpr double kHuge = 1e7;
constexpr double kUnitTolerance = 1e-6;

bool sane(double x) {
  return std::isfinite(x) && std::abs(x) <= kHuge;
}
bool sane(const Eigen::Vector3d& v) {
  return sane(v.x()) && sane(v.y()) && sane(v.z());
}
bool unit(const Eigen::Vector3d& v) {
  return sane(v) && std::abs(v.norm() - 1.0) <= kUnitTolerance;
}
bool unit_or_zero(const Eigen::Vector3d& v) {
  return unit(v) || (sane(v) && v.isZero(0.0));
}
bool sane(Duration d) {
  return d >= -kLongest && d <= kLongest;
}
bool sane(SwarmTime t) {
  return usable(t);
}
bool sane(CarrierId id) {
  return id >= 1 && id <= kMaxCarrierId;
}

bool sane(const Course& course) {
  if (!sane(course.base.epoch) || course.transitions.size() > kMaxTransitions) return false;
  for (const Transition& t : course.transitions) {
    if (t.to.number.none() || !sane(t.to.epoch) || !sane(t.start) || !sane(t.duration)) return false;
    if (t.duration <= Duration::zero()) return false;
    if (t.stage != Stage::kProposed && t.stage != Stage::kGo) return false;
  }
  return true;
}

bool sane(const mechanics::EdgePush& edge) {
  return unit_or_zero(edge.direction) && sane(edge.offset_n) && sane(edge.amplitude_n) && sane(edge.phase_rad);
}

bool sane(const mechanics::LengthLaw& law) {
  const mechanics::Oscillation& p = law.profile;
  const bool rational = p.harmonic.numerator >= 1 && p.harmonic.numerator <= mechanics::kMaxNumerator &&
                        p.harmonic.denominator >= 1 && p.harmonic.denominator <= mechanics::kMaxDenominator;
  return rational && unit(law.direction) && sane(p.mean) && sane(p.swing) && sane(p.phase_rad);
}

bool sane(const mechanics::CarrierSlice& slice) {
  return sane(slice.id) && sane(slice.attachment_w_m) && sane(slice.particular_force_w_n) && sane(slice.incoming) &&
         sane(slice.outgoing) && sane(slice.rate_rad_s) && slice.rate_rad_s > 0.0 && sane(slice.law) &&
         sane(slice.cable_stiffness_n_m) && slice.cable_stiffness_n_m >= 0.0;
}

}  // namespace

bool sane(const Beacon& beacon) {
  return sane(beacon.swarm_time) && sane(beacon.course) && sane(beacon.skew_budget) &&
         beacon.skew_budget >= Duration::zero();
}

bool sane(const PlanOffer& offer) {
  if (!sane(offer.carrier) || offer.slices.size() > kMaxPlans) return false;
  for (const NumberedSlice& numbered : offer.slices) {
    if (numbered.number.none() || !sane(numbered.slice) || numbered.slice.id != offer.carrier) return false;
  }
  return true;
}

bool sane(const AgentStatus& status) {
  return sane(status.carrier) && sane(status.swarm_time) && status.clock_uncertainty >= Duration::zero() &&
         status.state >= AgentState::kWaiting && status.state <= AgentState::kAlone && sane(status.clock_drift_ppm) &&
         sane(status.course) && status.accepted.size() <= kMaxPlans;
}

bool sane(const CarrierState& s) {
  return sane(s.carrier) && sane(s.position_w_m) && sane(s.velocity_w_m_s) && sane(s.tension_n) &&
         sane(s.cable_length_m) && sane(s.winch_length_m) && sane(s.winch_rate_m_s);
}

bool sane(const LoadState& s) {
  const double norm = s.orientation_w_b.norm();
  return sane(s.position_w_m) && sane(s.velocity_w_m_s) && sane(s.angular_velocity_b_rad_s) && std::isfinite(norm) &&
         std::abs(norm - 1.0) <= 1e-3;
}

}  // namespace gyre::protocol
