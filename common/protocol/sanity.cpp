#include "common/protocol/sanity.hpp"

#include <algorithm>
#include <cmath>

#include "common/protocol/counting.hpp"

namespace gyre::protocol {
namespace {

/// Nothing Gyre carries is this far, this fast, this heavy or this strong; a number beyond is a broken message.
constexpr double kHuge = 1e7;
constexpr double kUnitTolerance = 1e-6;
/// No two clocks are further apart than one per cent, and what is estimated of them not much.
constexpr double kHugeDrift_ppm = 1e5;

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

bool sane(const PlanNumber& number) {
  return counted(number.term) && counted(number.revision);
}

/// Plan time may pass twice as fast as swarm time.
bool sane(PlanTime t) {
  return t.time_since_epoch() >= -kLongest / 2 && t.time_since_epoch() <= kLongest / 2;
}

bool sane(const Ramp& ramp) {
  // A pace is a share of full motion; its derivatives, over ramps of a tenth of a second and more.
  const PlanMoment& from = ramp.from;
  const bool bounded = std::abs(from.pace) <= 2.0 && std::abs(ramp.target) <= 1.0 && std::abs(from.rate_1_s) <= 100.0 &&
                       std::abs(from.curvature_1_s2) <= 1e4;  // false for what is not a number, too
  const bool constant = from.pace == ramp.target && from.rate_1_s == 0.0 && from.curvature_1_s2 == 0.0;
  return sane(ramp.start) && sane(ramp.duration) && sane(from.at) && bounded &&
         (ramp.duration > Duration::zero() || (ramp.duration == Duration::zero() && constant));
}

bool sane(const Wish& wish) {
  return wish.pace >= 0.0 && wish.pace <= 1.0 && wish.by >= Wisher::kNobody && wish.by <= Wisher::kEvidence;
}

bool sane(const Course& course) {
  if (!counted(course.term) || !counted(course.revision) || !sane(course.base.number)) return false;
  if (!sane(course.wish) || course.pace.ramps.empty() || course.pace.ramps.size() > kMaxRamps) return false;
  for (std::size_t i = 0; i < course.pace.ramps.size(); ++i) {
    if (!sane(course.pace.ramps[i])) return false;
    if (i > 0 && course.pace.ramps[i].start <= course.pace.ramps[i - 1].start) return false;
  }
  if (course.lease && !sane(*course.lease)) return false;
  if (!sane(course.stopping) || course.stopping <= Duration::zero()) return false;
  if (!sane(course.base.epoch) || course.transitions.size() > kMaxTransitions) return false;
  for (const Transition& t : course.transitions) {
    if (t.to.number.none() || !sane(t.to.number) || !sane(t.to.epoch) || !sane(t.start) || !sane(t.duration))
      return false;
    if (t.duration <= Duration::zero()) return false;
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
         sane(slice.cable_stiffness_n_m) && slice.cable_stiffness_n_m >= 0.0 && sane(slice.winch_lag_s) &&
         slice.winch_lag_s >= 0.0 && sane(slice.vehicle_lag_s) && slice.vehicle_lag_s >= 0.0;
}

}  // namespace

bool sane(const Beacon& beacon) {
  // Whoever leads puts his term to all that he says.
  const auto own = [&beacon](const Course& course) { return sane(course) && course.term == beacon.term; };
  return counted(beacon.term) && counted(beacon.sequence) && sane(beacon.swarm_time) && own(beacon.course) &&
         (!beacon.proposal || own(*beacon.proposal)) && sane(beacon.skew_budget) &&
         beacon.skew_budget >= Duration::zero();
}

bool sane(const PlanOffer& offer) {
  if (!counted(offer.term) || !counted(offer.sequence)) return false;
  if (!sane(offer.carrier) || offer.slices.size() > kMaxPlans || offer.neighbour.size() > kMaxPlans) return false;
  for (const NumberedSlice& numbered : offer.slices) {
    if (numbered.number.none() || !sane(numbered.number) || !sane(numbered.slice)) return false;
    if (numbered.slice.id != offer.carrier) return false;
  }
  for (const NumberedSlice& numbered : offer.neighbour) {
    if (numbered.number.none() || !sane(numbered.number) || !sane(numbered.slice)) return false;
    if (numbered.slice.id != offer.neighbour.front().slice.id) return false;
  }
  return true;
}

bool sane(const HeldPlans& held) {
  return sane(PlanOffer{held.carrier, 0, 0, held.slices, held.neighbour});
}

bool sane(const AgentStatus& status) {
  for (const std::uint64_t count : {status.sequence, status.term, status.confirmed, status.beacons_received}) {
    if (!counted(count)) return false;
  }
  // Whoever follows a course has heard of its coordinator.
  if (status.course.term > status.term || !sane(status.refused)) return false;
  const auto known = [](const PlanNumber& number) { return sane(number); };
  if (!std::all_of(status.accepted.begin(), status.accepted.end(), known)) return false;
  return sane(status.carrier) && sane(status.swarm_time) && status.clock_uncertainty >= Duration::zero() &&
         status.state >= AgentState::kWaiting && status.state <= AgentState::kAlone &&
         std::abs(status.clock_drift_ppm) <= kHugeDrift_ppm && sane(status.course) &&
         status.accepted.size() <= kMaxPlans;
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

bool sane(const Disturbance& d) {
  return d.process.size() <= kMaxTextBytes && d.kind >= DisturbanceKind::kLosePackets &&
         d.kind <= DisturbanceKind::kPushLoad && d.share >= 0.0 && d.share <= 1.0 && sane(d.shift) &&
         sane(d.force_w_n) && sane(d.duration) && d.duration >= Duration::zero();
}

}  // namespace gyre::protocol
