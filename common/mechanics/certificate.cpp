#include "common/mechanics/certificate.hpp"

#include <cmath>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/judgement.hpp"
#include "common/mechanics/lag.hpp"
#include "common/mechanics/orbit_figures.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/separation.hpp"
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

std::optional<Separation> orbit_separation(const std::vector<CarrierSlice>& slices, const Certificate& certificate) {
  std::vector<Path> paths;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const CarrierFigures& figures = certificate.carriers[i];
    paths.push_back({figures.id, figures.speed_m_s.max, figures.acceleration_max_m_s2,
                     [&slice = slices[i]](double t_s) { return evaluate(slice, t_s).position_w_m; }});
  }
  return separation(paths, 0.0, certificate.period_s);
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
  for (const CarrierSlice& slice : all) {
    const Carrier& carrier = plan.carriers[certificate.carriers.size()];
    certificate.carriers.push_back(orbit_figures(slice, weight(carrier.vehicle, plan.gravity_m_s2)));
    const Range& length = certificate.carriers.back().length_m;
    stretched = stretched && length.min > 0.0 && std::isfinite(length.max);
    judge_carrier(certificate.carriers.back(), plan.limits, options.non_stop, certificate.reasons);
    judge_machines(certificate.carriers.back(), plan.winch, carrier.vehicle, certificate.reasons);
  }
  if (options.separation) certificate.separation = orbit_separation(all, certificate);
  if (options.stiffness && stretched) {
    certificate.stiffness_min_1_s2 = least_stiffness(plan, all, certificate.period_s);
    certificate.skew = skew_budget(plan, all, certificate.period_s);
    certificate.lag_error_displacement_m = lag_error_displacement_m(plan, all, certificate.period_s);
    if (*certificate.stiffness_min_1_s2 <= 0.0) {
      certificate.cautions.push_back(
          {Rule::kStiffness, std::nullopt,
           "at some moments the cables do not pull the load back to its pose, and a swing may grow; attach the cables "
           "higher above the centre of mass, shorten them, or choose offsets that pull the attachments apart"});
    }
  }
  if (certificate.separation) judge_separation(*certificate.separation, plan.limits, certificate.reasons);
  return certificate;
}

}  // namespace gyre::mechanics
