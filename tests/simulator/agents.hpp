#pragma once
// The agents of a plan, as far as the simulator hears them.

#include <vector>

#include "common/mechanics/plan.hpp"
#include "common/mechanics/reference.hpp"
#include "common/protocol/messages.hpp"
#include "common/protocol/pace.hpp"

namespace gyre::simulator::rigs {

/// What a plan's agents send: from rest to full pace within `engage_s`, stretch compensated, ahead of declared lags.
class Agents {
 public:
  explicit Agents(const mechanics::Plan& plan, double engage_s = 20.0)
      : compliance_m_n_(1.0 / plan.cable.stiffness_n_m),
        pace_(protocol::Pace{}.with_ramp(SwarmTime{}, from_seconds(engage_s), 1.0)),
        slices_(mechanics::slices(plan)) {}

  [[nodiscard]] std::size_t count() const { return slices_.size(); }

  [[nodiscard]] protocol::Setpoint setpoint(std::size_t carrier, Duration since_start) const {
    const protocol::PlanMoment moment = pace_.at(SwarmTime(since_start));
    const mechanics::Reference r = mechanics::evaluate(slices_[carrier], seconds(moment.at.time_since_epoch()));
    const auto position =
        mechanics::led(mechanics::paced(r.position_w_m, moment.pace, moment.rate_1_s), slices_[carrier].vehicle_lag_s);
    const auto winch =
        mechanics::led(mechanics::paced(r.length_m - compliance_m_n_ * r.tension_n, moment.pace, moment.rate_1_s),
                       slices_[carrier].winch_lag_s);
    protocol::Setpoint s;
    s.carrier = slices_[carrier].id;
    s.swarm_time = SwarmTime(since_start);
    s.position_w_m = position.value;
    s.velocity_w_m_s = position.first;
    s.acceleration_w_m_s2 = position.second;
    s.winch_length_m = winch.value;
    s.winch_rate_m_s = winch.first;
    s.winch_acceleration_m_s2 = winch.second;
    return s;
  }

  /// What their vehicles need to know to go on by.
  [[nodiscard]] protocol::AgentStatus status(std::size_t carrier) const {
    protocol::AgentStatus s;
    s.carrier = slices_[carrier].id;
    s.term = 1;
    s.course.term = 1;
    s.course.revision = 1;
    s.course.pace = pace_;
    s.course.base.number = kNumber;
    return s;
  }
  [[nodiscard]] protocol::HeldPlans held(std::size_t carrier) const {
    protocol::HeldPlans held;
    held.carrier = slices_[carrier].id;
    held.slices = {{kNumber, slices_[carrier]}};
    return held;
  }

 private:
  static constexpr protocol::PlanNumber kNumber{1, 1};
  double compliance_m_n_;
  protocol::Pace pace_;
  std::vector<mechanics::CarrierSlice> slices_;
};

}  // namespace gyre::simulator::rigs
