#include "common/mechanics/grasp.hpp"

#include <Eigen/QR>

namespace gyre::mechanics {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  // clang-format off
  m <<    0, -v.z(),  v.y(),
      v.z(),      0, -v.x(),
     -v.y(),  v.x(),      0;
  // clang-format on
  return m;
}

GraspMap grasp_map(const std::vector<Eigen::Vector3d>& lever_arms_w) {
  GraspMap g(6, 3 * static_cast<Eigen::Index>(lever_arms_w.size()));
  Eigen::Index column = 0;
  for (const Eigen::Vector3d& r : lever_arms_w) {
    g.block<3, 3>(0, column).setIdentity();
    g.block<3, 3>(3, column) = skew(r);
    column += 3;
  }
  return g;
}

Vector6d holding_wrench(double mass_kg, double gravity_m_s2) {
  Vector6d w = Vector6d::Zero();
  w(2) = mass_kg * gravity_m_s2;
  return w;
}

ParticularForce particular_force(const std::vector<Eigen::Vector3d>& lever_arms_w, const Vector6d& wrench_w) {
  const GraspMap g = grasp_map(lever_arms_w);
  // Rank deficient for one carrier and for collinear attachments, so not a Cholesky of G G'.
  const Eigen::VectorXd f = g.completeOrthogonalDecomposition().solve(wrench_w);
  ParticularForce result;
  for (Eigen::Index i = 0; i < f.size(); i += 3) result.forces_w_n.emplace_back(f.segment<3>(i));
  result.residual = (g * f - wrench_w).norm();
  return result;
}

}  // namespace gyre::mechanics
