// What an agent asks of machines that lag: everything ahead of time, and nothing that would make them jump.

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

constexpr double kWinchLag_s = 0.05;
constexpr double kVehicleLag_s = 0.2;

class LagTest : public AgentTest {
 protected:
  void offer_lagging() {
    protocol::PlanOffer offer = plans({kMotion, kOther});
    for (protocol::NumberedSlice& s : offer.slices) {
      s.slice.winch_lag_s = kWinchLag_s;
      s.slice.vehicle_lag_s = kVehicleLag_s;
    }
    tell(offer);
  }
  void rest_lagging() {
    offer_lagging();
    course(kMotion);
    vehicle_at_rest();
    fly(seconds(3));
  }
  /// Where the plan has it, and its winch, by swarm time.
  [[nodiscard]] Command planned_at(SwarmTime at) const {
    const protocol::PlanMoment moment = course_->moment(at);
    const mechanics::Reference r = mechanics::evaluate(slice(kMotion), gyre::seconds(moment.at.time_since_epoch()));
    const auto winch = mechanics::paid_out(r, slice(kMotion).cable_stiffness_n_m);
    return {mechanics::paced(r.position_w_m, moment.pace, moment.rate_1_s),
            mechanics::paced(winch, moment.pace, moment.rate_1_s)};
  }
};

TEST_F(LagTest, AsksForThePlanAheadOfItsMachinesAtAnyPace) {
  rest_lagging();
  EXPECT_LT(off_the_plan_m(), 1e-9) << "what stands is not late";
  vehicle_.reset();
  double ahead_m = 0.0;
  visit_ = [&](const protocol::Setpoint& s) {
    const auto [place, winch] = planned_at(s.swarm_time);
    // x + T x', and its rate.
    EXPECT_LT((s.position_w_m - place.value - kVehicleLag_s * place.first).norm(), 1e-8);
    EXPECT_LT((s.velocity_w_m_s - place.first - kVehicleLag_s * place.second).norm(), 1e-8);
    EXPECT_LT((s.acceleration_w_m_s2 - place.second).norm(), 1e-8);
    EXPECT_NEAR(s.winch_length_m, winch.value + kWinchLag_s * winch.first, 1e-8);
    EXPECT_NEAR(s.winch_rate_m_s, winch.first + kWinchLag_s * winch.second, 1e-8);
    // The cable is where the plan has it.
    EXPECT_NEAR(s.cable_length_m, planned().length_m.value, 1e-8);
    ahead_m = std::max(ahead_m, (s.position_w_m - place.value).norm());
  };
  ramp(milliseconds(200), seconds(2), 1.0);
  fly(seconds(6));
  ramp(milliseconds(200), seconds(2), 0.0);
  fly(seconds(3));
  EXPECT_GT(ahead_m, 0.01);
}

TEST_F(LagTest, AnAgentThatStartsAgainLeadsItsVehicleOnFromWhereItIs) {
  rest_lagging();
  ramp(milliseconds(200), seconds(2), 1.0);
  // A vehicle that lags: it follows what it was told last, and goes on by it while nothing is said.
  protocol::Setpoint asked = *setpoint_;
  LocalTime heard = now_;
  double off_m = 0.0, jump_m_s = 0.0;
  const auto follow = [&] {
    const double since_s = gyre::seconds(now_ - heard);
    const Eigen::Vector3d there =
        asked.position_w_m + since_s * asked.velocity_w_m_s + 0.5 * since_s * since_s * asked.acceleration_w_m_s2;
    const Eigen::Vector3d before_m_s = vehicle_->velocity_w_m_s;
    vehicle_->velocity_w_m_s = (there - vehicle_->position_w_m) / kVehicleLag_s;
    vehicle_->position_w_m += 0.001 * vehicle_->velocity_w_m_s;
    vehicle_->winch_rate_m_s =
        (asked.winch_length_m + since_s * asked.winch_rate_m_s - vehicle_->winch_length_m) / kWinchLag_s;
    vehicle_->winch_length_m += 0.001 * vehicle_->winch_rate_m_s;
    jump_m_s = std::max(jump_m_s, (vehicle_->velocity_w_m_s - before_m_s).norm());
  };
  const auto fly_with_it = [&](Duration duration) {
    for (const LocalTime end = now_ + duration; now_ < end;) {
      setpoint_.reset();
      fly(milliseconds(10));
      if (setpoint_) {
        asked = *setpoint_;
        heard = now_ - milliseconds(10);
      }
      now_ -= milliseconds(10);
      for (int i = 0; i < 10; ++i, now_ += milliseconds(1)) follow();
    }
    off_m = (vehicle_->position_w_m - planned_at(swarm()).position_w_m.value).norm();
  };
  fly_with_it(seconds(6));
  EXPECT_LT(off_m, 2e-3) << "it flies its plan, as well as a millisecond's Euler steps do";
  restart(2);
  offer_lagging();
  jump_m_s = 0.0;
  fly_with_it(seconds(8));
  EXPECT_LT(off_m, 2e-3);
  EXPECT_LT(jump_m_s, 0.05) << "a setpoint that was not ahead would have slowed it down by all of its lag";
}

}  // namespace
}  // namespace gyre::agent
