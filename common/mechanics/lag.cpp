#include "common/mechanics/lag.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "common/mechanics/grasp.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mechanics/stiffness.hpp"

namespace gyre::mechanics {
namespace {

/// What late winches and late vehicles pull the load by, by themselves.
struct Pull {
  Vector6d winches = Vector6d::Zero();
  Vector6d vehicles = Vector6d::Zero();
};

Pull pull_at(const Plan& plan, const std::vector<CarrierSlice>& slices, double t_s) {
  Pull out;
  const double k = plan.cable.stiffness_n_m;
  for (const CarrierSlice& slice : slices) {
    const Reference r = evaluate(slice, t_s);
    const Eigen::Vector3d& q = r.direction_w.value;
    const Eigen::Vector3d place_m = -kLagError * slice.vehicle_lag_s * r.position_w_m.first;
    const double length_m = -kLagError * slice.winch_lag_s * paid_out(r, slice.cable_stiffness_n_m).first;
    // (k q q' + (s/l)(I − q q')) dp − k q dL
    const double along_m = q.dot(place_m);
    const Eigen::Vector3d moved = k * along_m * q + r.tension_n.value / r.length_m.value * (place_m - along_m * q);
    const Eigen::Vector3d wound = -k * length_m * q;
    const Eigen::Vector3d arm = slice.attachment_w_m - plan.load.position_w_m;
    const auto add = [&arm](Vector6d& wrench, const Eigen::Vector3d& f) {
      wrench.head<3>() += f;
      wrench.tail<3>() += arm.cross(f);
    };
    add(out.vehicles, moved);
    add(out.winches, wound);
  }
  return out;
}

}  // namespace

double lag_error_displacement_m(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s) {
  const bool lags = std::any_of(slices.begin(), slices.end(),
                                [](const CarrierSlice& c) { return c.winch_lag_s > 0.0 || c.vehicle_lag_s > 0.0; });
  if (!lags) return 0.0;
  constexpr int kSamples = 128;
  double worst_m = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double t_s = period_s * i / kSamples;
    const Eigen::PartialPivLU<Matrix6d> stiffness(load_stiffness(plan, slices, t_s));
    const Pull pull = pull_at(plan, slices, t_s);
    for (const Vector6d& wrench : {Vector6d(pull.winches + pull.vehicles), Vector6d(pull.winches - pull.vehicles)})
      worst_m = std::max(worst_m, stiffness.solve(wrench).head<3>().norm());
  }
  return worst_m;
}

}  // namespace gyre::mechanics
