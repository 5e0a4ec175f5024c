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
//   5. without exchanges the uncertainty grows with the drift's own uncertainty and with a bound on its wander.
//
// References: D. L. Mills, RFC 5905 (on-wire protocol, clock filter); R. E. Kalman, 1960.

#include <array>
#include <cstdint>
#include <optional>

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

  Verdict observe(const Exchange& exchange);
  /// A new coordinator keeps the swarm's time as well as it learned it: allow for an error of this size.
  void doubt(Duration error);

  /// Enough exchanges to fly by.
  [[nodiscard]] bool synchronised() const { return taken_ >= options_.exchanges_to_trust; }
  /// Monotone in `local`, for `local` not before the last one asked or observed. Needs at least one exchange.
  [[nodiscard]] SwarmTime at(LocalTime local) const;
  /// Three standard deviations, plus what the network's asymmetry can hide, plus what is still to be slewed.
  [[nodiscard]] Duration uncertainty(LocalTime local) const;
  [[nodiscard]] double drift_ppm() const { return 1e6 * drift_; }

 private:
  [[nodiscard]] Duration least_delay() const;
  void start(LocalTime local, double offset_ns, double sigma_ns);
  void predict(LocalTime local);
  void steer(LocalTime local);

  TimekeeperOptions options_;

  // The filter: offset relative to a fixed origin, so that doubles keep nanoseconds for centuries of uptime.
  Duration origin_{};
  LocalTime filtered_at_{};
  double offset_ns_ = 0.0;
  double drift_ = 0.0;
  std::array<std::array<double, 2>, 2> covariance_{};  // of (offset [ns], drift [-])
  int taken_ = 0;
  int contradictions_ = 0;
  double contradiction_ns_ = 0.0;

  std::array<Duration, 32> delays_{};  // of recent exchanges, a ring
  std::size_t delay_count_ = 0;

  // The clock that is read: swarm = anchor_swarm + (local − anchor_local) · (1 + rate).
  LocalTime anchor_local_{};
  SwarmTime anchor_swarm_{};
  double rate_ = 0.0;
  bool running_ = false;
};

}  // namespace gyre::protocol
