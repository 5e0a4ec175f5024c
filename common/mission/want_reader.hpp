#pragma once
// What requirements want, and whether that asks for anything.

#include "common/design/requirements.hpp"
#include "common/mission/located.hpp"

namespace gyre::mission {

/// All but the objective. Wanted least speed and clearance go among the plan's limits.
[[nodiscard]] design::Want read_want(const Located& want, mechanics::Plan& plan);

/// Complains about wishes without an end, and about such that ask for nothing.
void judge_want(const Located& place, const design::Want& want, const design::Open& open, const mechanics::Plan& plan);

}  // namespace gyre::mission
