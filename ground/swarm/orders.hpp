#pragma once
// `gyre engage`, `gyre release`, `gyre freeze`, `gyre pace`, `gyre retune`: one word to the coordinator of a swarm that
// flies, and its answer.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command engage_command();
[[nodiscard]] program::Command release_command();
[[nodiscard]] program::Command freeze_command();
[[nodiscard]] program::Command pace_command();
[[nodiscard]] program::Command retune_command();

}  // namespace gyre::ground
