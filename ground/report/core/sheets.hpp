#pragma once
// The figures of a report: each a picture that stands alone. Recordings stand beside each other, in the same scales, so
// that what differs is the flight and not the axis; flights that differ much in size have scales of their own.
//
//   paths    where the carriers were, from above and from the side, over the orbits of the plan
//   motion   altitudes and speeds
//   cables   lengths and winch rates
//   load     tensions; how far the load was from its pose, and by how much it was turned

#include <string>
#include <vector>

#include "ground/report/core/account.hpp"

namespace gyre::ground {

struct Sheet {
  std::string name;  ///< "motion": of the file, without its ending
  std::string title;
  std::string caption;  ///< how to read it
  std::string svg;      ///< for light and for dark paper
};

/// Of at least one recording.
[[nodiscard]] std::vector<Sheet> sheets(const std::vector<Account>& accounts);

}  // namespace gyre::ground
