#pragma once
// The table at the end of a flight.

#include <string>

#include "ground/flight/core/flight_report.hpp"

namespace gyre::ground {

/// Two lines for each carrier, certified above flown, a `!` behind what is outside; the load; the timing; the verdict,
/// and every figure outside in words.
[[nodiscard]] std::string flight_table(const FlightReport& report);

}  // namespace gyre::ground
