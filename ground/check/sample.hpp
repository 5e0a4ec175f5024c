#pragma once
// `gyre sample MISSION --count N`: the motion over one period, as CSV.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command sample_command();

}  // namespace gyre::ground
