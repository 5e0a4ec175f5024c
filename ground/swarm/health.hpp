#pragma once
// `gyre health`: whether the processes of a swarm that run here do their work. What a container's health check asks.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command health_command();

}  // namespace gyre::ground
