#include "simulator/core/planned_surroundings.hpp"

#include "common/mechanics/reference.hpp"

namespace gyre::simulator {

SurroundingsAt planned_surroundings(const mechanics::Plan& plan, Stretch stretch) {
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

}  // namespace gyre::simulator
