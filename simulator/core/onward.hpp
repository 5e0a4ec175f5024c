#pragma once
// How a vehicle that does not hold (on_silence.hpp) goes on when no more setpoints come: along its path, as its agent
// last said that it would.
//
// A silent agent is no reason to leave the path: whoever coasts on, or stops, takes his share of the load with him.
// What an agent publishes anyway says all there is to know: its status the course with its lease, its held plans the
// slices. So the vehicle evaluates the same formula (protocol/follow.hpp) and stops where all the others stop.

#include <map>
#include <optional>

#include "common/protocol/messages.hpp"

namespace gyre::simulator {

class Onward {
 public:
  void take(const protocol::AgentStatus& status);
  void take(const protocol::HeldPlans& held);

  /// What a setpoint would ask for; absent: the course, or one of its plans, is not known.
  [[nodiscard]] std::optional<protocol::Setpoint> at(SwarmTime now) const;

 private:
  protocol::Course course_;
  std::map<protocol::PlanNumber, mechanics::CarrierSlice> slices_;
};

}  // namespace gyre::simulator
