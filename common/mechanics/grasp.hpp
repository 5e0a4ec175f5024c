#pragma once
// The grasp map: which forces at the attachments hold the load.
//
//   symbol   meaning                                                     shape    frame   unit
//   r_i      lever arm, load centre of mass to attachment i              3        W       m
//   f_i      force of cable i on the load                                3        W       N
//   w        wrench that balances gravity, (0, 0, mg, 0, 0, 0)           6        W       N, N m
//   G        grasp map                                                   6x3n
//
//   G = [ I .. I ; [r_1]x .. [r_n]x ],   G f = w                                              (equilibrium)
//   f0 = pinv(G) w                                                                            (particular force)
//
// Source: Franchi, Landi, Gabellieri, equilibrium and particular force; minimum norm as in the paper's figures.

#include <Eigen/Core>
#include <vector>

namespace gyre::mechanics {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using GraspMap = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// [v]x: skew(v) · a = v × a.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// At least one lever arm, as for the particular force below.
[[nodiscard]] GraspMap grasp_map(const std::vector<Eigen::Vector3d>& lever_arms_w);

/// The wrench the cables must exert on a load of this weight.
[[nodiscard]] Vector6d holding_wrench(double mass_kg, double gravity_m_s2);

struct ParticularForce {
  std::vector<Eigen::Vector3d> forces_w_n;
  /// |G f0 − w|: above rounding, no forces at these attachments hold the load in this pose.
  double residual = 0.0;
};

[[nodiscard]] ParticularForce particular_force(const std::vector<Eigen::Vector3d>& lever_arms_w,
                                               const Vector6d& wrench_w);

}  // namespace gyre::mechanics
