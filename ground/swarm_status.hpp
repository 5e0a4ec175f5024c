#pragma once
// `gyre status`: how a swarm that flies is, at a glance: each carrier, the load, the clocks, and what was dropped.

#include <CLI/CLI.hpp>

namespace gyre::ground {

/// The command leaves its exit code in `exit_code`, which has to outlive the parse.
void add_status(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
