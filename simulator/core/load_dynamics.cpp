#include "simulator/core/load_dynamics.hpp"

#include <Eigen/LU>

#include "common/base/ensure.hpp"
#include "common/mechanics/grasp.hpp"

namespace gyre::simulator {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using mechanics::skew;
using AttitudeMap = Eigen::Matrix<double, 4, 3>;

// Where the parts of the state stand.
constexpr int kPosition = 0;
constexpr int kVelocity = 3;
constexpr int kAttitude = 6;
constexpr int kSpin = 10;

/// γ: slow against every motion of a load, so that it costs no step; fast against the drift at the tolerances used.
constexpr double kUnitAttraction_1_s = 1.0;

/// Nearer than this the direction of a cable means nothing, and neither does its pull.
constexpr double kShortestCable_m = 1e-9;

/// E(h): h ⊗ ω = E(h) ω, and Im(h* ⊗ δh) = E(h)ᵀ δh.
AttitudeMap attitude_map(const Eigen::Vector4d& h) {
  AttitudeMap e;
  // clang-format off
  e << -h(1), -h(2), -h(3),
        h(0), -h(3),  h(2),
        h(3),  h(0), -h(1),
       -h(2),  h(1),  h(0);
  // clang-format on
  return e;
}

Matrix3d rotation_of(const Eigen::Vector4d& h) {
  return Quaterniond(h(0), h(1), h(2), h(3)).normalized().toRotationMatrix();
}

}  // namespace

RigidLoad rigid_load(const mechanics::Plan& plan) {
  RigidLoad load;
  load.mass_kg = plan.load.mass_kg;
  load.inertia_b_kg_m2 = plan.load.inertia_b_kg_m2;
  for (const mechanics::Carrier& carrier : plan.carriers) load.attachments_b_m.push_back(carrier.attachment_b_m);
  load.cable = plan.cable;
  load.gravity_m_s2 = plan.gravity_m_s2;
  load.origin_w_m = plan.load.position_w_m;
  return load;
}

LoadDynamics::LoadDynamics(RigidLoad load)
    : load_(std::move(load)), inverse_inertia_b_(load_.inertia_b_kg_m2.inverse()) {
  GYRE_ENSURE(load_.mass_kg > 0.0 && inverse_inertia_b_.allFinite(), "a load has mass and inertia");
}

StateVector LoadDynamics::pack(const LoadMotion& motion) const {
  StateVector y;
  y.segment<3>(kPosition) = motion.position_w_m - load_.origin_w_m;
  y.segment<3>(kVelocity) = motion.velocity_w_m_s;
  const Quaterniond h = motion.orientation_w_b.normalized();
  y.segment<4>(kAttitude) << h.w(), h.x(), h.y(), h.z();
  y.segment<3>(kSpin) = motion.angular_velocity_b_rad_s;
  return y;
}

LoadMotion LoadDynamics::unpack(const StateVector& y) const {
  const Eigen::Vector4d h = y.segment<4>(kAttitude);
  return {load_.origin_w_m + y.segment<3>(kPosition), y.segment<3>(kVelocity),
          Quaterniond(h(0), h(1), h(2), h(3)).normalized(), y.segment<3>(kSpin)};
}

/// A cable's length, how fast its ends part, and what it makes of that.
struct LoadDynamics::Stretch {
  double length_m = 0.0;
  Vector3d n = Vector3d::Zero();
  Vector3d parting_w_m_s = Vector3d::Zero();
  double tension_n = 0.0;
};

LoadDynamics::Stretch LoadDynamics::stretch(const Vector3d& b, const Eigen::Ref<const StateVector>& y,
                                            const Matrix3d& rotation, const Anchor& anchor) const {
  Stretch out;
  const Vector3d omega = y.segment<3>(kSpin);
  const Vector3d d = (anchor.position_w_m - load_.origin_w_m) - y.segment<3>(kPosition) - rotation * b;
  out.length_m = d.norm();
  if (out.length_m < kShortestCable_m) return out;
  out.n = d / out.length_m;
  out.parting_w_m_s = anchor.velocity_w_m_s - y.segment<3>(kVelocity) - rotation * omega.cross(b);
  if (out.length_m <= anchor.unstretched_length_m) return out;
  // s = max(0, k (l − l0) + c (l' − l0'))
  const double pull_n = load_.cable.stiffness_n_m * (out.length_m - anchor.unstretched_length_m) +
                        load_.cable.damping_n_s_m * (out.n.dot(out.parting_w_m_s) - anchor.unstretched_rate_m_s);
  // Not std::max, which would make a slack cable of an anchor that is not a number.
  out.tension_n = pull_n < 0.0 ? 0.0 : pull_n;
  return out;
}

CablePull LoadDynamics::pull(std::size_t attachment, const LoadMotion& motion, const Anchor& anchor) const {
  const StateVector y = pack(motion);
  const Stretch s =
      stretch(load_.attachments_b_m[attachment], y, motion.orientation_w_b.normalized().toRotationMatrix(), anchor);
  return {s.length_m, s.tension_n, s.n};
}

