#pragma once
// `gyre check MISSION`: the certificate, for a person or (--json) for a program.

#include <CLI/CLI.hpp>

namespace gyre::ground {

/// The command leaves its exit code in `exit_code`, which has to outlive the parse.
void add_check(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
