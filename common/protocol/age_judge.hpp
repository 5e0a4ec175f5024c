#pragma once
// How old a message is when it arrives, judged by its stamp, without a clock in common with whoever sent it.
//
// What a message tells holds for the time it is stamped with. Taken to hold at its arrival, it is off by speed times
// whatever the process that sent it, the network and the reader took longer than usual: a setpoint of 15 m/s by 3 mm
// in 200 µs, and a cable of 2e4 N/m makes 60 N of them; a vehicle's state by a metre, if it waited for a process that
// was stopped. A real vehicle goes by the stamp; so do the simulator's, and so does an agent that begins where its
// vehicle is.
//
//   delay   arrived − stamp: true delay, plus an offset between two clocks that nobody knows        ns
//   age     delay − the fourth least delay of the last kAgeWindow, not negative
//
// The least delay is the offset plus the shortest way there is, and the shortest way hardly varies. The fourth least
// serves as well and is not moved by kLying stamps: an agent whose clock leaps says two or three before it sees it, and
// for a second all others would be taken for late by the leap. The window is what follows a drift (300 ppm between the
// clocks are 0.3 ms of age, for all carriers alike, and a common shift moves no load), a clock that is walked to a new
// time, and a sender that starts again: after a silence as long as the window nothing of the past is left. Unless it
// was the listener's, who can say so (keep): while nobody listens, nothing is heard that could change what is known.
//
// Each carrier is judged by its own messages alone. So the offset of its own clock against the swarm's cancels here
// and stays where it belongs: in the place it flies to. One judge for all carriers, or the coordinator's clock, would
// set right what a carrier with a wrong clock does wrong, and the twin would hide it.
//
// Reference: D. L. Mills, RFC 5905, clock filter (least delay).

#include <cstddef>
#include <deque>
#include <optional>

#include "common/base/time.hpp"

namespace gyre::protocol {

inline constexpr Duration kAgeWindow = std::chrono::seconds(1);
inline constexpr std::size_t kLying = 3;

class AgeJudge {
 public:
  /// Stamps are by one clock, whichever it is, and lie within kLongestStamp of its zero; in order of arrival.
  [[nodiscard]] Duration age(Duration stamp, LocalTime arrived);

  /// The fourth least delay, or the greatest of fewer, this message's among them.
  [[nodiscard]] Duration usual_delay(Duration stamp, LocalTime arrived);

  /// Of a message that is not to be remembered: may be negative. Absent: nothing was ever heard.
  [[nodiscard]] std::optional<Duration> age_by_the_past(Duration stamp, LocalTime arrived) const;

  /// Nobody listened until now, or heard nothing but the past: what was known by the last message is known still.
  void keep(LocalTime now);

 private:
  [[nodiscard]] Duration usual_delay() const;

  struct Heard {
    LocalTime arrived;
    Duration delay;
  };

  std::deque<Heard> heard_;  // of the last kAgeWindow
};

/// No clock shows more: thirty years from its zero, and differences of them do not overflow.
inline constexpr Duration kLongestStamp = std::chrono::hours(24 * 365 * 30);

}  // namespace gyre::protocol
