#pragma once
// `gyre watch`: a swarm that flies, watched for as long as one likes; a line when something changes.

#include <CLI/CLI.hpp>

namespace gyre::ground {

void add_watch(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
