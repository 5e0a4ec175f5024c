#pragma once
// `gyre replay`: a recording shown at the page as if it were flown now, or a process's core stepped through it again.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command replay_command();

}  // namespace gyre::ground
