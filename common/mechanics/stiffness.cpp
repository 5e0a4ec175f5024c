#include "common/mechanics/stiffness.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "common/base/angle.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/range.hpp"

namespace gyre::mechanics {

void add_stiffness(const Cable& c, const Reference& reference, const Eigen::Vector3d& r_w_m, Matrix6d& k_load) {
  const Eigen::Vector3d& f = reference.force_w_n.value;
  const Eigen::Vector3d& q = reference.direction_w.value;
  const Eigen::Matrix3d along = q * q.transpose();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
  const Eigen::Matrix3d turn = -skew(r_w_m);
  const Eigen::Matrix3d moment = f * r_w_m.transpose();
  // J' [k q q' + (s/l)(I − q q')] J + (0 (+) ((f·r) I − sym(f r'))),  J = [I, −[r]x]
  const Eigen::Matrix3d held = c.stiffness_n_m * along + reference.tension_n.value / reference.length_m.value * across;
  const Eigen::Matrix3d coupled = held * turn;
  k_load.topLeftCorner<3, 3>() += held;
  k_load.topRightCorner<3, 3>() += coupled;
  k_load.bottomLeftCorner<3, 3>() += coupled.transpose();
  k_load.bottomRightCorner<3, 3>() +=
      turn.transpose() * coupled + f.dot(r_w_m) * Eigen::Matrix3d::Identity() - 0.5 * (moment + moment.transpose());
}

Matrix6d load_stiffness(const Plan& plan, const std::vector<CarrierSlice>& slices, double t_s) {
  Matrix6d k_load = Matrix6d::Zero();
  for (const CarrierSlice& slice : slices) {
    add_stiffness(plan.cable, evaluate(slice, t_s), slice.attachment_w_m - plan.load.position_w_m, k_load);
  }
  return k_load;
}

Matrix6d load_inertia(const Load& load) {
  const Eigen::Matrix3d rotation = load.orientation_w_b.toRotationMatrix();
  Matrix6d inertia = Matrix6d::Zero();
  inertia.topLeftCorner<3, 3>() = load.mass_kg * Eigen::Matrix3d::Identity();
  inertia.bottomRightCorner<3, 3>() = rotation * load.inertia_b_kg_m2 * rotation.transpose();
  return inertia;
}

double least_stiffness(const Plan& plan, const std::vector<CarrierSlice>& slices, double period_s) {
  const Matrix6d inertia = load_inertia(plan.load);
  const auto eigenvalue = [&](double t_s) {
    const Matrix6d k = load_stiffness(plan, slices, t_s);
    return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d>(k, inertia, Eigen::EigenvaluesOnly).eigenvalues()(0);
  };
  const double turns = std::clamp(period_s * std::abs(plan.cycle.rate_rad_s) / kTwoPi, 1.0, 16.0);
  const auto samples = static_cast<int>(std::lround(256.0 * turns));
  const double step = period_s / samples;
  std::vector<double> grid;
  Range range;
  for (int i = 0; i < samples; ++i) range.include(grid.emplace_back(eigenvalue(step * i)));

  // Any valley of the grid may hold the least: the deepest are the narrowest, and look shallow between two samples.
  const bool flat = range.span() <= 1e-9 * std::abs(range.max);
  for (int i = 0; i < samples && !flat; ++i) {
    const auto at = [&grid, samples](int k) { return grid[static_cast<std::size_t>((k + samples) % samples)]; };
    if (at(i) > at(i - 1) || at(i) > at(i + 1)) continue;
    constexpr int kBits = 26;
    range.include(boost::math::tools::brent_find_minima(eigenvalue, step * (i - 1), step * (i + 1), kBits).second);
  }
  return range.min;
}

}  // namespace gyre::mechanics
