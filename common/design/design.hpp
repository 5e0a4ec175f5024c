#pragma once
// From requirements to a certified plan, or to the requirements that cannot be met together.
//
//   for every order of the cycle, from every closed form:  its family met and improved         (a handful of variables)
//   from the best of them, and from some of them shaken:   the whole met and improved          (all that is open)
//   the best that the certificate admits                                                       (exact, for all time)
//
// The search looks at samples; the certificate decides. What it refuses is searched again with a wider margin. A
// family's motion is kept where the whole is better by less than half a percent, or five of an effort, whose weights
// nobody knows better: it is simpler, and what its phases give exactly, such as constant speed, it has exactly.
//
// The same requirements and seed give the same design, if nobody interrupts.
//
// Reference: docs/design.md, Designing a mission.

#include <cstdint>
#include <functional>
#include <string>

#include "common/design/requirements.hpp"
#include "common/mechanics/certificate.hpp"

namespace gyre::design {

struct Progress {
  std::string doing;           ///< "orders", "whole, from order 1 2 3"
  std::optional<double> best;  ///< of what was found so far and meets all demands at the samples
};

/// Asked at every step; false ends the search, and what was found by then is the answer.
using KeepGoing = std::function<bool(const Progress&)>;

/// A limit that holds the design back, and what less of it would bring.
struct Price {
  std::string name;  ///< "clearance_min_m"
  const char* unit = "";
  double limit = 0.0;
  double relaxed = 0.0;  ///< the limit that was tried
  double figure = 0.0;   ///< the objective's figure under it
};

struct Design {
  std::optional<mechanics::Plan> plan;  ///< admissible; absent: none was found
  /// Of the plan, or of the best that was refused; without carriers: reasons why there can be none.
  mechanics::Certificate certificate;
  double figure = 0.0;  ///< of the objective: effort, m/s, W, m
  std::vector<Price> prices;
  /// Without a plan: the fewest demands found that cannot be met together, as "speed_min_m_s 12 m/s".
  std::vector<std::string> conflict;
  bool interrupted = false;
};

/// What the objective's figure is counted in: "m/s".
[[nodiscard]] const char* unit(Objective objective);

[[nodiscard]] Design design(const Requirements& requirements, std::uint64_t seed, const KeepGoing& keep_going);

}  // namespace gyre::design
