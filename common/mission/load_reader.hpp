#pragma once
// The load of a mission file: mass, inertia, pose, shape.

#include "common/mechanics/plan.hpp"
#include "common/mission/located.hpp"

namespace gyre::mission {

[[nodiscard]] mechanics::Load read_load(const Located& load);

}  // namespace gyre::mission
