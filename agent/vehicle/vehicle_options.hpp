#pragma once
// What this vehicle can do, as its owner says on the command line. The agent refuses every plan that asks for more.

#include <optional>
#include <string>

#include "agent/core/plan_judge.hpp"
#include "common/mechanics/plan.hpp"
#include "common/program/command_line.hpp"

namespace gyre::agent {

/// As typed; absent limits are not judged.
struct VehicleOptions {
  mechanics::Limits limits;
  mechanics::Winch winch;
  mechanics::Vehicle vehicle;
  std::optional<double> bank_max_deg;

  [[nodiscard]] Machines machines() const;
  /// What makes no sense together, in words.
  [[nodiscard]] std::optional<std::string> objection() const;
};

/// `options` has to live until the command has run.
[[nodiscard]] program::OptionGroup vehicle_options(VehicleOptions& options);

}  // namespace gyre::agent
