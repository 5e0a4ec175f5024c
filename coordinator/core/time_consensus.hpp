#pragma once
// Whether this coordinator's clock still shows the time that the swarm flies by.
//
// Intuition: swarm time is this process's clock plus a constant, until the machine sleeps or a virtual one is paused:
// then the clock stands still, and the swarm flies on by the time it had. Whoever flies must not follow that jump, so
// who leads has to: every status says what time its agent has, and when more than half of them say the same other time,
// again and again, it is they who are right.
//
// A status may have been long on its way, and those that waited while this process did are old: only three in a row
// that tell the same difference, though they were sent at different times, count. The same as the first of the row,
// not as the one before: a change makes agents speak every 25 ms, and what waited differs by no more from one to the
// next.

#include <map>
#include <optional>
#include <vector>

#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

class TimeConsensus {
 public:
  /// Less is what messages are late and clocks are wrong by.
  static constexpr Duration kDifferent = std::chrono::milliseconds(100);
  static constexpr Duration kSame = std::chrono::milliseconds(30);
  static constexpr int kInARow = 3;

  /// `time`: swarm time as it is here when this status came.
  void take(SwarmTime time, const protocol::AgentStatus& status);
  /// What has to be added to swarm time here; absent: nothing. After that it starts anew.
  [[nodiscard]] std::optional<Duration> correction(const std::vector<CarrierId>& carriers);
  /// Whether more than half now tell another time: not the moment to decide anything by the time there is here.
  [[nodiscard]] bool doubtful(const std::vector<CarrierId>& carriers) const;

 private:
  struct Word {
    Duration ahead{};  ///< of the time here
    Duration first{};  ///< the same, of the first in the row
    Duration uncertainty{};
    SwarmTime told{};
    int in_a_row = 0;

    [[nodiscard]] bool another() const;
  };
  std::map<CarrierId, Word> words_;
};

}  // namespace gyre::coordinator
