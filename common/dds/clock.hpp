#pragma once
// This process's steady clock: the one place where a main loop reads the time it hands to its core.
//
// In the laboratory the clock can be made wrong on purpose, by a constant and by a rate, so that tests can show that a
// wrong clock moves no load. The error is put on here and taken off where a thread waits; nothing else knows.
//
//   symbol   meaning                                                            unit
//   s        the machine's steady clock                                         ns
//   s0       s when the error began                                             ns
//   t        what this process takes for the time                               ns
//
//   t = s + offset + drift · (s − s0)          s = s0 + (t − offset − s0) / (1 + drift)
//
// It can be shifted while everything runs, too: forwards it leaps; back it stands still until it has fallen behind by
// so much, because a steady clock never runs backwards, and every core relies on that.

#include <chrono>

#include "common/base/time.hpp"

namespace gyre::dds {

/// How a clock is wrong. Exact to a nanosecond for a hundred days around `since`; t never runs backwards.
class ClockError {
 public:
  using Steady = std::chrono::steady_clock::time_point;

  ClockError() = default;
  ClockError(Duration offset, double drift_ppm, Steady since);

  [[nodiscard]] LocalTime shown_at(Steady s) const;
  /// The first moment at which the clock shows `t` or later.
  [[nodiscard]] Steady moment_of(LocalTime t) const;

 private:
  [[nodiscard]] Duration drifted(Duration elapsed) const;

  Duration offset_{};
  double drift_ = 0.0;
  Steady since_{};
};

/// The limits of what set_clock_error takes: eleven days, one percent.
inline constexpr double kMaxClockOffset_s = 1e6;
inline constexpr double kMaxClockDrift_ppm = 1e4;

/// A laboratory option: makes the clock of this whole process wrong from now on. For a main, before its node opens:
/// other threads read the clock without a lock. Shifts are forgotten.
void set_clock_error(Duration offset, double drift_ppm);

/// A laboratory's disturbance: shifts the clock of this whole process by so much, on top of everything else. For the
/// main loop, between two beats: a reader in another thread may see the time before it once more, for as long as the
/// call takes. All shifts together are bounded like an offset.
void shift_clock(Duration by);

[[nodiscard]] LocalTime now();

/// When `deadline`, a time on this process's clock, comes on the machine's; one that has passed, not after now.
[[nodiscard]] std::chrono::steady_clock::time_point steady_time(LocalTime deadline);

}  // namespace gyre::dds
