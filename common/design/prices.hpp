#pragma once
// What each limit that holds a design back costs: the design again, from where it is, with that limit alone relaxed.
//
//   symbol    meaning                                            unit
//   L         a limit that is reached, by its name in the file   its own
//   J(L)      the objective's figure                             its own
//
//   price: J((1 ± 5 %) L) beside J(L)
//
// By sampled motions, as the search has them, and not certified: a price is advice. A figure that hardly changes says
// that the next limit is near.

#include "common/design/workshop.hpp"

namespace gyre::design {

/// Of a candidate that meets all demands and is the best around; the dearest first.
[[nodiscard]] std::vector<Price> prices(Workshop& workshop, const Candidate& candidate);

}  // namespace gyre::design
