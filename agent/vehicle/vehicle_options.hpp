#pragma once
// What this vehicle can do, as its owner says on the command line. The agent refuses every plan that asks for more.

#include "common/mechanics/plan.hpp"
#include "common/program/command_line.hpp"

namespace gyre::agent {

/// `limits` has to live until the command has run. Nothing given: nothing is judged.
[[nodiscard]] program::OptionGroup vehicle_options(mechanics::Limits& limits);

}  // namespace gyre::agent
