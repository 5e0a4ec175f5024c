#pragma once
// `gyre plot MISSION -o out.svg`: the mission as a picture.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command plot_command();

}  // namespace gyre::ground
