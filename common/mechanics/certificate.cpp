#include "common/mechanics/certificate.hpp"

#include <cmath>

#include "common/mechanics/braid.hpp"
#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/clearance.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/judgement.hpp"
#include "common/mechanics/lag.hpp"
#include "common/mechanics/load_hull.hpp"
#include "common/mechanics/orbit_figures.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/stiffness.hpp"

namespace gyre::mechanics {
namespace {

/// max |G f − w| over all time: the residual is c + a sin(theta) + b cos(theta), and |c| + √(|a|² + |b|²) bounds it.
double wrench_error(const Plan& plan, const std::vector<CarrierSlice>& slices) {
  Vector6d mean = -holding_wrench(plan.load.mass_kg, plan.gravity_m_s2);
  Vector6d sine = Vector6d::Zero();
  Vector6d cosine = Vector6d::Zero();
  for (const CarrierSlice& c : slices) {
    const Eigen::Vector3d r = c.attachment_w_m - plan.load.position_w_m;
    const auto add = [&r](Vector6d& wrench, const Eigen::Vector3d& f) {
      wrench.head<3>() += f;
      wrench.tail<3>() += r.cross(f);
    };
    add(mean, c.particular_force_w_n);
    for (const EdgePush* edge : {&c.incoming, &c.outgoing}) {
      add(mean, edge->offset_n * edge->direction);
      add(sine, edge->amplitude_n * std::cos(edge->phase_rad) * edge->direction);
      add(cosine, edge->amplitude_n * std::sin(edge->phase_rad) * edge->direction);
    }
  }
  return mean.norm() + std::sqrt(sine.squaredNorm() + cosine.squaredNorm());
}

/// Everything that must not touch: carriers, cables, vehicles, the load.
void certify_apart(const Plan& plan, const std::vector<CarrierSlice>& slices, Certificate& certificate) {
  std::vector<Hanging> carriers;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    carriers.push_back({slices[i].id, slices[i].attachment_w_m, plan.carriers[i].radius_m,
                        certificate.carriers[i].altitude_m.min, certificate.carriers[i].acceleration_max_m_s2,
                        [&slice = slices[i]](double t_s) { return evaluate(slice, t_s).position_w_m; }});
  }
  const std::vector<Eigen::Vector3d> hull = hull_w(plan.load);
  certificate.separation = separation(carriers, 0.0, certificate.period_s);
  certificate.cable_distance = cable_distance(carriers, 0.0, certificate.period_s);
  certificate.clearance = clearance(carriers, hull, 0.0, certificate.period_s);
  certificate.above_load_min_m = above_load(carriers, hull);

  if (certificate.separation) judge_separation(*certificate.separation, plan.limits, certificate.reasons);
  const std::vector<Braid> braided =
      certificate.clearance ? braids(slices, certificate.period_s) : std::vector<Braid>{};
  judge_braids(braided, certificate.reasons);
  if (certificate.clearance && braided.empty())
    judge_clearance(*certificate.clearance, plan.limits, certificate.reasons);
  if (certificate.above_load_min_m) judge_above_load(*certificate.above_load_min_m, plan.limits, certificate.reasons);
}

}  // namespace

Certificate certify(const Plan& plan, const CertifyOptions& options) {
  Certificate certificate;
  judge_form(plan, certificate.reasons);
  if (!certificate.reasons.empty()) return certificate;
  certificate.period_s = period_s(plan);
  judge_equilibrium(plan, certificate.reasons);

  const std::vector<CarrierSlice> all = slices(plan);
  if (options.non_stop) judge_construction(plan, all, certificate.reasons);
  certificate.wrench_error_max_n = wrench_error(plan, all);
  certificate.carriers.reserve(all.size());
  bool stretched = true;  // lengths are positive and bounded, as stiffness needs them
  bool taut = true;
  for (const CarrierSlice& slice : all) {
    const Carrier& carrier = plan.carriers[certificate.carriers.size()];
    certificate.carriers.push_back(orbit_figures(slice, weight(carrier.vehicle, plan.gravity_m_s2)));
    const Range& length = certificate.carriers.back().length_m;
    stretched = stretched && length.min > 0.0 && std::isfinite(length.max);
    taut = taut && certificate.carriers.back().tension_n.min > 0.0;
    judge_carrier(certificate.carriers.back(), plan.limits, options.non_stop, certificate.reasons);
    judge_machines(certificate.carriers.back(), plan.winch, carrier.vehicle, certificate.reasons);
  }
  if (options.separation) certify_apart(plan, all, certificate);
  if (options.stiffness && stretched) {
    certificate.stiffness_min_1_s2 = least_stiffness(plan, all, certificate.period_s);
    certificate.skew = skew_budget(plan, all, certificate.period_s);
    certificate.lag_error_displacement_m = lag_error_displacement_m(plan, all, certificate.period_s);
    caution_of_stiffness(*certificate.stiffness_min_1_s2, certificate.cautions);
  }
  if (options.swings && taut && certificate.stiffness_min_1_s2) {
    certificate.swings = swings(plan, all, certificate.period_s, *certificate.stiffness_min_1_s2);
    if (options.non_stop) judge_swings(*certificate.swings, certificate.reasons);
    caution_of_swings(*certificate.swings, certificate.cautions);
  }
  return certificate;
}

}  // namespace gyre::mechanics
