#pragma once
// `gyre record`: everything that a swarm says, into a file that ROS 2's tools, Foxglove and PlotJuggler read.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command record_command();

}  // namespace gyre::ground
