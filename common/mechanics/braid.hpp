#pragma once
// Which cables pass through each other, and which are braided: exact, for all time.
//
//   symbol   meaning                                                    shape   frame   unit
//   w        from attachment i to attachment j, r_j − r_i               3       W       m
//   f_i      force of cable i on the load, along the cable              3       W       N
//   T        w · (f_i × f_j), a trigonometric polynomial of degree 2    1       -       N² m
//
// Two straight cables lie on lines that meet exactly where T = 0: so all moments at which they may cross are roots.
// They do cross where the point lies inside both lengths, from one side to the other as the sign of T' tells. Over a
// period the crossings of a pair add up to how often the two carriers wind around each other relative to their
// attachments; as the load does not turn, straight cables that are not allowed to cross cannot be wound at all.
//
// Where T is zero all along, both cables stay in one plane (two carriers, as a rule): whether they lie across each
// other is then for their distance to say (clearance.hpp).
//
// Reference: docs/design.md, fact 8.

#include <vector>

#include "common/mechanics/carrier_slice.hpp"

namespace gyre::mechanics {

/// A pair whose cables pass through each other.
struct Braid {
  CarrierId first = 0, second = 0;
  int winding = 0;       ///< in a period, signed; 0: they pass through each other and back
  double at_s = 0.0;     ///< the first time in a period
  double up_m = 0.0;     ///< then, along the first one's cable, from its attachment
  double apart_m = 0.0;  ///< then, of the two carriers
};

/// Of slices with positive, bounded lengths. `period_s` as in the certificate.
[[nodiscard]] std::vector<Braid> braids(const std::vector<CarrierSlice>& slices, double period_s);

}  // namespace gyre::mechanics
