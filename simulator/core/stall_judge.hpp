#pragma once
// Whether what arrives now may have waited: for a process that was stopped and goes on.
//
// Intuition: what is said to a process that does not run waits in its sockets, and is stamped with the time at which it
// woke. A backlog of seconds looks like the present then, and the oldest of it comes first and most: a full socket
// drops what comes later. Nothing in it says how old it is to whoever has slept for longer than he remembers delays
// (age_judge.hpp). But a process that runs hears or does something all the time, on its own beat at the latest; so a
// gap in that is a stall, and for a while after it nothing is believed that tells of the present.
//
//   gap > kStall: at < awake + kBacklog is doubted
//
// The same rule as an agent's for itself (agent/core/agent.hpp). Shorter stalls need none: whose setpoint waited is
// told by its stamp.

#include <algorithm>
#include <optional>

#include "common/base/time.hpp"

namespace gyre::simulator {

inline constexpr Duration kStall = std::chrono::milliseconds(500);
/// Longer than a reader needs to take what waited for it.
inline constexpr Duration kBacklog = std::chrono::milliseconds(150);

class StallJudge {
 public:
  /// Something arrived or was done then. What came at the same time may be told in any order.
  void awake(LocalTime at) {
    if (last_ && at - *last_ > kStall) doubted_until_ = at + kBacklog;
    last_ = last_ ? std::max(*last_, at) : at;
  }

  /// Whether what arrived then may have waited.
  [[nodiscard]] bool doubts(LocalTime at) const { return doubted_until_ && at < *doubted_until_; }

 private:
  std::optional<LocalTime> last_;
  std::optional<LocalTime> doubted_until_;
};

}  // namespace gyre::simulator
