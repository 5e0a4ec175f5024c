#pragma once
// How a rigid load moves when elastic cables pull on it: Newton and Euler, and cables that pull or do nothing.
//
//   symbol   meaning                                              shape   frame   unit
//   p, v     load centre of mass and its velocity                 3       W       m, m/s
//   R, h     orientation, matrix and quaternion (w, x, y, z)      3x3, 4  W <- B  -
//   ω        angular velocity                                     3       B       rad/s
//   b        attachment of a cable                                3       B       m
//   A, A'    where the cable's other end is (the anchor)          3       W       m, m/s
//   l, l0    length of the cable, stretched and unstretched       1       -       m
//   n        direction from attachment to anchor                  3       W       -
//   s        tension                                              1       -       N
//
//   s = max(0, k (l − l0) + c (l' − l0')) where l > l0, else 0                                  (cable)
//   m v' = Σ s n − m g e_z + F                                                                  (Newton)
//   J ω' = Σ b × Rᵀ(s n) − ω × J ω                                                              (Euler)
//   h'   = ½ h ⊗ ω + γ (1 − |h|²) h                                                             (attitude)
//
// The last term makes |h| = 1 an attractor, so that a multistep integrator needs no renormalisation, which would cost
// it its history; R is that of h/|h|, so the term changes no motion.
//
// Stiff: with the paper's load and cables the fastest mode is at 3.4e5 1/s. The Jacobian is exact, slack included.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "common/mechanics/plan.hpp"

namespace gyre::simulator {

struct RigidLoad {
  double mass_kg = 0.0;
  Eigen::Matrix3d inertia_b_kg_m2 = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Vector3d> attachments_b_m;
  mechanics::Cable cable;
  double gravity_m_s2 = 9.81;
  /// Positions are integrated as displacements from here: accuracy must not depend on where the world has its zero.
  Eigen::Vector3d origin_w_m = Eigen::Vector3d::Zero();
};

/// The load of a plan, with its origin where the plan holds it.
[[nodiscard]] RigidLoad rigid_load(const mechanics::Plan& plan);

struct LoadMotion {
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_w_b = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_b_rad_s = Eigen::Vector3d::Zero();
};

/// The far end of one cable: the carrier it hangs from, and what its winch has paid out.
struct Anchor {
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
  double unstretched_length_m = 0.0;
  double unstretched_rate_m_s = 0.0;
};

/// Everything that acts on the load besides gravity; one anchor per attachment, in the same order.
struct Surroundings {
  std::vector<Anchor> anchors;
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();  ///< at the centre of mass: wind
};

struct CablePull {
  double length_m = 0.0;
  double tension_n = 0.0;
  Eigen::Vector3d direction_w = Eigen::Vector3d::Zero();
};

/// Displacement from the origin, velocity, quaternion (w, x, y, z), angular velocity.
using StateVector = Eigen::Matrix<double, 13, 1>;
using StateMatrix = Eigen::Matrix<double, 13, 13>;

class LoadDynamics {
 public:
  explicit LoadDynamics(RigidLoad load);

  [[nodiscard]] const RigidLoad& load() const { return load_; }
  [[nodiscard]] StateVector pack(const LoadMotion& motion) const;
  [[nodiscard]] LoadMotion unpack(const StateVector& state) const;  ///< the quaternion comes out unit

  void derivative(const Eigen::Ref<const StateVector>& state, const Surroundings& surroundings,
                  Eigen::Ref<StateVector> derivative) const;
  void jacobian(const Eigen::Ref<const StateVector>& state, const Surroundings& surroundings,
                Eigen::Ref<StateMatrix> jacobian) const;

  /// What the cable at this attachment does now.
  [[nodiscard]] CablePull pull(std::size_t attachment, const LoadMotion& motion, const Anchor& anchor) const;

 private:
  struct Stretch;
  [[nodiscard]] Stretch stretch(const Eigen::Vector3d& attachment_b, const Eigen::Ref<const StateVector>& state,
                                const Eigen::Matrix3d& rotation, const Anchor& anchor) const;

  RigidLoad load_;
  Eigen::Matrix3d inverse_inertia_b_;
};

}  // namespace gyre::simulator
