#pragma once
// Whether the edges of a mission are a Hamiltonian cycle over its carriers, and if not, what to write instead.

#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/mission/located.hpp"

namespace gyre::mission {

/// The edges of a plan and where each of them stands in the file; `cycle` is the message that holds them.
struct LocatedEdges {
  const Located& cycle;
  const std::vector<Located>& places;
};

/// Complains about everything that keeps `plan.cycle.edges` from being one Hamiltonian cycle in order of travel (one
/// edge for two carriers, none for one), and about edges of no length, which have no direction. Edge ends that are 0
/// and carriers with id 0 have been complained about already.
void judge_cycle(const mechanics::Plan& plan, const LocatedEdges& edges);

}  // namespace gyre::mission
