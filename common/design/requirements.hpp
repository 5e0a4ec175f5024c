#pragma once
// What a mission is designed from: a plan with gaps, limits, and what is wanted of it.
//
//   symbol      meaning                                                            unit
//   given       a plan; its numbers count where they are not open
//   open        which of them are to be chosen
//   v           guaranteed speed, the least of any carrier at any time             m/s
//
// The wanted least speed and clearance are limits like any others, and stand among the plan's; so what was wanted is
// what the certificate of the result judges.
//
// Source: docs/design.md, The mechanics.

#include <optional>
#include <vector>

#include "common/mechanics/plan.hpp"

namespace gyre::design {

enum class Objective {
  /// Internal force, acceleration, winch rate and height together, each without a unit (effort.hpp).
  kLeastEverything,
  kGreatestSpeed,
  kLeastWinchWork,
  kGreatestClearance,
};

/// As a person reads it: "least everything".
[[nodiscard]] const char* name(Objective objective);

struct Want {
  Objective objective = Objective::kLeastEverything;
  std::optional<double> amplitude_max_n;  ///< of every edge
  std::optional<double> rate_max_rad_s;
  std::optional<double> altitude_min_m, altitude_max_m;  ///< of every carrier, W
};

/// Which numbers of a carrier's length law are to be chosen; of an open law its kind is, too.
struct OpenLaw {
  bool kind = false;
  bool mean = false, swing = false, phase = false;
};

/// Which numbers of an edge are to be chosen.
struct OpenEdge {
  bool offset = false, amplitude = false, phase = false;
};

struct Open {
  bool attachments = false;  ///< of all carriers, on the load's shape; then the order is open, too
  bool rate = false;
  bool order = false;           ///< of the cycle; then its edges do not count, and all of theirs is open
  std::vector<OpenLaw> laws;    ///< of the plan's carriers
  std::vector<OpenEdge> edges;  ///< of the plan's edges, unless the order is open
};

/// Valid means: what is given is valid in a plan (plan.hpp), `open` has an entry for every carrier and every edge.
struct Requirements {
  mechanics::Plan given;
  Open open;
  Want want;
};

}  // namespace gyre::design
