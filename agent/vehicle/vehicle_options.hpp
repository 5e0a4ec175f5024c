#pragma once
// What this vehicle can do, as its owner says on the command line. The agent refuses every plan that asks for more.

#include <CLI/CLI.hpp>

#include "common/mechanics/plan.hpp"

namespace gyre::agent {

/// `limits` has to live until `app` has parsed. Nothing given: nothing is judged.
void add_vehicle_options(CLI::App& app, mechanics::Limits& limits);

}  // namespace gyre::agent
