#pragma once
// `gyre fly MISSION`: a whole flight on this machine, as processes, with a verdict at the end.

#include <CLI/CLI.hpp>

namespace gyre::ground {

/// The command leaves its exit code in `exit_code`, which has to outlive the parse.
void add_fly(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
