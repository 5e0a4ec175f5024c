#include "common/mechanics/rest_plan.hpp"

#include "common/mechanics/certificate.hpp"

namespace gyre::mechanics {

Plan rest_plan(const Plan& plan) {
  Plan centre = plan;
  for (Edge& edge : centre.cycle.edges) edge.amplitude_n = 0.0;
  for (Carrier& carrier : centre.carriers) carrier.law.profile.swing = 0.0;

  CertifyOptions still;
  still.non_stop = false;
  still.stiffness = false;
  return certify(centre, still).admissible() ? centre : static_plan(plan, 0.0);
}

}  // namespace gyre::mechanics
