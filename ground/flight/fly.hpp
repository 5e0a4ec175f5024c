#pragma once
// `gyre fly MISSION`: a whole flight on this machine, as processes, with a verdict at the end.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command fly_command();

}  // namespace gyre::ground
