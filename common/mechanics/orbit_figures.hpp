#pragma once
// What one carrier does at its worst over all time, from its slice alone.
//
//   symbol   meaning                                                                  degree in psi
//   psi      base angle: theta = harmonic denominator · psi, so all is 2 pi periodic
//   f        force                                                                    vector, 1 (times denominator)
//   M        f·f, tension squared                                                     2
//   g        u·f of a projection law                                                  1
//   sigma    s* − u·B of a projection law, l* of a free one                           0 or the profile's
//
//   projection    l = sigma √M / g     p − B = sigma f / g
//       V = (sigma f)' g − sigma f g',  v = V / g²          A = V' g − 2 V g',  a = A / g³
//   free          l = sigma            p − B = sigma f / √M
//       V = (sigma f)' M − sigma f M'/2, v = V / M^(3/2)    A = V' M − (3/2) V M', a = A / M^(5/2)
//
//   paid out      L = l − s/k, which under a projection is the same quotient with sigma − g/k in the place of sigma
//       P = sigma' M g + sigma (M' g/2 − M g'),  L' = P / (√M g²)      Q = P' M g − P (M' g/2 + 2 M g'),
//       L'' = Q / (M^(3/2) g³)
//   pull          at rest m_v g_0 e_z + f, and with m_v a at full pace, under a projection
//       (m_v A + (m_v g_0 e_z + f) g³) / g³
//
// (primes are d/dpsi; times the base rate once or twice for time derivatives)
//
// Where no such quotient is at hand, bounds are proven all the same, and a little wide: what a free law has paid out,
// sigma − √M/k, is bounded by the sum of both ranges, so by no more than the stretch swings; and its pull by the
// enclosure of transition_figures.hpp, with the slack that is written there.
//
// Reference: docs/design.md, fact 1. Source of the laws: Franchi, Landi, Gabellieri, as in length_law.hpp; a carrier at
// constant altitude stops exactly when its cable's direction does (level stop condition).

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/certificate.hpp"

namespace gyre::mechanics {

/// Of a valid plan's slice, or one that is as sane. Where the law has no bounded length (u·q passes through zero) or
/// the cable goes slack, lengths, rates, speeds and altitudes are infinite. Tensions are always exact, and so are
/// cosines, but that a slack cable has no direction: then q_z may be anything, and |u·q| is 0. Without a `vehicle`
/// nothing is said of what it pulls.
[[nodiscard]] CarrierFigures orbit_figures(const CarrierSlice& slice,
                                           const std::optional<VehicleWeight>& vehicle = std::nullopt);

}  // namespace gyre::mechanics
