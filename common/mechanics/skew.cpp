#include "common/mechanics/skew.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/mechanics/grasp.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/stiffness.hpp"

namespace gyre::mechanics {
namespace {

/// max |df_i| over all time: df = rate (a cos + b sin), whose greatest norm is the larger semi-axis of its ellipse.
double force_rate_max(const CarrierSlice& c) {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const EdgePush* edge : {&c.incoming, &c.outgoing}) {
    a += edge->amplitude_n * std::cos(edge->phase_rad) * edge->direction;
    b -= edge->amplitude_n * std::sin(edge->phase_rad) * edge->direction;
  }
  const double mean = 0.5 * (a.squaredNorm() + b.squaredNorm());
  const double half = 0.5 * (a.squaredNorm() - b.squaredNorm());
  return std::abs(c.rate_rad_s) * std::sqrt(mean + std::hypot(half, a.dot(b)));
}

double residual_n_per_s(const std::vector<CarrierSlice>& slices) {
  double sum = 0.0;
  for (const CarrierSlice& slice : slices) sum += force_rate_max(slice);
  return 0.5 * sum;
}

double displacement_m_per_s(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s) {
  constexpr int kSamples = 128;
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double t_s = period_s * i / kSamples;
    const Eigen::PartialPivLU<Matrix6d> stiffness(load_stiffness(plan, slices, t_s));
    for (const CarrierSlice& slice : slices) {
      const Eigen::Vector3d rate = force(slice, t_s).first;
      const Eigen::Vector3d r = slice.attachment_w_m - plan.load.position_w_m;
      Vector6d wrench;
      wrench << rate, r.cross(rate);
      worst = std::max(worst, stiffness.solve(wrench).head<3>().norm());
    }
  }
  return worst;
}

}  // namespace

double skew_budget_s(const std::vector<CarrierSlice>& slices, double weight_n) {
  const double residual = residual_n_per_s(slices);
  return residual > 0.0 ? kSkewShare * weight_n / residual : std::numeric_limits<double>::infinity();
}

SkewBudget skew_budget(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s) {
  SkewBudget budget;
  budget.residual_n_per_s = residual_n_per_s(slices);
  budget.displacement_m_per_s = displacement_m_per_s(plan, slices, period_s);
  budget.budget_s = skew_budget_s(slices, plan.load.mass_kg * plan.gravity_m_s2);
  budget.holdover_s = budget.budget_s / kHoldoverDrift;
  return budget;
}

}  // namespace gyre::mechanics
