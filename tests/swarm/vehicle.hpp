#pragma once
// Where a carrier is, and what it does when nobody tells it anything: as the simulator's vehicles do
// (simulator/core/onward.hpp, on_silence.hpp, extrapolation.hpp), without their dynamics. One that lags does what a
// first-order lag does once it has settled, y = x − T x' + T² x'': of what is asked ahead, what was meant.

#include "common/protocol/incumbent.hpp"
#include "common/protocol/messages.hpp"
#include "simulator/core/catch_up.hpp"
#include "simulator/core/on_silence.hpp"
#include "simulator/core/onward.hpp"
#include "tests/swarm/virtual_clock.hpp"

namespace gyre::swarm {

class Vehicle {
 public:
  /// By how much its winch and itself are late.
  void lags(double winch_s, double vehicle_s) {
    winch_lag_s_ = winch_s;
    vehicle_lag_s_ = vehicle_s;
  }
  /// What comes of a setpoint.
  [[nodiscard]] protocol::Setpoint realised(const protocol::Setpoint& asked) const;
  /// Rests there until it is told anything else.
  void place(const protocol::Setpoint& at_rest) { last_ = at_rest; }
  /// From now on it is of the kind that brakes when nobody tells it anything (simulator/core/on_silence.hpp).
  void holds() { on_silence_ = simulator::OnSilence::kHolds; }
  /// Of which agent this setpoint is, judged as the simulator's vehicles do; kRival: it is not flown.
  protocol::Incumbent::Verdict hears(TrueTime now, const protocol::Setpoint& setpoint) {
    return agent_.hear(steady(now), setpoint.incarnation);
  }
  /// `setpoint`: as it is realised.
  void command(TrueTime now, const protocol::Setpoint& setpoint);
  void learn(TrueTime now, const protocol::AgentStatus& status) {
    if (follows(now) == 0 || follows(now) == status.incarnation) onward_.take(status);
  }
  void learn(const protocol::HeldPlans& held) { onward_.take(held); }
  /// The agent whose setpoints it flies; 0: none.
  [[nodiscard]] std::uint64_t follows(TrueTime now) const { return agent_.silent(steady(now)) ? 0 : *agent_.who(); }

  [[nodiscard]] TrueTime commanded_at() const { return since_; }
  /// What it does now, in the form of a command; it counts swarm time by itself since the last one.
  [[nodiscard]] protocol::Setpoint doing(TrueTime now);
  [[nodiscard]] protocol::CarrierState state(TrueTime now);

 private:
  [[nodiscard]] protocol::Setpoint extrapolated(TrueTime now) const;
  [[nodiscard]] protocol::Setpoint braked(TrueTime now) const;
  [[nodiscard]] protocol::Setpoint went_on(TrueTime now) const;

  /// Its clock is a true one.
  [[nodiscard]] static LocalTime steady(TrueTime now) { return LocalTime(now.time_since_epoch()); }

  protocol::Incumbent agent_{protocol::kSucceeded, Duration::zero()};
  TrueTime since_{};
  simulator::OnSilence on_silence_ = simulator::OnSilence::kGoesOn;
  bool led_ = false;
  double winch_lag_s_ = 0.0;
  double vehicle_lag_s_ = 0.0;
  protocol::Setpoint last_;
  simulator::Onward onward_;
  std::optional<TrueTime> alone_at_;  // the last time it was asked what it does by itself,
  protocol::Setpoint did_;            // and what that was
  simulator::CatchUp<Eigen::Vector3d> gap_w_m_{Eigen::Vector3d::Zero()};
  simulator::CatchUp<double> gap_m_{0.0};
};

}  // namespace gyre::swarm
