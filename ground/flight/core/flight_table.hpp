#pragma once
// The table at the end of a flight.

#include <string>
#include <vector>

#include "ground/flight/core/flight_report.hpp"

namespace gyre::ground {

/// What the table says, for who lays it out otherwise.
struct FlightWords {
  std::vector<std::vector<std::string>> rows;  ///< two of names and units; two for each carrier, certified and flown
  std::string load, timing;
};
[[nodiscard]] FlightWords flight_words(const FlightReport& report);

/// Two lines for each carrier, certified above flown, a `!` behind what is outside; the load; the timing; the verdict,
/// and every figure outside in words. Without the verdict: for flights in which somebody had a hand.
enum class Verdict { kShown, kLeftOut };
[[nodiscard]] std::string flight_table(const FlightReport& report, Verdict verdict = Verdict::kShown);

}  // namespace gyre::ground
