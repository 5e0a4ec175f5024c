#include "common/mechanics/frozen_slice.hpp"

#include <cmath>

namespace gyre::mechanics {

CarrierSlice frozen_slice(const std::vector<TimedLayer>& layers, double t_s) {
  const Reference reference = evaluate_course(layers.data(), layers.size(), t_s);
  CarrierSlice slice = *layers.back().slice;
  slice.particular_force_w_n = reference.force_w_n.value;
  slice.incoming = EdgePush{};
  slice.outgoing = EdgePush{};
  const LengthLaw& law = layers.back().slice->law;
  if (layers.size() == 1 && law.is_projection()) {
    // The projection is kept, so that the way to the frozen place keeps the altitude as the motion did.
    const double projection = law.direction.dot(reference.position_w_m.value);
    slice.law.profile = Oscillation{projection, 0.0, {}, 0.0};
  } else {
    slice.law = LengthLaw::fixed(reference.length_m.value);
  }
  return slice;
}

}  // namespace gyre::mechanics
