// Two agents of one carrier, and two vehicles of one agent: who is not believed does nothing, and everybody says so.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

constexpr std::uint64_t kRival = 77;

class IdentityTest : public AgentTest {
 protected:
  [[nodiscard]] std::string complaint() const { return agent_->complaint(now_).value_or("none"); }
  [[nodiscard]] std::uint64_t sent() const { return setpoint_ ? setpoint_->sequence : 0; }
};

TEST_F(IdentityTest, ANewcomerBesideAnAgentThatFliesFollowsNothingAndSaysWhereThatOneIs) {
  believed_ = kRival;
  rival_ = "10.0.0.3 (vehicle-3, pid 4711)";
  rest();
  EXPECT_EQ(sent(), 0U);
  EXPECT_EQ(status_->state, AgentState::kWaiting);
  EXPECT_TRUE(status_->course.none()) << "it has no lease either";
  EXPECT_EQ(complaint(), "another agent flies this carrier, at 10.0.0.3 (vehicle-3, pid 4711); end one of the two");
  proposal_ = with_ramp(milliseconds(300), seconds(2), 1.0);
  fly(seconds(1));
  EXPECT_EQ(status_->confirmed, 0U);
}

TEST_F(IdentityTest, KnowsThatBeforeItKnowsSwarmTime) {
  offer({kMotion});
  course(kMotion);
  believed_ = kRival;
  fly(milliseconds(10));
  EXPECT_FALSE(status_->swarm_time > SwarmTime{});
  EXPECT_EQ(complaint().substr(0, 30), "another agent flies this carri");
}

TEST_F(IdentityTest, WhenTheOtherGoesItBeginsWhereTheCarrierIs) {
  believed_ = kRival;
  rest();
  vehicle_->position_w_m += Eigen::Vector3d(0.1, -0.05, 0.02);
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(seconds(2));
  ASSERT_FALSE(first);
  believed_ = 1;
  fly(milliseconds(300));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-9);
  EXPECT_EQ(complaint(), "none");
  watch_for_steps();
  fly(seconds(10));
  EXPECT_LT(off_the_plan_m(), 1e-9);
}

TEST_F(IdentityTest, AnAgentThatFliesAndIsNotBelievedAnyMoreStopsSending) {
  engage();
  believed_ = kRival;
  fly(milliseconds(200));
  const std::uint64_t before = sent();
  fly(seconds(1));
  EXPECT_EQ(sent(), before);
  EXPECT_EQ(status_->state, AgentState::kWaiting);
}

TEST_F(IdentityTest, TheOneThatIsBelievedFliesOnAndSaysThatThereIsAnother) {
  engage();
  believed_ = 1;
  rival_ = "10.0.0.9 (lab, pid 5)";
  watch_for_steps();
  const std::uint64_t before = sent();
  fly(seconds(1));
  EXPECT_EQ(sent(), before + 100);
  EXPECT_EQ(complaint(), "another agent claims this carrier, at 10.0.0.9 (lab, pid 5); end one of the two");
  rival_.clear();
  fly(milliseconds(200));
  EXPECT_EQ(complaint().find("another agent"), std::string::npos);
}

TEST_F(IdentityTest, ItsSetpointsAreSignedAndItsStatusTellsWhereItIs) {
  rest();
  EXPECT_EQ(setpoint_->incarnation, 1U);
  EXPECT_EQ(status_->address, "here");
}

TEST_F(IdentityTest, ASecondVehicleIsNotBelievedWhileTheFirstTellsAndIsComplainedOf) {
  rest();
  vehicle_->incarnation = 5;
  fly(milliseconds(1500));
  protocol::CarrierState other = *vehicle_;
  other.incarnation = 6;
  other.position_w_m += Eigen::Vector3d(3.0, 0.0, 0.0);
  watch_for_steps();
  for (int i = 0; i < 50; ++i) {
    tell(other);
    fly(milliseconds(10));
    tell(other);
  }
  EXPECT_EQ(complaint(), "two vehicles, or simulators, tell where this carrier is; end one of them");
  // It comes back from a stall of its own, and asks where the carrier is: the other one answers first.
  now_ += seconds(2);
  visit_ = nullptr;
  for (int i = 0; i < 50; ++i) {
    fly(milliseconds(10));
    tell(other);
  }
  EXPECT_LT(off_the_plan_m(), 0.01);
  // And it goes as it came.
  fly(seconds(2));
  EXPECT_EQ(complaint(), "none");
  EXPECT_LT(off_the_plan_m(), 0.01);
}

TEST_F(IdentityTest, AVehicleThatTakesOverFromOneThatFellSilentIsLedFromWhereItIs) {
  rest();
  vehicle_->incarnation = 6;
  vehicle_->position_w_m += Eigen::Vector3d(0.3, 0.0, 0.0);
  std::optional<protocol::Setpoint> last;
  visit_ = [&](const protocol::Setpoint& s) { last = s; };
  fly(milliseconds(1500));
  ASSERT_TRUE(last);
  EXPECT_LT((last->position_w_m - vehicle_->position_w_m).norm(), 0.1);
}

TEST_F(IdentityTest, SaysThatItsVehicleFollowsAnotherAgentUnlessThatIsOverInAMoment) {
  rest();
  vehicle_->follows = 1;
  fly(seconds(1));
  EXPECT_EQ(complaint(), "none");
  vehicle_->follows = kRival;
  fly(milliseconds(400));
  EXPECT_EQ(complaint(), "none");
  fly(milliseconds(400));
  EXPECT_EQ(complaint(), "its vehicle follows another agent; end one of the two");
  vehicle_->follows = 1;
  fly(milliseconds(20));
  EXPECT_EQ(complaint(), "none");
}

TEST_F(IdentityTest, AnAgentWhoseVehicleFollowsAnotherSaysNothingAndThenBeginsWhereItIs) {
  rest();
  vehicle_->follows = kRival;
  fly(milliseconds(100));
  const std::uint64_t before = sent();
  fly(seconds(2));
  EXPECT_EQ(sent(), before) << "it would not be flown";
  vehicle_->position_w_m += Eigen::Vector3d(0.2, 0.0, 0.1);
  vehicle_->follows = 0;  // that one is gone
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(milliseconds(300));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-9);
}

TEST_F(IdentityTest, AnAgentDoesNotWaitForAVehicleThatIsNotHeardAnyMore) {
  rest();
  vehicle_->follows = kRival;
  fly(milliseconds(100));
  vehicle_.reset();
  const std::uint64_t before = sent();
  fly(seconds(2));
  EXPECT_GT(sent(), before + 50);
}

}  // namespace
}  // namespace gyre::agent
