#pragma once
// `gyre sample MISSION --count N`: the motion over one period, as CSV.

#include <CLI/CLI.hpp>

namespace gyre::ground {

/// The command leaves its exit code in `exit_code`, which has to outlive the parse.
void add_sample(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
