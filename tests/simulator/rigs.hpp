#pragma once
// Things to hang a load from, small enough to know the answer by hand, and the paper's example.

#include <array>

#include "common/base/angle.hpp"
#include "common/mechanics/plan.hpp"
#include "common/mechanics/reference.hpp"
#include "simulator/core/load_integrator.hpp"

namespace gyre::simulator::rigs {

/// The paper's four carriers at constant altitude, on the cables of the reference figures.
inline mechanics::Plan paper() {
  const std::array<Eigen::Vector3d, 4> attachments = {
      Eigen::Vector3d(-0.036, 1.2, 0.256), Eigen::Vector3d(-1.183, -0.201, 0.254),
      Eigen::Vector3d(0.195, -1.184, 0.244), Eigen::Vector3d(1.18, 0.222, 0.35)};
  const std::array<double, 4> altitudes_m = {0.627, 0.67, 0.606, 0.807};
  const std::array<double, 4> phases_rad = {1.77, 0.5 * kPi, 1.77, 0.5 * kPi};

  mechanics::Plan plan;
  plan.load.mass_kg = 0.3;
  plan.load.inertia_b_kg_m2 = 0.01 * Eigen::Matrix3d::Identity();
  plan.cable = {1e4, 1e3};
  plan.cycle.rate_rad_s = 0.08;
  for (CarrierId id = 1; id <= 4; ++id) {
    plan.carriers.push_back({id, attachments[id - 1], mechanics::LengthLaw::level(altitudes_m[id - 1])});
    plan.cycle.edges.push_back({id, id % 4 + 1, 0.0, 1.2, phases_rad[id - 1]});
  }
  return plan;
}

/// A body whose three moments of inertia differ, so that a free rotation tumbles.
inline RigidLoad body() {
  RigidLoad load;
  load.mass_kg = 2.0;
  load.inertia_b_kg_m2 = Eigen::Vector3d(0.02, 0.05, 0.06).asDiagonal();
  load.cable = {1e4, 1e3};
  return load;
}

/// A point mass in effect: one cable at the centre of mass, from an anchor above.
inline RigidLoad bob(const mechanics::Cable& cable) {
  RigidLoad load = body();
  load.attachments_b_m = {Eigen::Vector3d::Zero()};
  load.cable = cable;
  return load;
}

/// Anchors that do not move.
inline SurroundingsAt fixed(std::vector<Anchor> anchors, const Eigen::Vector3d& force_w_n = Eigen::Vector3d::Zero()) {
  return [anchors = std::move(anchors), force_w_n](double /*t_s*/, Surroundings& out) {
    out.anchors = anchors;
    out.force_w_n = force_w_n;
  };
}

enum class Stretch {
  kCompensated,  ///< the winch has paid out l − s/k, so that the stretched cable is l long
  kIgnored,      ///< the winch has paid out l, and the load sags
};

/// A plan flown perfectly: every carrier and every winch exactly where the plan has them, at every moment; t = 0 is its
/// epoch. What remains is the load's own dynamics on elastic cables.
inline SurroundingsAt planned(const mechanics::Plan& plan, Stretch stretch) {
  const double compliance_m_n = stretch == Stretch::kCompensated ? 1.0 / plan.cable.stiffness_n_m : 0.0;
  return [slices = mechanics::slices(plan), compliance_m_n](double t_s, Surroundings& out) {
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const mechanics::Reference reference = mechanics::evaluate(slices[i], t_s);
      // l0 = l − s / k
      const mechanics::Taylor<double> unstretched_m = reference.length_m - compliance_m_n * reference.tension_n;
      out.anchors[i] = {reference.position_w_m.value, reference.position_w_m.first, unstretched_m.value,
                        unstretched_m.first};
    }
  };
}

/// A plan at rest: every carrier and every winch where the plan has them at its beginning.
inline SurroundingsAt resting(const mechanics::Plan& plan, Stretch stretch) {
  Surroundings there;
  there.anchors.resize(plan.carriers.size());
  planned(plan, stretch)(0.0, there);
  for (Anchor& anchor : there.anchors) {
    anchor.velocity_w_m_s.setZero();
    anchor.unstretched_rate_m_s = 0.0;
  }
  return fixed(std::move(there.anchors));
}

inline Anchor anchor_at(const Eigen::Vector3d& position_w_m, double unstretched_length_m) {
  return {position_w_m, Eigen::Vector3d::Zero(), unstretched_length_m, 0.0};
}

}  // namespace gyre::simulator::rigs
