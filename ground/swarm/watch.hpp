#pragma once
// `gyre watch`: a swarm that flies, watched for as long as one likes; a line when something changes.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command watch_command();

}  // namespace gyre::ground
