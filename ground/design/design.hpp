#pragma once
// `gyre design REQUIREMENTS -o MISSION`: a certified mission from requirements, or what makes it impossible.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command design_command();

}  // namespace gyre::ground
