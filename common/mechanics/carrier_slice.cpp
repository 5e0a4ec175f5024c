#include "common/mechanics/carrier_slice.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "common/base/ensure.hpp"
#include "common/mechanics/grasp.hpp"

namespace gyre::mechanics {
namespace {

/// Newtons, metres, radians and their rates, of the size that they have here: rounding is a thousand times less.
bool alike(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}
bool alike(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return alike(a.x(), b.x()) && alike(a.y(), b.y()) && alike(a.z(), b.z());
}
bool alike(const EdgePush& a, const EdgePush& b) {
  return alike(a.direction, b.direction) && alike(a.offset_n, b.offset_n) && alike(a.amplitude_n, b.amplitude_n) &&
         alike(a.phase_rad, b.phase_rad);
}
bool alike(const LengthLaw& a, const LengthLaw& b) {
  return a.kind == b.kind && alike(a.direction, b.direction) && alike(a.profile.mean, b.profile.mean) &&
         alike(a.profile.swing, b.profile.swing) && alike(a.profile.phase_rad, b.profile.phase_rad) &&
         a.profile.harmonic.numerator == b.profile.harmonic.numerator &&
         a.profile.harmonic.denominator == b.profile.harmonic.denominator;
}

}  // namespace

bool alike(const CarrierSlice& a, const CarrierSlice& b) {
  return a.id == b.id && alike(a.attachment_w_m, b.attachment_w_m) &&
         alike(a.particular_force_w_n, b.particular_force_w_n) && alike(a.incoming, b.incoming) &&
         alike(a.outgoing, b.outgoing) && alike(a.rate_rad_s, b.rate_rad_s) && alike(a.law, b.law) &&
         alike(a.cable_stiffness_n_m, b.cable_stiffness_n_m) && alike(a.winch_lag_s, b.winch_lag_s) &&
         alike(a.vehicle_lag_s, b.vehicle_lag_s);
}

std::vector<CarrierSlice> slices(const Plan& plan) {
  if (plan.carriers.empty()) return {};
  const std::vector<Eigen::Vector3d> arms = lever_arms(plan);
  const ParticularForce particular = particular_force(arms, holding_wrench(plan.load.mass_kg, plan.gravity_m_s2));

  std::vector<CarrierSlice> out(plan.carriers.size());
  std::unordered_map<CarrierId, std::size_t> index;
  for (std::size_t i = 0; i < out.size(); ++i) {
    index[plan.carriers[i].id] = i;
    out[i].id = plan.carriers[i].id;
    out[i].attachment_w_m = plan.load.position_w_m + arms[i];
    out[i].particular_force_w_n = particular.forces_w_n[i];
    out[i].rate_rad_s = plan.cycle.rate_rad_s;
    out[i].law = plan.carriers[i].law;
    out[i].cable_stiffness_n_m = plan.cable.compensate_stretch ? plan.cable.stiffness_n_m : 0.0;
    out[i].winch_lag_s = plan.winch.time_constant_s;
    out[i].vehicle_lag_s = plan.carriers[i].vehicle.time_constant_s;
  }
  for (const Edge& edge : plan.cycle.edges) {
    const auto from = index.find(edge.from);
    const auto to = index.find(edge.to);
    GYRE_ENSURE(from != index.end() && to != index.end(), "both ends of an edge are carriers of its plan");
    const std::size_t k = from->second;
    const std::size_t l = to->second;
    // d_j = (r_k − r_l) / |r_k − r_l|; +lambda_j d_j at k, −lambda_j d_j at l: no net force, no net moment.
    const Eigen::Vector3d d = (arms[k] - arms[l]).normalized();
    out[k].outgoing = {d, edge.offset_n, edge.amplitude_n, edge.phase_rad};
    out[l].incoming = {-d, edge.offset_n, edge.amplitude_n, edge.phase_rad};
  }
  return out;
}

}  // namespace gyre::mechanics
