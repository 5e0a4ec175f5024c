#pragma once
// `gyre health`: whether the processes of a swarm that run here do their work. What a container's health check asks.

#include <CLI/CLI.hpp>

namespace gyre::ground {

void add_health(CLI::App& app, int& exit_code);

}  // namespace gyre::ground
