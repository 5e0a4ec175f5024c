#pragma once
// Swarm time at an agent: an estimate of the coordinator's clock that knows how wrong it may be, never runs backwards
// and never jumps, unless time itself did.
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
//   3. an exchange that contradicts the filter beyond doubt is dropped, but a rival filter follows it; when enough of
//      them, over enough time, agree on the rival and none speaks for the filter alone, some clock jumped (a machine
//      slept, a virtual one was paused): swarm time is found anew, which is said, and is where the clock that is read
//      jumps. To walk there would take half an hour after a pause of 20 s, all of it flown behind the others;
//   4. the clock that is read runs at the filtered rate plus a bounded correction (slew): monotone, continuous;
//   5. without exchanges the uncertainty grows with the drift's own uncertainty and with a bound on its wander;
//   6. a network that is slow one way only pulls every exchange the same way, and no averaging helps: half of the delay
//      is carried along, weighted as the filter weighs the offsets, and is part of the uncertainty;
//   7. where other witnesses say that this clock leapt, and by how much (agent/core/clock_watch.hpp), one exchange that
//   no network can explain and that says the same is enough; the drift is what it was;
//   8. the filter begins with a drift that may be anything supported, and the exchanges soon narrow it; the rival
//   begins
//      with one that may be anything at all, so that a clock too fast or too slow is measured, and refused in words.
//
// References: D. L. Mills, RFC 5905 (on-wire protocol, clock filter); R. E. Kalman, 1960.

#include <array>
#include <optional>
#include <string>

#include "common/base/time.hpp"

namespace gyre::protocol {

struct Exchange {
  LocalTime request_sent{};
  SwarmTime request_received{};
  SwarmTime reply_sent{};
  LocalTime reply_received{};

  /// On the two ways together. Of times that are usable.
  [[nodiscard]] Duration delay() const { return (reply_received - request_sent) - (reply_sent - request_received); }
};

struct TimekeeperOptions {
  Duration delay_max = std::chrono::seconds(1);    ///< slower exchanges say nothing worth keeping
  Duration noise = std::chrono::microseconds(15);  ///< standard deviation of the fastest exchange
  double drift_max = 5000e-6;                      ///< no quartz has 300e-6, a virtual machine's clock may have more
  double drift_wander_per_sqrt_s = 0.05e-6;        ///< random walk of the drift (temperature)
  double slew_max = 0.01;                          ///< of the rate: how fast an error is walked off while flying
  Duration slew_time = std::chrono::seconds(1);    ///< an error is walked off over about this long
  int exchanges_to_trust = 4;
  int contradictions_to_find_anew = 5;
  Duration contradictions_spread = std::chrono::milliseconds(750);  ///< over at least that: not one burst of them
  Duration leap_seen_to = std::chrono::milliseconds(5);             ///< by other witnesses; or to half of it
};

class Timekeeper {
 public:
  enum class Verdict {
    kTaken,
    kFoundAnew,      ///< taken, and swarm time as it is read jumped to it, either way; once synchronised()
    kLeapt,          ///< the same at once: this clock had leapt, as others saw
    kNonsense,       ///< time ran backwards in it, or a delay no network has, or not newer than the one before
    kContradiction,  ///< against all that is known; not used
  };

  explicit Timekeeper(const TimekeeperOptions& options = {}) : options_(options) {}

  /// `now`: when it is told, not before the reply was received nor before any time asked for. The clock that is read
  /// is steered from there on: what was read stays read, however long the reply waited in a queue.
  /// `leap`: what this clock seems to have leapt by before the exchange began, as other witnesses have it.
  Verdict observe(const Exchange& exchange, LocalTime now, std::optional<Duration> leap = std::nullopt);
  /// A new coordinator keeps the swarm's time as well as it learned it: allow for an error of this size.
  void doubt(Duration error);

  /// Enough exchanges to fly by.
  [[nodiscard]] bool synchronised() const { return taken_ >= options_.exchanges_to_trust; }
  /// Once synchronised: monotone, and its rate bounded, between one kFoundAnew and the next. `local` is not before the
  /// last observe(). Needs an exchange.
  [[nodiscard]] SwarmTime at(LocalTime local) const;
  /// Three standard deviations, plus what the network's asymmetry can hide, plus what is still to be slewed. The
  /// longest duration there is before the first exchange. Until time is found anew after a jump, nobody knows of it.
  [[nodiscard]] Duration uncertainty(LocalTime local) const;
  [[nodiscard]] double drift_ppm() const { return 1e6 * filter_.drift; }
  /// In words, that the two clocks run further apart than is supported.
  [[nodiscard]] std::optional<std::string> complaint() const;

 private:
  struct Measurement {
    LocalTime at{};
    double offset_ns = 0.0;
    double delay_ns = 0.0;
    double sigma_ns = 0.0;
  };
  struct Filter {
    LocalTime at{};
    double offset_ns = 0.0;
    double drift = 0.0;
    double asymmetry_ns = 0.0;  // what of the offset may be the network's asymmetry
    double p00 = 0.0;           // the covariance of (offset [ns], drift [-])
    double p01 = 0.0;
    double p11 = 0.0;
    double wander_per_sqrt_s = 0.0;

    void predict(LocalTime local);
    /// False for a contradiction, from which nothing is learned.
    [[nodiscard]] bool follow(const Measurement& m);
    /// How far off it may be where nothing is wrong. Of a filter that was predicted to its moment.
    [[nodiscard]] double bound_ns(const Measurement& m) const;
    /// What is known of a drift that is supported, without any exchange: that it is 0, give or take.
    void expect_drift(double sigma);
  };

  /// How much of a delay the network did not need.
  [[nodiscard]] double excess_ns(double delay_ns) const;
  [[nodiscard]] Filter begin(const Measurement& m) const;
  /// The filter as it is after a leap that it did not see coming; absent: this exchange says nothing of it.
  [[nodiscard]] std::optional<Filter> after_leap(const Measurement& m, Duration leap) const;
  /// Whether the rival has convinced.
  [[nodiscard]] bool convinces(const Measurement& contradiction);
  void drop_rival();
  void steer(LocalTime local, bool jump);
  [[nodiscard]] bool supported(const Filter& filter) const;
  [[nodiscard]] const Filter& believed() const { return refused_ ? *rival_ : filter_; }

  TimekeeperOptions options_;

  Duration origin_{};  // of all offsets: fixed, so that doubles keep nanoseconds for centuries of uptime
  Filter filter_;
  int taken_ = 0;

  std::optional<Filter> rival_;  // follows what contradicts the filter
  int contradictions_ = 0;
  LocalTime contradicted_since_{};
  bool refused_ = false;  // the rival convinces, but for a drift that is not supported

  LocalTime request_sent_{};         // of the last exchange
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
