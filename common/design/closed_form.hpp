#pragma once
// Where a search begins: motions that can be written down.
//
//   symbol     meaning                                                                       unit
//   h_j        heading of edge j as travelled, in the horizontal plane                       rad
//   a          amplitude of every edge                                                       N
//   H          height of a carrier above its attachment                                      m
//   f0_z       vertical share of its particular force                                        N
//
//   phase_j = h_j,   radius_i = a |sin(h_out − h_in)| H / f0_z          circles at constant speed (level attachments)
//   offset  = pull · a                                                  their middles apart
//   two carriers: f_1 = f0 + (offset + a cos theta) d,  l = mean + swing sin theta
//
// Internal forces sum to zero, so carriers can never all circle in phase: with circles about their attachments some
// pair goes around each other, and straight cables cannot be braided. A pull takes the circles apart until they do not
// enclose each other.
//
// Reference: docs/design.md, facts 2 and 8. Source of the pair: Franchi, Landi, Gabellieri, two-carrier construction.

#include <cstdint>

#include "common/design/demands.hpp"

namespace gyre::design {

[[nodiscard]] Scales scales_of(const Requirements& requirements);
[[nodiscard]] Bounds bounds_of(const Requirements& requirements, const Scales& scales);

/// Ids in order of travel.
using Order = std::vector<CarrierId>;

/// That of a plan's edges; of a plan without, that of its carriers.
[[nodiscard]] Order order_of(const mechanics::Plan& plan);

/// The one order that is given; or, of an open one, all of them up to six carriers, else the angular one, its stars,
/// and some drawn from the seed. Only such as let every carrier turn: neighbouring edges are not parallel.
[[nodiscard]] std::vector<Order> orders_of(const Requirements& requirements, std::uint64_t seed);

/// What is given and open, of a plan in that order: whole, its open numbers by the formulas above.
struct Start {
  mechanics::Plan plan;
  Open open;  ///< with the order's edges
};
[[nodiscard]] Start start_of(const Requirements& requirements, const Order& order, const Scales& scales,
                             const Bounds& bounds, double pull);

}  // namespace gyre::design
