#pragma once
// Requirements to design from: regular polygons, the paper's load, wings.

#include "common/design/design.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::design::test {

/// All of a plan's numbers are open, and the order of its cycle.
[[nodiscard]] inline Open all_open(const mechanics::Plan& plan) {
  Open open;
  open.rate = open.order = true;
  open.laws.assign(plan.carriers.size(), {true, true, true, true});
  return open;
}

/// n carriers with attachments on a regular polygon of radius 1 m in a horizontal plane, 2 kg each.
[[nodiscard]] inline Requirements polygon(std::size_t n, double speed_min_m_s, double clearance_min_m) {
  Requirements out;
  out.given = mechanics::test::polygon_plan(n);
  out.given.load.mass_kg = 2.0 * static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = kTwoPi * static_cast<double>(i) / static_cast<double>(n);
    out.given.carriers[i].attachment_b_m = {std::cos(angle), std::sin(angle), 0.3};
  }
  out.given.cycle.edges.clear();
  out.given.limits = {};
  out.given.limits.speed_min_m_s = speed_min_m_s;
  out.given.limits.clearance_min_m = clearance_min_m;
  out.open = all_open(out.given);
  return out;
}

/// Three fixed wings and 10 kg.
[[nodiscard]] inline Requirements wings() {
  Requirements out = polygon(3, 12.0, 3.0);
  out.given.load.mass_kg = 10.0;
  out.given.limits.acceleration_max_m_s2 = 10.0;
  out.given.limits.length_max_m = 80.0;
  return out;
}

[[nodiscard]] inline Design designed(const Requirements& requirements, std::uint64_t seed = 1) {
  return design(requirements, seed, [](const Progress&) { return true; });
}

[[nodiscard]] inline double slowest_m_s(const mechanics::Certificate& certificate) {
  double speed = std::numeric_limits<double>::infinity();
  for (const mechanics::CarrierFigures& carrier : certificate.carriers) speed = std::min(speed, carrier.speed_m_s.min);
  return speed;
}

[[nodiscard]] inline double winch_rate_m_s(const mechanics::Certificate& certificate) {
  double rate = 0.0;
  for (const mechanics::CarrierFigures& carrier : certificate.carriers)
    rate = std::max(rate, carrier.winch_rate_max_m_s());
  return rate;
}

}  // namespace gyre::design::test
