#pragma once
// A clock that is wrong and a network that is slow, on virtual time: what a timekeeper has to see through.

#include <cmath>
#include <cstdint>

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

  static constexpr Duration kDay = hours(1);

  [[nodiscard]] LocalTime show(SwarmTime t) const {
    const double day = static_cast<double>(kDay.count()) / (2.0 * M_PI);
    const double wandered = wander * day * (1.0 - std::cos(since_start(t) / day));
    return LocalTime(offset + t.time_since_epoch() + Duration(std::llround(drift * since_start(t) + wandered)));
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

}  // namespace gyre::protocol::test
