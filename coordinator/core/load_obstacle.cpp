#include "coordinator/core/load_obstacle.hpp"

#include <cmath>

#include "common/base/text.hpp"

namespace gyre::coordinator {
namespace {

/// Rounding on another machine is a million times less, a difference that matters a thousand times more.
constexpr double kRelative = 1e-6;
constexpr double kLength_m = 1e-6;

bool alike(double a, double b) {
  return std::abs(a - b) <= kRelative * std::max(std::abs(a), std::abs(b));
}
bool alike(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double scale) {
  return (a - b).norm() <= kRelative * scale;
}

}  // namespace

std::optional<std::string> load_obstacle(const mechanics::Plan& flown, const mechanics::Plan& wanted) {
  const auto& a = flown.load;
  const auto& b = wanted.load;
  if (!alike(a.mass_kg * flown.gravity_m_s2, b.mass_kg * wanted.gravity_m_s2)) {
    return text("the load weighs %.6g N, the one that is flown %.6g N; a flight keeps its load",
                b.mass_kg * wanted.gravity_m_s2, a.mass_kg * flown.gravity_m_s2);
  }
  if ((a.inertia_b_kg_m2 - b.inertia_b_kg_m2).norm() > kRelative * a.inertia_b_kg_m2.norm()) {
    return "the load's inertia differs from the one that is flown; a flight keeps its load";
  }
  if ((a.position_w_m - b.position_w_m).norm() > kLength_m ||
      a.orientation_w_b.angularDistance(b.orientation_w_b) > kRelative) {
    return "the load's pose differs from the one that is flown; a flight keeps the load where it is";
  }
  // The cable is the same piece of rope: another stiffness would step the winches by the difference in stretch.
  if (!alike(flown.cable.stiffness_n_m, wanted.cable.stiffness_n_m) ||
      flown.cable.compensate_stretch != wanted.cable.compensate_stretch) {
    return "the cables' stiffness, or whether their stretch is compensated, differs from the ones that are flown";
  }
  // So is the winch the same machine: asked for less or more ahead, it would step by the difference times its rate.
  if (!alike(flown.winch.time_constant_s, wanted.winch.time_constant_s)) {
    return text("its winches lag by %.6g s, those that are flown by %.6g s", wanted.winch.time_constant_s,
                flown.winch.time_constant_s);
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
    if ((same->attachment_b_m - carrier.attachment_b_m).norm() > kLength_m) {
      return text("carrier %u is attached elsewhere on the load than the one that is flying", carrier.id);
    }
    if (!alike(same->vehicle.time_constant_s, carrier.vehicle.time_constant_s)) {
      return text("carrier %u lags by %.6g s, the one that is flying by %.6g s", carrier.id,
                  same->vehicle.time_constant_s, carrier.vehicle.time_constant_s);
    }
  }
  return std::nullopt;
}

std::optional<std::string> load_obstacle(const Slices& flown, const Slices& wanted) {
  for (const auto& [carrier, slice] : flown) {
    const auto found = wanted.find(carrier);
    if (found == wanted.end()) return text("carrier %u flies there, and is not in this mission", carrier);
    const mechanics::CarrierSlice& own = found->second;
    if ((slice.attachment_w_m - own.attachment_w_m).norm() > kLength_m) {
      return text("carrier %u is attached elsewhere than in this mission, or the load hangs elsewhere", carrier);
    }
    // f0 = pinv(G) w: the same attachments under another load carry another share of it.
    if (!alike(slice.particular_force_w_n, own.particular_force_w_n, own.particular_force_w_n.norm())) {
      return text(
          "carrier %u holds %.6g N of its load, %.6g N in this mission: another mass, gravity or set of carriers",
          carrier, slice.particular_force_w_n.norm(), own.particular_force_w_n.norm());
    }
    if (!alike(slice.cable_stiffness_n_m, own.cable_stiffness_n_m)) {
      return text(
          "carrier %u flies with cables of another stiffness (%.6g N/m, %.6g in this mission), or otherwise "
          "compensated",
          carrier, slice.cable_stiffness_n_m, own.cable_stiffness_n_m);
    }
    if (!alike(slice.winch_lag_s, own.winch_lag_s) || !alike(slice.vehicle_lag_s, own.vehicle_lag_s)) {
      return text("carrier %u flies with another lag of its winch or vehicle (%.6g and %.6g s, %.6g and %.6g here)",
                  carrier, slice.winch_lag_s, slice.vehicle_lag_s, own.winch_lag_s, own.vehicle_lag_s);
    }
  }
  return std::nullopt;
}

}  // namespace gyre::coordinator
