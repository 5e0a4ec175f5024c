#pragma once
// A clock that is wrong and a network that is slow, on virtual time: what a timekeeper has to see through.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/random_stream.hpp"
#include "common/protocol/timekeeper.hpp"

namespace gyre::protocol::test {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;

[[nodiscard]] inline Duration ms(double value) {
  return from_seconds(1e-3 * value);
}

/// The local clock as a function of the true one, which is the swarm's: local' = 1 + drift + wander sin(2π t / kDay).
struct WrongClock {
  Duration offset{};
  double drift = 0.0;
  double wander = 0.0;  ///< with the temperature, which comes and goes
  SwarmTime jumps_at{};
  Duration jump{};  ///< ahead; below zero it stands still until it is so far behind

  static constexpr Duration kDay = hours(1);

  [[nodiscard]] LocalTime show(SwarmTime t) const {
    const SwarmTime run = t < jumps_at ? t : std::max(jumps_at, t + jump);
    const double day = static_cast<double>(kDay.count()) / (2.0 * M_PI);
    const double wandered = wander * day * (1.0 - std::cos(since_start(run) / day));
    return LocalTime(offset + run.time_since_epoch() + Duration(std::llround(drift * since_start(run) + wandered)));
  }

 private:
  [[nodiscard]] static double since_start(SwarmTime t) { return static_cast<double>(t.time_since_epoch().count()); }
};

/// A delay of at least `least`, with an exponential excess, each way on its own.
struct Network {
  Duration there_least = microseconds(30), there_jitter{};
  Duration back_least = microseconds(30), back_jitter{};
};

class Exchanges {
 public:
  Exchanges(const WrongClock& clock, const Network& network, std::uint64_t seed)
      : clock_(clock), network_(network), random_(seed, "exchanges") {}

  /// An exchange that the agent begins at swarm time `sent`.
  [[nodiscard]] Exchange at(SwarmTime sent) {
    const SwarmTime arrived = sent + delay(network_.there_least, network_.there_jitter);
    const SwarmTime answered = arrived + microseconds(5);
    back_ = answered + delay(network_.back_least, network_.back_jitter);
    return {clock_.show(sent), arrived, answered, clock_.show(back_)};
  }
  /// When the last one was complete.
  [[nodiscard]] SwarmTime complete() const { return back_; }

 private:
  Duration delay(Duration least, Duration jitter) {
    return least + Duration(std::llround(-std::log(1.0 - random_.uniform()) * static_cast<double>(jitter.count())));
  }

  WrongClock clock_;
  Network network_;
  RandomStream random_;
  SwarmTime back_{};
};

/// How wrong the timekeeper is at this moment; positive: ahead.
[[nodiscard]] inline Duration error(const Timekeeper& keeper, const WrongClock& clock, SwarmTime t) {
  return keeper.at(clock.show(t)) - t;
}

[[nodiscard]] inline Duration magnitude(Duration d) {
  return d < Duration::zero() ? -d : d;
}

/// The same exchange with a coordinator whose clock is ahead.
[[nodiscard]] inline Exchange shifted(Exchange e, Duration by) {
  e.request_received += by;
  e.reply_sent += by;
  return e;
}

inline constexpr SwarmTime kBegin{hours(1)};
inline constexpr Duration kPeriod = milliseconds(125);

/// Feeds exchanges at the agent's pace until `end`; every `visit`ed moment lies between two of them.
template <class Visit>
inline void run(Timekeeper& keeper, Exchanges& exchanges, SwarmTime begin, SwarmTime end, Visit visit) {
  for (SwarmTime t = begin; t < end; t += kPeriod) {
    const Exchange e = exchanges.at(t);
    (void)keeper.observe(e, e.reply_received);
    for (SwarmTime seen = exchanges.complete(); seen < t + kPeriod; seen += milliseconds(10)) visit(seen);
  }
}

inline void run(Timekeeper& keeper, Exchanges& exchanges, SwarmTime begin, SwarmTime end) {
  run(keeper, exchanges, begin, end, [](SwarmTime) {});
}

/// A timekeeper that has settled on a clock, ten seconds after kBegin.
struct Settled {
  WrongClock clock{hours(3), 80e-6};
  Exchanges exchanges{clock, Network{microseconds(30), microseconds(20), microseconds(30), microseconds(20)}, 1};
  Timekeeper keeper;
  SwarmTime now = kBegin + std::chrono::seconds(10);

  Settled() { run(keeper, exchanges, kBegin, now); }

  [[nodiscard]] SwarmTime shown() const { return keeper.at(clock.show(now)); }
  [[nodiscard]] Timekeeper::Verdict lie(Duration by, std::optional<Duration> leap = std::nullopt) {
    const Exchange e = shifted(exchanges.at(now), by);
    now = exchanges.complete();
    return keeper.observe(e, e.reply_received, leap);
  }
  [[nodiscard]] Duration error() const { return test::error(keeper, clock, now); }
  [[nodiscard]] Duration uncertainty() const { return keeper.uncertainty(clock.show(now)); }
};

inline const std::vector<Network> kNetworks = {
    {microseconds(30), microseconds(20), microseconds(30), microseconds(20)},  // loopback
    {milliseconds(1), milliseconds(2), milliseconds(1), microseconds(100)},    // a radio, slow one way
    {milliseconds(10), milliseconds(10), milliseconds(10), milliseconds(10)},  // a bad one
};

}  // namespace gyre::protocol::test
