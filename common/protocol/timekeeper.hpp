#pragma once
// Swarm time at an agent: an estimate of the coordinator's clock that never jumps, never runs backwards, and knows how
// wrong it may be.
//
// Intuition: an exchange of four timestamps gives the offset between two clocks up to half its round trip, because
// nobody can tell how the trip divides into there and back. Fast exchanges tell much, slow ones little. Between
// exchanges a quartz clock is off by a nearly constant rate, which can be learned too.
//
//   symbol   meaning                                                            unit
//   T1, T4   request sent, reply received                                       this process's clock
//   T2, T3   request received, reply sent                                       swarm time
//   offset   swarm − local = ((T2 − T1) + (T3 − T4)) / 2                         ns
//   delay    (T4 − T1) − (T3 − T2)                                              ns
//   drift    d(offset)/dt                                                        -
//
// What the naive way gets wrong: averaging all exchanges lets every scheduling hiccup pull the clock; setting the clock
// to the newest estimate makes the setpoints jump; a wall clock is stepped by NTP and by operators. Here
//
//   1. an exchange counts with the variance its delay in excess of the least recent delay gives it (least delay);
//   2. a two-state Kalman filter follows offset and drift;
//   3. an exchange that contradicts the filter beyond doubt is dropped; when many in a row agree with each other
//      against the filter, the filter was wrong and starts again from them;
//   4. the clock that is read runs at the filtered rate plus a bounded correction (slew): monotone, continuous;
//   5. without exchanges the uncertainty grows with the drift's own uncertainty and with a bound on its wander;
//   6. a network that is slow one way only pulls every exchange the same way, and no averaging helps: half of the delay
//      is carried along, weighted as the filter weighs the offsets, and is part of the uncertainty.
//
// References: D. L. Mills, RFC 5905 (on-wire protocol, clock filter); R. E. Kalman, 1960.

#include <array>

#include "common/base/time.hpp"

namespace gyre::protocol {

struct Exchange {
  LocalTime request_sent{};
  SwarmTime request_received{};
  SwarmTime reply_sent{};
  LocalTime reply_received{};
};

struct TimekeeperOptions {
  Duration delay_max = std::chrono::seconds(1);    ///< slower exchanges say nothing worth keeping
  Duration noise = std::chrono::microseconds(15);  ///< standard deviation of the fastest exchange
  double drift_max = 300e-6;                       ///< no quartz is worse
  double drift_wander_per_sqrt_s = 0.05e-6;        ///< random walk of the drift (temperature)
  double slew_max = 0.01;                          ///< of the rate: how fast an error is walked off while flying
  Duration slew_time = std::chrono::seconds(1);    ///< an error is walked off over about this long
  int exchanges_to_trust = 4;
  int contradictions_to_restart = 8;
};

class Timekeeper {
 public:
  enum class Verdict {
    kTaken,
    kNonsense,       ///< time ran backwards in it, or a delay no network has
    kContradiction,  ///< against all that is known; not used
  };

  explicit Timekeeper(const TimekeeperOptions& options = {}) : options_(options) {}

  /// `now`: when it is told, not before the reply was received nor before any time asked for. The clock that is read
  /// is steered from there on: what was read stays read, however long the reply waited in a queue.
  Verdict observe(const Exchange& exchange, LocalTime now);
  /// A new coordinator keeps the swarm's time as well as it learned it: allow for an error of this size.
  void doubt(Duration error);

  /// Enough exchanges to fly by.
  [[nodiscard]] bool synchronised() const { return taken_ >= options_.exchanges_to_trust; }
  /// Once synchronised: monotone, and its rate bounded. `local` is not before the last observe(). Needs an exchange.
  [[nodiscard]] SwarmTime at(LocalTime local) const;
  /// Three standard deviations, plus what the network's asymmetry can hide, plus what is still to be slewed. The
  /// longest duration there is before the first exchange.
  [[nodiscard]] Duration uncertainty(LocalTime local) const;
  [[nodiscard]] double drift_ppm() const { return 1e6 * drift_; }

 private:
  /// How much of a delay the network did not need.
  [[nodiscard]] double excess_ns(double delay_ns) const;
  void start(LocalTime local, double offset_ns, double delay_ns);
  /// False for a contradiction.
  bool follow(LocalTime local, double measured_ns, double delay_ns);
  void predict(LocalTime local);
  void steer(LocalTime local);

  TimekeeperOptions options_;

  // The filter: offset relative to a fixed origin, so that doubles keep nanoseconds for centuries of uptime.
  Duration origin_{};
  LocalTime filtered_at_{};
  double offset_ns_ = 0.0;
  double drift_ = 0.0;
  double asymmetry_ns_ = 0.0;                          // what of the offset may be the network's asymmetry
  std::array<std::array<double, 2>, 2> covariance_{};  // of (offset [ns], drift [-])
  int taken_ = 0;
  int contradictions_ = 0;
  double contradiction_ns_ = 0.0;

  std::array<double, 32> delays_{};  // [ns] of recent exchanges, a ring
  std::size_t delay_count_ = 0;

  // The clock that is read: from the anchor at slewing_rate_ for slew_time, then at steady_rate_. It has its own copy
  // of the drift, because the filter's changes before the anchor does.
  LocalTime anchor_local_{};
  SwarmTime anchor_swarm_{};
  double slewing_rate_ = 0.0;
  double steady_rate_ = 0.0;
  bool running_ = false;
};

}  // namespace gyre::protocol