void LoadDynamics::derivative(const Eigen::Ref<const StateVector>& y, const Surroundings& surroundings,
                              Eigen::Ref<StateVector> dy) const {
  const Eigen::Vector4d h = y.segment<4>(kAttitude);
  const Vector3d omega = y.segment<3>(kSpin);
  const Matrix3d rotation = rotation_of(h);

  Vector3d force_w = surroundings.force_w_n;
  Vector3d moment_b = Vector3d::Zero();
  for (std::size_t i = 0; i < load_.attachments_b_m.size(); ++i) {
    const Vector3d& b = load_.attachments_b_m[i];
    const Stretch cable = stretch(b, y, rotation, surroundings.anchors[i]);
    if (cable.tension_n == 0.0) continue;
    const Vector3d pull_w = cable.tension_n * cable.n;
    force_w += pull_w;
    moment_b += b.cross(rotation.transpose() * pull_w);
  }

  // p' = v
  dy.segment<3>(kPosition) = y.segment<3>(kVelocity);
  // v' = (Σ s n + F) / m − g e_z
  dy.segment<3>(kVelocity) = force_w / load_.mass_kg - load_.gravity_m_s2 * Vector3d::UnitZ();
  // h' = ½ h ⊗ ω + γ (1 − |h|²) h
  dy.segment<4>(kAttitude) = 0.5 * attitude_map(h) * omega + kUnitAttraction_1_s * (1.0 - h.squaredNorm()) * h;
  // ω' = J⁻¹ (Σ b × Rᵀ s n − ω × J ω)
  dy.segment<3>(kSpin) = inverse_inertia_b_ * (moment_b - omega.cross(load_.inertia_b_kg_m2 * omega));
}

void LoadDynamics::jacobian(const Eigen::Ref<const StateVector>& y, const Surroundings& surroundings,
                            Eigen::Ref<StateMatrix> out) const {
  const Eigen::Vector4d h = y.segment<4>(kAttitude);
  const Vector3d omega = y.segment<3>(kSpin);
  const Matrix3d rotation = rotation_of(h);
  const double k = load_.cable.stiffness_n_m;
  const double c = load_.cable.damping_n_s_m;

  // Columns: δp, δv, δφ (a rotation in B: R becomes R (I + [δφ]x)), δω. Rows: force in W, moment in B.
  Eigen::Matrix<double, 3, 12> force = Eigen::Matrix<double, 3, 12>::Zero();
  Eigen::Matrix<double, 3, 12> moment = Eigen::Matrix<double, 3, 12>::Zero();
  for (std::size_t i = 0; i < load_.attachments_b_m.size(); ++i) {
    const Vector3d& b = load_.attachments_b_m[i];
    const Stretch cable = stretch(b, y, rotation, surroundings.anchors[i]);
    if (cable.tension_n == 0.0) continue;
    const Eigen::RowVector3d n = cable.n.transpose();
    // δn = T δd, T = (I − n n') / l
    const Matrix3d turn = (Matrix3d::Identity() - cable.n * n) / cable.length_m;
    // δd = −δp + D δφ,   δ(A' − v − R(ω × b)) = −δv + U δφ + D δω,   D = R [b]x,   U = R [ω × b]x
    const Matrix3d arm = rotation * skew(b);
    const Matrix3d swing = rotation * skew(omega.cross(b));
    const Eigen::RowVector3d along_d = k * n + c * cable.parting_w_m_s.transpose() * turn;

    Eigen::Matrix<double, 1, 12> tension;
    tension << -along_d, -c * n, along_d * arm + c * n * swing, c * n * arm;
    Eigen::Matrix<double, 3, 12> pull = cable.n * tension;
    pull.block<3, 3>(0, 0) -= cable.tension_n * turn;
    pull.block<3, 3>(0, 6) += cable.tension_n * turn * arm;
    force += pull;

    // δ(Rᵀ f) = Rᵀ δf + [Rᵀ f]x δφ
    Eigen::Matrix<double, 3, 12> pull_b = rotation.transpose() * pull;
    pull_b.block<3, 3>(0, 6) += skew(rotation.transpose() * (cable.tension_n * cable.n));
    moment += skew(b) * pull_b;
  }
  force /= load_.mass_kg;
  moment.block<3, 3>(0, 9) += skew(load_.inertia_b_kg_m2 * omega) - skew(omega) * load_.inertia_b_kg_m2;
  moment = (inverse_inertia_b_ * moment).eval();

  // δφ = 2 E(h)ᵀ δh / |h|²
  const AttitudeMap e = attitude_map(h);
  const Eigen::Matrix<double, 3, 4> turned = 2.0 / h.squaredNorm() * e.transpose();
  out.setZero();
  out.block<3, 3>(kPosition, kVelocity).setIdentity();
  const auto fill = [&](int row, const Eigen::Matrix<double, 3, 12>& by) {
    out.block<3, 6>(row, kPosition) = by.leftCols<6>();
    out.block<3, 4>(row, kAttitude) = by.block<3, 3>(0, 6) * turned;
    out.block<3, 3>(row, kSpin) = by.rightCols<3>();
  };
  fill(kVelocity, force);
  fill(kSpin, moment);

  // h ⊗ ω is linear in h: Ω(ω) h.
  Eigen::Matrix4d spin = Eigen::Matrix4d::Zero();
  spin.topRightCorner<1, 3>() = -omega.transpose();
  spin.bottomLeftCorner<3, 1>() = omega;
  spin.bottomRightCorner<3, 3>() = -skew(omega);
  out.block<4, 4>(kAttitude, kAttitude) =
      0.5 * spin +
      kUnitAttraction_1_s * ((1.0 - h.squaredNorm()) * Eigen::Matrix4d::Identity() - 2.0 * h * h.transpose());
  out.block<4, 3>(kAttitude, kSpin) = 0.5 * e;
}

}  // namespace gyre::simulator
