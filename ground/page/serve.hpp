#pragma once
// `gyre serve`: the page of a swarm that somebody else started, for as long as one likes.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command serve_command();

}  // namespace gyre::ground
