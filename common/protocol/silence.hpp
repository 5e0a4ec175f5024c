#pragma once
// What the swarm does when somebody falls silent in flight: the mission says it, everybody does it.
//
// Silence is not loss: whoever is not heard most likely flies on, and so must the others. What may not happen is that
// some stop and some do not. So with every beacon comes a lease, the moment until which the phase may run on without
// another word, and at its end everybody stops on one and the same profile, the silent one too.

#include <optional>

#include "common/base/time.hpp"

namespace gyre::protocol {

inline constexpr Duration kShortestLease = std::chrono::seconds(2);
inline constexpr Duration kLongestLease = std::chrono::minutes(10);

struct Silence {
  /// How long the phase runs on without a word, kShortestLease .. kLongestLease; absent: it flies on for ever.
  std::optional<Duration> stop_after = std::chrono::seconds(5);

  friend bool operator==(const Silence& a, const Silence& b) { return a.stop_after == b.stop_after; }
};

}  // namespace gyre::protocol
