#pragma once
// What virtual swarms fly: the paper's load, and random ones of two to eight carriers, each with several motions.

#include <vector>

#include "common/mechanics/plan.hpp"

namespace gyre::swarm {

/// One load with motions that all hold it and are all admissible: one to begin with, the others to retune to.
struct LoadWithMotions {
  std::vector<mechanics::Plan> motions;
  mechanics::Limits vehicle;  ///< what every carrier's vehicle can do: enough for each motion

  [[nodiscard]] std::size_t size() const { return motions.front().carriers.size(); }
};

/// The same motion at a rate that no vehicle of this load can fly.
[[nodiscard]] mechanics::Plan too_fast(const mechanics::Plan& plan);

/// The paper's first; made once, the same in every run.
[[nodiscard]] const std::vector<LoadWithMotions>& loads();

}  // namespace gyre::swarm
