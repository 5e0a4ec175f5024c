#pragma once
// `gyre engage`, `gyre release`, `gyre freeze`: one word to the coordinator of a swarm that flies, and its answer.

#include <CLI/CLI.hpp>

namespace gyre::ground {

/// Adds all of them. The command leaves its exit code in `exit_code`, which has to outlive the parse.
void add_swarm_commands(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
