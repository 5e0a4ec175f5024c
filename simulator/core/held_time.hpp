#pragma once
// When, on the clock here, holds what a setpoint says: the time base that a vehicle flies by.
//
//   x      the setpoint's stamp, by its agent's clock                                                    ns
//   u      its agent's usual delay (common/protocol/age_judge.hpp): what the stamps lie behind the arrivals
//   b      the time base: held = x + b
//   T      for how long u has been known, at most kSteady                                                s
//
//   b' = (u − b) / T · (1 + ((u − b) / kNear)²)       slow when near, quick when far; at first the mean of all u
//   b  = u                                            in the first kAgeWindow, and where they are kLeap apart
//
// u steps by tens of microseconds from one setpoint to the next, as the machine has it. A vehicle does not, and neither
// does its autopilot's clock: a step of 25 µs asks a winch that pays out 4 m/s for 0.1 mm at once, and as its drum lags
// where its vehicle does not, a cable of 2e4 N/m feels 2 N. Walked off over seconds it is felt by nobody. Clocks that
// drift apart by 300 ppm are followed 0.5 ms behind, for all carriers alike, which moves no load; a clock that is
// walked to a new time, by a hundredth of its rate, 1.3 ms behind.
//
// A setpoint that came quicker than usual holds a moment after it arrived. One that would by more than kEarly is of a
// clock that leapt, and held when it came.

#include <optional>

#include "common/base/time.hpp"
#include "common/protocol/age_judge.hpp"

namespace gyre::simulator {

class HeldTime {
 public:
  static constexpr Duration kSteady = std::chrono::seconds(2);
  static constexpr Duration kNear = std::chrono::microseconds(300);
  static constexpr Duration kLeap = std::chrono::milliseconds(5);
  static constexpr Duration kEarly = std::chrono::milliseconds(5);

  /// Preconditions as AgeJudge::age. At most `oldest` before `arrived`.
  [[nodiscard]] LocalTime of(Duration stamp, LocalTime arrived, Duration oldest);

  /// As AgeJudge's.
  [[nodiscard]] std::optional<Duration> age_by_the_past(Duration stamp, LocalTime arrived) const {
    return ages_.age_by_the_past(stamp, arrived);
  }
  void keep(LocalTime now);

 private:
  struct Base {
    LocalTime begun;
    LocalTime last;
    Duration behind;
  };

  protocol::AgeJudge ages_;
  std::optional<Base> base_;
};

}  // namespace gyre::simulator
