#pragma once
// Pace axes as they come about: ramps asked for at any moment, whatever is under way.

#include <rapidcheck.h>

#include "common/protocol/pace.hpp"

namespace gyre::protocol::test {

/// Drawn evenly from [low, high].
[[nodiscard]] inline double real(double low, double high) {
  constexpr int kSteps = 1'000'000;
  return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, kSteps + 1)) / kSteps;
}
[[nodiscard]] inline int whole(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}
[[nodiscard]] inline Duration random_duration(double low_s, double high_s) {
  return from_seconds(real(low_s, high_s));
}

/// Days into the swarm's time, as most courses are.
inline constexpr SwarmTime kAxisBegin{std::chrono::hours(50)};

[[nodiscard]] inline Pace constant_pace(double pace, SwarmTime since = kAxisBegin, PlanTime at = PlanTime{}) {
  return Pace{{{since, Duration::zero(), {at, pace, 0.0, 0.0}, pace}}};
}

/// `count` ramps, each between just after the one before began and well after that one's end.
[[nodiscard]] inline Pace random_axis(int count) {
  Pace axis = constant_pace(real(0.0, 1.0), kAxisBegin, PlanTime(random_duration(-1e5, 1e5)));
  SwarmTime start = kAxisBegin;
  for (int i = 0; i < count; ++i) {
    start += random_duration(0.05, 8.0);
    axis = axis.with_ramp(start, random_duration(0.5, 6.0), whole(0, 2) == 0 ? 0.0 : real(0.0, 1.0));
  }
  return axis;
}

}  // namespace gyre::protocol::test
