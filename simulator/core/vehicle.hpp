#pragma once
// A carrier's vehicle: led by its agent's setpoints, and going on by itself when none come.
//
// Intuition: the two take turns wherever packets are lost, and they mean the same path. What the last setpoint says of
// the present is extrapolated, and off by more the longer ago it held: 0.05 s later, by a millimetre where the path
// bends sharply and a machine that lags is asked ahead. That is no gap to be caught up with over seconds: its speed is
// off by centimetres per second, which carry far. So whether the two mean the same is judged at the moment for which
// the last setpoint was said, where nothing is extrapolated.
//
// A setpoint that is old on arrival leads nobody: its vehicle is silent before and after, and is on its path by then.
// All times are those of the clock here; `start` is when simulated time began.

#include <optional>

#include "common/base/time.hpp"
#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"
#include "simulator/core/carrier_follower.hpp"
#include "simulator/core/held_time.hpp"
#include "simulator/core/load_dynamics.hpp"
#include "simulator/core/on_silence.hpp"
#include "simulator/core/onward.hpp"
#include "simulator/core/winch.hpp"

namespace gyre::simulator {

/// A carrier without a setpoint for longer is not led by anybody.
inline constexpr Duration kLongestSilence = std::chrono::seconds(1);

class Vehicle {
 public:
  Vehicle(CarrierId own_id, OnSilence when_silent, const CarrierFollower& carrier, const Winch& drum)
      : id(own_id), on_silence_(when_silent), follower_(carrier), winch_(drum) {}

  /// From the tick at `now` on it is led by what held at `held`, or holds in a moment (held_time.hpp).
  void take_up(const protocol::Setpoint& setpoint, LocalTime held, LocalTime now, LocalTime start);

  /// Decides the motion from `now` until the next tick; once per tick, in order, after what is taken up then.
  void tick(LocalTime now, LocalTime start);

  [[nodiscard]] Anchor anchor(double t_s) const;

  CarrierId id = 0;
  HeldTime held_time;
  protocol::Liveness led{kLongestSilence};
  Onward onward;

 private:
  struct Last {
    protocol::Setpoint setpoint;
    LocalTime held;
  };

  [[nodiscard]] bool silent(LocalTime now) const { return last_ && now - last_->held > kGoesOnAfter; }
  /// Along the path, by its own count of swarm time.
  void go_on(LocalTime now, LocalTime start);
  [[nodiscard]] std::optional<protocol::Setpoint> path(LocalTime now) const;
  /// Whether what its agent asked for last lies beside the path.
  [[nodiscard]] bool was_led_elsewhere() const;
  void command(const protocol::Setpoint& s, double held_s, double now_s, Hand hand);

  OnSilence on_silence_;
  CarrierFollower follower_;
  Winch winch_;
  std::optional<Last> last_;
  bool alone_ = false;  ///< what it was told last it told itself
};

}  // namespace gyre::simulator
