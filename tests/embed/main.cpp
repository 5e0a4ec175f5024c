// The least that a vehicle's own software needs of Gyre: is the plan admissible, and what has carrier 1 to do now?

#include <cmath>
#include <cstdio>
#include <gyre/base/angle.hpp>
#include <gyre/mechanics/certificate.hpp>
#include <gyre/mechanics/reference.hpp>

namespace {

/// Three carriers on a ring over the load, phases after the headings of the edges: each flies a circle.
gyre::mechanics::Plan ring() {
  gyre::mechanics::Plan plan;
  plan.load.mass_kg = 0.3;
  plan.load.inertia_b_kg_m2 = 0.01 * Eigen::Matrix3d::Identity();
  plan.cable.stiffness_n_m = 1e4;
  plan.cycle.rate_rad_s = 1.0;
  for (const unsigned id : {1U, 2U, 3U}) {
    const double angle = gyre::kTwoPi * id / 3.0;
    plan.carriers.push_back({id, {std::cos(angle), std::sin(angle), 0.1}, gyre::mechanics::LengthLaw::level(2.0)});
    plan.cycle.edges.push_back({id, id % 3 + 1, 0.0, 0.3, angle + 5.0 * gyre::kPi / 6.0});
  }
  plan.limits.speed_min_m_s = 0.1;
  return plan;
}

}  // namespace

int main() {
  namespace mechanics = gyre::mechanics;
  const mechanics::Plan plan = ring();
  const mechanics::Certificate certificate = mechanics::certify(plan);
  for (const mechanics::Reason& reason : certificate.reasons)
    std::printf("%s: %s\n", name(reason.rule), reason.text.c_str());
  if (!certificate.admissible()) return 1;

  Eigen::Vector3d held_n = Eigen::Vector3d::Zero();
  for (const mechanics::CarrierSlice& slice : mechanics::slices(plan)) {
    const mechanics::Reference now = mechanics::evaluate(slice, 0.7);
    const Eigen::Vector3d& p = now.position_w_m.value;
    std::printf("carrier %u: at (%.3f, %.3f, %.3f) m, %.3f m/s, cable %.3f m\n", slice.id, p.x(), p.y(), p.z(),
                now.position_w_m.first.norm(), now.length_m.value);
    held_n += now.force_w_n.value;
  }
  const double weight_n = plan.load.mass_kg * plan.gravity_m_s2;
  return (held_n - Eigen::Vector3d(0.0, 0.0, weight_n)).norm() < 1e-12 * weight_n ? 0 : 1;
}
