#pragma once
// From the times at which a recorder heard messages to the time of a report: the swarm's, from the recording's first
// message on.
//
// Intuition: states are stamped on clocks of their own; what all have in common is when they were heard, on the
// recorder's clock, which never steps, and by the beacons that is swarm time. A swarm that begins anew, or another one,
// has another swarm time: the axis then goes on as if nothing had leapt, and counts it.

#include <cstdint>
#include <optional>

#include "common/base/time.hpp"

namespace gyre::ground {

class TimeAxis {
 public:
  /// The swarm's word of its time, heard at `log`.
  void see(LocalTime log, SwarmTime swarm);

  /// Seconds; never decreases from one call to the next.
  [[nodiscard]] double at(LocalTime log);

  /// How often swarm time leapt.
  [[nodiscard]] std::uint64_t leaps() const { return leaps_; }

 private:
  void begin(LocalTime log);

  std::optional<LocalTime> first_;
  std::optional<Duration> swarm_ahead_;  // of the recorder's clock, by the newest beacon
  Duration gained_{};                    // what swarm time gained on the recorder's clock since the first beacon
  double last_s_ = 0.0;
  std::uint64_t leaps_ = 0;
};

}  // namespace gyre::ground
