#pragma once
// Clocks that must never be mixed, as types that cannot be.
//
// None can be read here: a core is told the time, it never asks. Only mains read a clock.

#include <chrono>

namespace gyre {

using Duration = std::chrono::nanoseconds;

/// This process's own steady clock. Comparable only within one process.
struct LocalClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<LocalClock, duration>;
  static constexpr bool is_steady = true;  // NOLINT(readability-identifier-naming): the standard's name
};

/// The clock the whole swarm shares: the coordinator's steady clock, estimated by everyone else.
struct SwarmClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SwarmClock, duration>;
  static constexpr bool is_steady = true;  // NOLINT(readability-identifier-naming): the standard's name
};

/// The clock that plans run on. It passes at the pace of the phase (protocol/pace.hpp): as swarm time does in full
/// motion, and not at all at rest.
struct PlanClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<PlanClock, duration>;
  static constexpr bool is_steady = false;  // NOLINT(readability-identifier-naming): the standard's name
};

using LocalTime = LocalClock::time_point;
using SwarmTime = SwarmClock::time_point;
using PlanTime = PlanClock::time_point;

/// Seventy years: no clock here shows more, and the difference of two differences within it cannot overflow.
inline constexpr Duration kLongest = std::chrono::hours(24 * 365 * 70);

/// Whether arithmetic on a time is safe; what others say may be anything.
template <class Clock>
[[nodiscard]] constexpr bool usable(std::chrono::time_point<Clock, Duration> time) {
  return time.time_since_epoch() >= -kLongest && time.time_since_epoch() <= kLongest;
}

[[nodiscard]] constexpr double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

[[nodiscard]] constexpr Duration from_seconds(double value_s) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(value_s));
}

}  // namespace gyre
