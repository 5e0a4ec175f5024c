#include "common/mechanics/skew.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/mechanics/grasp.hpp"
#include "common/mechanics/quintic.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/stiffness.hpp"

namespace gyre::mechanics {
namespace {

/// The larger semi-axis of a cos + b sin: its greatest norm.
double semi_axis(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double mean = 0.5 * (a.squaredNorm() + b.squaredNorm());
  const double half = 0.5 * (a.squaredNorm() - b.squaredNorm());
  return std::sqrt(mean + std::hypot(half, a.dot(b)));
}

/// f = mean + a cos(rate t) + b sin(rate t), t on a clock on which the plan's epoch is `epoch_s`.
struct Ellipse {
  Eigen::Vector3d mean;
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double rate_rad_s;

  Ellipse(const CarrierSlice& c, double epoch_s) : mean(c.particular_force_w_n), rate_rad_s(c.rate_rad_s) {
    for (const EdgePush* edge : {&c.incoming, &c.outgoing}) {
      const double phase_rad = edge->phase_rad - c.rate_rad_s * epoch_s;
      mean += edge->offset_n * edge->direction;
      a += edge->amplitude_n * std::sin(phase_rad) * edge->direction;
      b += edge->amplitude_n * std::cos(phase_rad) * edge->direction;
    }
  }
  [[nodiscard]] double rate_max_n_s() const { return std::abs(rate_rad_s) * semi_axis(a, b); }
};

/// No less than |f_A − f_B| at any time.
double apart_n(const Ellipse& x, const Ellipse& y) {
  const double turning =
      x.rate_rad_s == y.rate_rad_s ? semi_axis(x.a - y.a, x.b - y.b) : semi_axis(x.a, x.b) + semi_axis(y.a, y.b);
  return (x.mean - y.mean).norm() + turning;
}

/// No less than |f'| of a carrier at any time, also while transitions are under way.
double rate_max_n_s(const std::vector<TimedLayer>& stack) {
  std::vector<Ellipse> below;
  double rate = 0.0;
  for (const TimedLayer& layer : stack) {
    const Ellipse ellipse(*layer.slice, layer.epoch_s);
    double apart = 0.0;  // from the mixture below, which lies between all that is
    for (const Ellipse& other : below) apart = std::max(apart, apart_n(ellipse, other));
    rate = std::max(rate, ellipse.rate_max_n_s());
    if (!below.empty()) rate += kStepSlopePeak / layer.duration_s * apart;
    below.push_back(ellipse);
  }
  return rate;
}

double budget_s(double residual_n_per_s, double weight_n) {
  return residual_n_per_s > 0.0 ? kSkewShare * weight_n / residual_n_per_s : std::numeric_limits<double>::infinity();
}

double residual_n_per_s(const std::vector<CarrierSlice>& slices) {
  double sum = 0.0;
  for (const CarrierSlice& slice : slices) sum += Ellipse(slice, 0.0).rate_max_n_s();
  return 0.5 * sum;
}

double residual_n_m_per_s(const Plan& plan, const std::vector<CarrierSlice>& slices) {
  double sum = 0.0;
  for (const CarrierSlice& slice : slices) {
    const Ellipse f(slice, 0.0);
    const Eigen::Vector3d r = slice.attachment_w_m - plan.load.position_w_m;
    sum += std::abs(f.rate_rad_s) * semi_axis(r.cross(f.a), r.cross(f.b));
  }
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
  return budget_s(residual_n_per_s(slices), weight_n);
}

double skew_budget_s(const std::vector<std::vector<TimedLayer>>& stacks, double weight_n) {
  double sum = 0.0;
  for (const std::vector<TimedLayer>& stack : stacks) sum += rate_max_n_s(stack);
  return budget_s(0.5 * sum, weight_n);
}

SkewBudget skew_budget(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s) {
  SkewBudget budget;
  budget.residual_n_per_s = residual_n_per_s(slices);
  budget.displacement_m_per_s = displacement_m_per_s(plan, slices, period_s);
  budget.budget_s = skew_budget_s(slices, plan.load.mass_kg * plan.gravity_m_s2);
  budget.holdover_s = budget.budget_s / kHoldoverDrift;
  budget.residual_n_m_per_s = residual_n_m_per_s(plan, slices);
  return budget;
}

}  // namespace gyre::mechanics
