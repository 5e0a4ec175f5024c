// What a vehicle says of where it is, by when it says so: a word that waited is not the present.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

/// With a vehicle that says when it was where.
class StampedVehicleTest : public AgentTest {
 protected:
  /// It is where it was asked to be.
  void vehicle_follows() {
    vehicle_->position_w_m = setpoint_->position_w_m;
    vehicle_->velocity_w_m_s = setpoint_->velocity_w_m_s;
    vehicle_->winch_length_m = setpoint_->winch_length_m;
  }

  /// One period; what the vehicle tells is so old.
  void fly_stamped(Duration age) {
    vehicle_->stamp = now_ + std::chrono::hours(3) - age;
    fly(milliseconds(10));
  }
};

TEST_F(StampedVehicleTest, AfterALongStallStatesThatWaitedAreNotBelievedHoweverLongTheyAreRead) {
  rest();
  for (int i = 0; i < 100; ++i) fly_stamped(Duration::zero());
  const Duration waited = seconds(2);
  now_ += waited;
  const std::uint64_t before = setpoint_->sequence;
  for (int i = 0; i < 30; ++i) fly_stamped(waited);
  EXPECT_EQ(setpoint_->sequence, before) << "0.3 s after it woke, all it has read is two seconds old";
  vehicle_->position_w_m += Eigen::Vector3d(0.1, -0.05, 0.02);
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  for (int i = 0; i < 3; ++i) fly_stamped(Duration::zero());
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-9);
}

TEST_F(StampedVehicleTest, WhoseWordWaitedIsNotCalledBackToTheTimeOfIt) {
  engage();
  vehicle_at_rest();
  for (int i = 0; i < 100; ++i) {
    vehicle_follows();
    fly_stamped(Duration::zero());
  }
  watch_for_steps();
  vehicle_follows();
  const protocol::CarrierState said = *vehicle_;
  vehicle_.reset();  // it was stopped, and goes on along its path by itself
  fly(seconds(2));
  ASSERT_GT((setpoint_->position_w_m - said.position_w_m).norm(), 0.1);
  const std::uint64_t before = setpoint_->sequence;
  vehicle_ = said;
  fly_stamped(seconds(2));  // sent when it woke
  for (int i = 0; i < 50; ++i) {
    vehicle_follows();
    fly_stamped(Duration::zero());
  }
  EXPECT_EQ(setpoint_->sequence, before + 51) << "not one setpoint is left out";
}

TEST_F(StampedVehicleTest, WhoseFirstWordIsLateIsNotCalledBackEither) {
  engage();
  vehicle_at_rest();
  vehicle_->position_w_m = setpoint_->position_w_m;
  fly(milliseconds(100));  // nothing is known of delays
  watch_for_steps();
  vehicle_.reset();
  fly(seconds(2));
  vehicle_at_rest();
  vehicle_follows();
  const protocol::CarrierState said = *vehicle_;
  vehicle_.reset();
  fly(milliseconds(900));
  vehicle_ = said;
  const std::uint64_t before = setpoint_->sequence;
  fly_stamped(milliseconds(900));
  for (int i = 0; i < 50; ++i) {
    vehicle_follows();
    fly_stamped(Duration::zero());
  }
  EXPECT_GE(setpoint_->sequence, before + 49) << "the next word shows that it was late";
  EXPECT_LT(off_the_plan_m(), 1e-9) << "where it seemed to be was where it had been";
}

}  // namespace
}  // namespace gyre::agent
