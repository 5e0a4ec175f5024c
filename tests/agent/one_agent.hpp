#pragma once
// One agent on virtual time, told everything a coordinator, a network and a vehicle can tell it.

#include "agent/core/agent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "common/mechanics/rest_plan.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::agent {

using protocol::AgentState;
using protocol::Beacon;
using protocol::Course;
using protocol::PlanNumber;
using protocol::Stage;
using std::chrono::milliseconds;
using std::chrono::seconds;

inline constexpr std::uint64_t kTerm = 0x10000;
inline constexpr PlanNumber kRest{kTerm, 1}, kMotion{kTerm, 2}, kOther{kTerm, 3};
/// The swarm's clock is this far from the agent's.
inline constexpr Duration kOffset = -std::chrono::hours(5);

class AgentTest : public testing::Test {
 protected:
  AgentTest() { restart(1); }

  void restart(std::uint64_t incarnation, const mechanics::Limits& vehicle = {}) {
    AgentOptions options;
    options.carrier = 1;
    options.incarnation = incarnation;
    options.vehicle = vehicle;
    agent_ = std::make_unique<Agent>(options);
  }

  [[nodiscard]] SwarmTime swarm() const { return SwarmTime(now_.time_since_epoch() + kOffset); }

  Outputs tell(const Event& event) {
    Outputs out = agent_->step(now_, event);
    if (out.status) status_ = out.status;
    if (out.held) held_ = out.held;
    if (out.setpoint) setpoint_ = out.setpoint;
    for (const Notice& notice : out.notices) heard_ += notice.text + "\n";
    return out;
  }

  protocol::TimeReply reply_to(const protocol::TimeRequest& request) {
    const SwarmTime then(request.sent.time_since_epoch() + kOffset + off_);
    return {1, request.incarnation, request.sequence, term_, request.sent, then, then};
  }

  /// Lets time pass; a coordinator that `answers` the time requests and beacons.
  void fly(Duration duration, bool answers = true) {
    for (const LocalTime end = now_ + duration; now_ < end; now_ += milliseconds(10)) {
      if (vehicle_) tell(*vehicle_);
      if (answers && course_) beacon();
      const Outputs out = tell(Tick{});
      if (answers && out.time_request) tell(TimeReplyArrived{reply_to(*out.time_request), now_});
      if (visit_ && out.setpoint) visit_(*out.setpoint);
    }
  }

  Outputs beacon() { return tell(Beacon{term_, ++sequence_, swarm() + off_, *course_}); }

  Outputs offer(const std::vector<PlanNumber>& numbers, std::uint64_t term = kTerm) {
    protocol::PlanOffer offer{1, term, {}};
    for (const PlanNumber& n : numbers) offer.slices.push_back({n, slice(n)});
    return tell(offer);
  }

  [[nodiscard]] mechanics::CarrierSlice slice(const PlanNumber& n) const {
    mechanics::Plan plan = mechanics::test::polygon_plan(4);
    if (n == kRest) plan = mechanics::rest_plan(plan);
    if (n == kOther) plan.cycle.rate_rad_s *= 1.3;
    return mechanics::slices(plan).front();
  }

  void rest() {
    offer({kRest, kMotion, kOther});
    course_ = Course{1, {kRest, swarm()}, {}};
    vehicle_at_rest();
    fly(seconds(3));
  }

  void vehicle_at_rest() {
    const auto r = mechanics::evaluate(slice(kRest), 0.0);
    vehicle_ = protocol::CarrierState{};
    vehicle_->carrier = 1;
    vehicle_->position_w_m = r.position_w_m.value;
    vehicle_->tension_n = r.tension_n.value;
    vehicle_->winch_length_m = vehicle_->cable_length_m = r.length_m.value;
    if (const double k = slice(kRest).cable_stiffness_n_m; k > 0.0) vehicle_->winch_length_m -= r.tension_n.value / k;
  }

  void transition(const PlanNumber& to, Duration in, Duration duration, Stage stage = Stage::kGo) {
    course_->transitions.push_back({++id_, {to, swarm() + in}, swarm() + in, duration, stage});
    ++course_->revision;
  }

  /// From now on, no setpoint may be further from the last than its own rates explain.
  void watch_for_steps() {
    visit_ = [this, last = setpoint_](const protocol::Setpoint& s) mutable {
      if (last) {
        const double dt = gyre::seconds(s.swarm_time - last->swarm_time);
        const Eigen::Vector3d mean = 0.5 * (s.velocity_w_m_s + last->velocity_w_m_s);
        EXPECT_LT((s.position_w_m - last->position_w_m - dt * mean).norm(), 1e-4);
        EXPECT_LT((s.velocity_w_m_s - last->velocity_w_m_s).norm(), 0.1);
        EXPECT_LT(
            std::abs(s.winch_length_m - last->winch_length_m - 0.5 * dt * (s.winch_rate_m_s + last->winch_rate_m_s)),
            1e-4);
        EXPECT_GT(dt, 0.0);
      }
      last = s;
    };
  }

  [[nodiscard]] mechanics::Reference reference(const PlanNumber& n, SwarmTime epoch) const {
    return mechanics::evaluate(slice(n), gyre::seconds(setpoint_->swarm_time - epoch));
  }

  std::uint64_t term_ = kTerm;
  Duration off_{};                         ///< the coordinator's swarm time
  LocalTime now_{-std::chrono::hours(1)};  // below zero: nothing may depend on where a clock begins
  std::unique_ptr<Agent> agent_;
  std::optional<Course> course_;
  std::optional<protocol::CarrierState> vehicle_;
  std::optional<protocol::AgentStatus> status_;
  std::optional<protocol::HeldPlans> held_;
  std::optional<protocol::Setpoint> setpoint_;
  std::function<void(const protocol::Setpoint&)> visit_;
  std::string heard_;
  std::uint64_t sequence_ = 0;
  std::uint64_t id_ = 0;
};

}  // namespace gyre::agent
