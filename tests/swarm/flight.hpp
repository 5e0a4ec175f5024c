#pragma once
// One flight from start to end, and what the judges found.

#include <string>
#include <vector>

#include "tests/swarm/swarm.hpp"

namespace gyre::swarm {

/// From the end of all faults.
inline constexpr Duration kAgreeWithin = std::chrono::seconds(20);
inline constexpr Duration kRestWithin = std::chrono::seconds(30);
/// Until everybody is back where its plan wants it: a vehicle may be metres away and slow.
inline constexpr Duration kMergedWithin = std::chrono::seconds(60);
inline constexpr Duration kClocksWithin = std::chrono::milliseconds(2);

struct FlightReport {
  std::uint64_t seed = 0;
  std::vector<Finding> findings;
  Extremes extremes;
  FaultCounts faults;
  Duration flown{};
  Duration agreed_after{};  ///< the end of all faults

  [[nodiscard]] bool good() const { return findings.empty(); }
};

[[nodiscard]] FlightReport fly(const Scenario& scenario, const Sabotage& sabotage = {}, const Swarm::Trace& trace = {});

/// What was found, with the seed and how to see it again.
[[nodiscard]] std::string describe(const FlightReport& report);

}  // namespace gyre::swarm
