#pragma once
// An account of a swarm, for people and for programs.

#include <string>

#include "ground/swarm/core/swarm_watch.hpp"

namespace gyre::ground {

/// "calm: motion, load within 0.02 mm, residual 0.001 % of the weight, clocks within 0.1 of 3.2 ms"
[[nodiscard]] std::string account_line(const Account& account);

/// One JSON object in one line. Keys: time_s, calm, complaint, course, term, silent, complaints {process: text},
/// load {displacement_max_m, displacement_allowed_m, rotation_max_deg, rotation_allowed_deg, residual_max, samples},
/// skew_s, skew_budget_s (null: any).
[[nodiscard]] std::string account_json(const Account& account);

}  // namespace gyre::ground
