#pragma once
// Whether an agent may send a setpoint to its own vehicle: a number in every field, nothing absurd, and no leap.
//
// Merges see to it that no setpoint steps (merge.hpp); this looks at what is left when they failed, or when what was
// agreed is itself a leap. A vehicle that is told nothing goes on along its path by itself, which is better than a
// metre in a hundredth of a second.
//
//   leap    |x1 − x0 − dt (x0' + x1') / 2|     of the position, and of the winch                       m
//   bound   kUnnoticed_m + kGenerous dt² max(|x0''|, |x1''|)

#include <optional>
#include <string>

#include "common/mechanics/plan.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::agent {

class StepJudge {
 public:
  static constexpr double kUnnoticed_m = 0.02;
  static constexpr double kGenerous = 3.0;
  /// Nothing that flies with a load does more, and no vehicle so many times what it says it can.
  static constexpr double kAbsurdSpeed_m_s = 340.0;
  static constexpr double kAbsurdAcceleration_m_s2 = 1000.0;
  static constexpr double kAbsurdTimes = 10.0;

  /// After a silence of `long_ago` the vehicle has gone on by itself, and the last setpoint says nothing any more.
  StepJudge(const mechanics::Limits& vehicle, Duration long_ago);

  /// Absent: send it, and it is the last one. Otherwise why not.
  [[nodiscard]] std::optional<std::string> objection(LocalTime now, const protocol::Setpoint& setpoint);
  /// What comes next begins anew.
  void forget() { last_.reset(); }

 private:
  struct Last {
    LocalTime at;
    protocol::Setpoint setpoint;
  };
  double speed_max_m_s_;
  double acceleration_max_m_s2_;
  double winch_rate_max_m_s_;
  Duration long_ago_;
  std::optional<Last> last_;
};

}  // namespace gyre::agent
