#pragma once
// Where cables may be attached, if nobody says: on rings about the middle of the load's upper face.
//
//   symbol    meaning                                                         shape   frame   unit
//   c, h      middle and half extents of the upper face                       2       B       m
//   z         its height                                                      1       B       m
//   rho       share of the extents                                            1       -       -
//
//   b_i = (c_x + rho h_x cos phi_i, c_y + rho h_y sin phi_i, z),   phi_i = phi_0 + 2 pi i / n
//
// By symmetry: level attachments on a ring are what circles at constant speed need (docs/design.md, fact 2), and the
// further apart they are, the less force it takes to keep cables apart.

#include <vector>

#include "common/design/requirements.hpp"

namespace gyre::design {

/// The requirements with attachments: those that are given; or, of open ones, on some rings, each turned both ways.
[[nodiscard]] std::vector<Requirements> attached(const Requirements& requirements);

}  // namespace gyre::design
