#pragma once
// `gyre status`: how a swarm that flies is, at a glance: each carrier, the load, the clocks, and what was dropped.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command status_command();

}  // namespace gyre::ground
