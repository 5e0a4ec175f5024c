#include "common/base/text.hpp"
#include "coordinator/core/coordinator.hpp"

namespace gyre::coordinator {

std::optional<std::string> retune_obstacle(const mechanics::Plan& flown, const mechanics::Plan& wanted) {
  // Mixtures hold the load only if both plans hold the same one, by the same points (mechanics/transition.hpp).
  const auto& a = flown.load;
  const auto& b = wanted.load;
  if (a.mass_kg != b.mass_kg || flown.gravity_m_s2 != wanted.gravity_m_s2) {
    return "the load's weight differs from the one that is flown; a flight keeps its load";
  }
  if (a.position_w_m != b.position_w_m || !a.orientation_w_b.isApprox(b.orientation_w_b)) {
    return "the load's pose differs from the one that is flown; a flight keeps the load where it is";
  }
  // The cable is the same piece of rope: another stiffness would step the winches by the difference in stretch.
  if (flown.cable.stiffness_n_m != wanted.cable.stiffness_n_m ||
      flown.cable.compensate_stretch != wanted.cable.compensate_stretch) {
    return "the cables' stiffness, or whether their stretch is compensated, differs from the ones that are flown";
  }
  if (flown.carriers.size() != wanted.carriers.size()) {
    return text("it has %zu carriers, %zu are flying", wanted.carriers.size(), flown.carriers.size());
  }
  for (const mechanics::Carrier& carrier : flown.carriers) {
    const mechanics::Carrier* same = nullptr;
    for (const mechanics::Carrier& other : wanted.carriers) {
      if (other.id == carrier.id) same = &other;
    }
    if (same == nullptr) return text("it has no carrier %u, which is flying", carrier.id);
    if (same->attachment_b_m != carrier.attachment_b_m) {
      return text("carrier %u is attached elsewhere on the load than the one that is flying", carrier.id);
    }
  }
  return std::nullopt;
}

}  // namespace gyre::coordinator
