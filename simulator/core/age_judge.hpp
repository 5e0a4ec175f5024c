#pragma once
// How old a setpoint is when it arrives, judged by its stamp, without a clock in common with whoever sent it.
//
// A setpoint holds for the swarm time it is stamped with. Taken to hold at its arrival, it moves the carrier by speed
// times whatever the process that sent it and the network took longer than usual: 200 µs at 15 m/s are 3 mm, and a
// cable of 2e4 N/m makes 60 N of them. A real vehicle goes by the stamp; so does this one.
//
//   delay   arrived − stamp: true delay, plus an offset between two clocks that nobody knows        ns
//   age     delay − the fourth least delay of the last kAgeWindow, within 0..kExtrapolationHorizon_s
//
// The least delay is the offset plus the shortest way there is, and the shortest way hardly varies. The fourth least
// serves as well and is not moved by kLying stamps: an agent whose clock leaps says two or three before it sees it, and
// for a second all others would be taken for late by the leap. The window is what follows a drift (300 ppm between the
// clocks are 0.3 ms of age, for all carriers alike, and a common shift moves no load), a clock that is walked to a new
// time, and an agent that starts again: after a silence as long as the window nothing of the past is left.
//
// Each carrier is judged by its own setpoints alone. So the offset of its own clock against the swarm's cancels here
// and stays where it belongs: in the place it flies to. One judge for all carriers, or the coordinator's clock, would
// set right what a carrier with a wrong clock does wrong, and the twin would hide it.
//
// Reference: D. L. Mills, RFC 5905, clock filter (least delay).

#include <cstddef>
#include <deque>

#include "common/base/time.hpp"

namespace gyre::simulator {

inline constexpr Duration kAgeWindow = std::chrono::seconds(1);
inline constexpr std::size_t kLying = 3;

class AgeJudge {
 public:
  /// Of a setpoint of this carrier; in order of arrival. Stamps lie within kLongestStamp of the clock's zero.
  [[nodiscard]] Duration age(SwarmTime stamp, LocalTime arrived);

 private:
  struct Heard {
    LocalTime arrived;
    Duration delay;
  };

  std::deque<Heard> heard_;  // of the last kAgeWindow
};

/// No clock of a swarm shows more: thirty years from its zero, and differences of them do not overflow.
inline constexpr Duration kLongestStamp = std::chrono::hours(24 * 365 * 30);

}  // namespace gyre::simulator
