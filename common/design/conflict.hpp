#pragma once
// Which demands cannot be met together: the fewest that were found.
//
//   nearest    the motion whose worst residual is the least that was found: what is worst there is in conflict
//   filter     without one of them, can the others be met? Then it belongs to the conflict; else it is left out
//
// A search that finds nothing proves nothing: there may be a motion that it does not see. The words say so.

#include "common/design/workshop.hpp"

namespace gyre::design {

/// Of a candidate that does not meet the demands and is as near as was found. As "speed_min_m_s 12 m/s".
[[nodiscard]] std::vector<std::string> conflict(Workshop& workshop, const Candidate& nearest);

}  // namespace gyre::design
