#pragma once
// Whether what arrives now may have waited: for a process that was stopped and goes on.
//
// Intuition: what is said to a process that does not run waits in its sockets, and is stamped with the time at which it
// woke. A backlog of seconds looks like the present then, and the oldest of it comes first and most: a full socket
// drops what comes later. But a process that runs hears or does something all the time, on its own beat at the latest;
// so a gap in that is a stall, and for a while after it nothing is believed that tells of the present.
//
//   gap > kStall: at < awake + kBacklog is doubted
//                 at < awake + kLongestBacklog, and older than kWaited by what delays were before the gap: too
//
// How long it takes to read what waited, nobody can promise: on a machine that is short of processors, the readers are
// late as well. The stamps tell it whatever the machine does (common/protocol/age_judge.hpp), wherever anything was
// heard before. They do not for ever, for the swarm may have agreed on another time meanwhile.
//
// The same rule as an agent's for itself (agent/core/agent.hpp). Shorter stalls need none: whose setpoint waited is
// told by its stamp.

#include <algorithm>
#include <optional>

#include "common/base/time.hpp"

namespace gyre::simulator {

inline constexpr Duration kStall = std::chrono::milliseconds(500);
/// Longer than a reader needs to take what waited for it, where it has a processor.
inline constexpr Duration kBacklog = std::chrono::milliseconds(150);
inline constexpr Duration kLongestBacklog = std::chrono::seconds(3);
/// Older, and it waited: what a network or a busy machine delays, is not.
inline constexpr Duration kWaited = std::chrono::milliseconds(100);

class StallJudge {
 public:
  /// Something arrived or was done then. What came at the same time may be told in any order.
  void awake(LocalTime at) {
    if (last_ && at - *last_ > kStall) awake_since_ = at;
    last_ = last_ ? std::max(*last_, at) : at;
  }

  /// Whether what arrived then may have waited.
  [[nodiscard]] bool doubts(LocalTime at) const { return awake_since_ && at < *awake_since_ + kBacklog; }
  /// The same, of something whose age is known if anything was heard before the stall.
  [[nodiscard]] bool doubts(LocalTime at, std::optional<Duration> age) const {
    return doubts(at) || (recent(at) && age && *age > kWaited);
  }
  /// Whether it is so short a while since a stall that what is behind because of it may still be made up for.
  [[nodiscard]] bool recent(LocalTime at) const { return awake_since_ && at < *awake_since_ + kLongestBacklog; }

 private:
  std::optional<LocalTime> last_;
  std::optional<LocalTime> awake_since_;
};

}  // namespace gyre::simulator
