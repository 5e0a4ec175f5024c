// How an agent comes back: after a stall, after a restart, never with a step.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

TEST_F(AgentTest, AStallIsNotMadeUpFor) {
  rest();
  const std::uint64_t before = setpoint_->sequence;
  now_ += milliseconds(150);
  const Outputs first = tell(Tick{});
  EXPECT_EQ(first.next_tick, now_ + milliseconds(10));
  for (int i = 0; i < 100; ++i) tell(Tick{});
  EXPECT_EQ(setpoint_->sequence, before + 1);
}

TEST_F(AgentTest, AfterALongStallItBeginsWhereItsCarrierHasGone) {
  rest();
  const Eigen::Vector3d planned = setpoint_->position_w_m;
  now_ += seconds(2);
  const std::uint64_t before = setpoint_->sequence;
  tell(*vehicle_);  // said before the stall, and heard only now
  tell(Tick{});
  EXPECT_EQ(setpoint_->sequence, before) << "it does not know yet where its vehicle is";
  vehicle_->position_w_m += Eigen::Vector3d(0.1, -0.05, 0.02);
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(milliseconds(200));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-9);
  fly(seconds(10));
  EXPECT_LT((setpoint_->position_w_m - planned).norm(), 1e-9);
}

TEST_F(AgentTest, AfterALongStallOldStatesThatWaitedForItAreNotBelieved) {
  rest();
  now_ += seconds(2);
  const std::uint64_t before = setpoint_->sequence;
  fly(milliseconds(140));  // the vehicle's word from before the stall, again and again
  EXPECT_EQ(setpoint_->sequence, before);
  vehicle_->position_w_m += Eigen::Vector3d(0.1, -0.05, 0.02);
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(milliseconds(100));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-9);
}

TEST_F(AgentTest, AfterALongStallAMuteVehicleIsNotWaitedForForEver) {
  rest();
  vehicle_.reset();
  now_ += seconds(2);
  const std::uint64_t before = setpoint_->sequence;
  fly(seconds(1));
  EXPECT_GT(setpoint_->sequence, before);
}

TEST_F(AgentTest, AVehicleThatHeardNothingIsCalledFromWhereItStopped) {
  engage();
  vehicle_at_rest();
  vehicle_->position_w_m = setpoint_->position_w_m;
  vehicle_->winch_length_m = setpoint_->winch_length_m;
  fly(milliseconds(20));
  const protocol::CarrierState stopped = *vehicle_;
  vehicle_.reset();  // the wire to the vehicle is out, both ways
  fly(seconds(3));
  ASSERT_GT((setpoint_->position_w_m - stopped.position_w_m).norm(), 0.1);
  vehicle_ = stopped;
  fly(milliseconds(200));
  EXPECT_LT((setpoint_->position_w_m - stopped.position_w_m).norm(), 0.01);
  watch_for_steps();
  vehicle_.reset();
  fly(seconds(20));
  EXPECT_LT(off_the_plan_m(), 1e-9);
}

TEST_F(AgentTest, AVehicleThatWasOnlyNotHeardFliesOn) {
  engage();
  watch_for_steps();
  vehicle_at_rest();
  vehicle_->position_w_m = setpoint_->position_w_m + Eigen::Vector3d(0.02, 0.0, 0.0);  // it tracks as well as it can
  fly(milliseconds(20));
  vehicle_.reset();
  const std::uint64_t before = setpoint_->sequence;
  fly(milliseconds(200));
  EXPECT_EQ(setpoint_->sequence, before + 20) << "not one setpoint is left out";
}

TEST_F(AgentTest, RestartedInFlightItBeginsWhereItsCarrierIs) {
  rest();
  vehicle_->position_w_m += Eigen::Vector3d(0.3, -0.2, 0.1);
  vehicle_->velocity_w_m_s = Eigen::Vector3d(0.2, 0.1, 0.0);
  restart(3);
  setpoint_.reset();
  std::optional<protocol::Setpoint> first;
  course(kMotion, 1.0);
  course_->base.epoch -= seconds(7);
  offer({kMotion, kOther});
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(milliseconds(500));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 0.01);
  watch_for_steps();
  fly(seconds(20));
  EXPECT_LT(off_the_plan_m(), 1e-9);
}

TEST_F(AgentTest, RestartedInFlightItAllowsForTheAgeOfItsVehiclesWord) {
  rest();
  vehicle_->velocity_w_m_s = Eigen::Vector3d(0.4, 0.3, 0.0);
  vehicle_->winch_rate_m_s = 0.1;
  const protocol::CarrierState said = *vehicle_;
  restart(3);
  setpoint_.reset();
  offer({kMotion, kOther});
  const LocalTime then = now_;
  tell(said);
  vehicle_.reset();
  fly(milliseconds(100), false);
  while (!setpoint_ && now_ < then + milliseconds(400)) fly(milliseconds(10));
  ASSERT_TRUE(setpoint_);
  const double age_s = gyre::seconds(now_ - milliseconds(10) - then);
  ASSERT_GT(age_s, 0.05);
  EXPECT_LT((setpoint_->position_w_m - (said.position_w_m + age_s * said.velocity_w_m_s)).norm(), 1e-3);
  EXPECT_NEAR(setpoint_->winch_length_m, said.winch_length_m + age_s * said.winch_rate_m_s, 1e-4);
}

TEST_F(AgentTest, RestartedAndStalledBeforeItsFirstSetpointItBeginsWhereItsCarrierIsByThen) {
  rest();
  restart(3);
  setpoint_.reset();
  course(kMotion, 1.0);
  course_->base.epoch -= seconds(7);
  offer({kMotion, kOther});
  // Until it has swarm time and a course, and not one tick longer.
  while (status_->incarnation != 3 || status_->course.base.number.none()) {
    now_ += milliseconds(1);
    tell(*vehicle_);
    beacon();
    const Outputs out = setpoint_ ? Outputs{} : agent_->step(now_, Tick{});
    ASSERT_FALSE(out.setpoint) << "it should not have come so far";
    if (out.status) status_ = out.status;
    if (out.time_request) tell(TimeReplyArrived{reply_to(*out.time_request), now_});
  }
  now_ += milliseconds(1400);
  vehicle_->position_w_m += Eigen::Vector3d(0.1, 0.0, 0.0);
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(milliseconds(500));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-3);
}

TEST_F(AgentTest, RestartedFarAheadOnItsPathItIsNotMovedByALeaseThatGrows) {
  for (const double ahead_s : {0.3, 0.8, 1.2, 1.6, 2.0}) {
    SCOPED_TRACE(ahead_s);
    rest();
    mechanics::Limits strong;
    strong.speed_max_m_s = strong.acceleration_max_m_s2 = strong.winch_rate_max_m_s = 100.0;
    restart(7, strong);
    setpoint_.reset();
    visit_ = nullptr;
    offer({kMotion, kOther});
    course(kMotion, 1.0);
    vehicle_->position_w_m = mechanics::evaluate(slice(kMotion), ahead_s + 0.3).position_w_m.value;
    course_->lease = swarm() + seconds(1);
    fly(milliseconds(400));
    ASSERT_TRUE(setpoint_);
    watch_for_steps();
    for (int i = 0; i < 100; ++i) {
      course_->lease = swarm() + seconds(1);
      fly(milliseconds(100));
    }
  }
}

TEST_F(AgentTest, StoppedBeforeItHadACourseItDoesNotBelieveWhatWaitedForIt) {
  course_.reset();
  offer({kMotion, kOther});
  vehicle_at_rest();
  const protocol::CarrierState old = *vehicle_;
  fly(milliseconds(500));  // it has swarm time, and nothing to fly
  now_ += milliseconds(400);
  vehicle_->position_w_m += Eigen::Vector3d(0.2, 0.1, 0.0);
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  course(kMotion, 1.0);
  tell(old);  // what waited comes first
  beacon();
  fly(milliseconds(600));
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-3);
}

TEST_F(AgentTest, RestartedItWaitsForItsVehicleButNotForEver) {
  offer({kMotion});
  course(kMotion, 1.0);
  fly(milliseconds(400));
  EXPECT_FALSE(setpoint_) << "where the carrier is, is not known yet";
  fly(milliseconds(400));
  EXPECT_TRUE(setpoint_);
}

TEST_F(AgentTest, RestartedItDoesNotBeginWhereItsVehicleWasLongAgo) {
  rest();
  restart(3);
  setpoint_.reset();
  vehicle_->position_w_m += Eigen::Vector3d(0.3, -0.2, 0.1);
  tell(*vehicle_);
  vehicle_.reset();
  course_.reset();
  fly(milliseconds(1100));  // swarm time is found meanwhile, and nothing is heard of the vehicle
  offer({kMotion, kOther});
  course(kMotion, 1.0);
  fly(milliseconds(400));
  EXPECT_FALSE(setpoint_) << "its vehicle may say where it is by now";
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (first) return;
    first = s;
    EXPECT_LT(off_the_plan_m(), 1e-9);
  };
  fly(milliseconds(200));
  EXPECT_TRUE(first);
}

TEST_F(AgentTest, AClockThatStoodStillIsFoundAnewAndMeanwhileTheVehicleKnowsBetter) {
  engage();
  off_ = seconds(20);  // this process stood still so long, or its machine: the swarm went on
  vehicle_at_rest();
  vehicle_->position_w_m.x() += 0.1;
  std::optional<protocol::Setpoint> first;
  visit_ = [&](const protocol::Setpoint& s) {
    if (!first) first = s;
  };
  fly(milliseconds(500));
  EXPECT_FALSE(first) << "beacons come from the future: what it would say is for another time";
  EXPECT_EQ(heard_.find("a clock jumped"), std::string::npos) << "a few strange words are no proof";
  fly(seconds(2));
  EXPECT_NE(heard_.find("a clock jumped"), std::string::npos) << heard_;
  ASSERT_TRUE(first);
  EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-3) << "it begins where the vehicle has got to";
  EXPECT_LT(std::abs(gyre::seconds(setpoint_->swarm_time - swarm() - off_)), 0.05);
  vehicle_.reset();
  watch_for_steps();
  fly(seconds(60));
  EXPECT_LT(off_the_plan_m(), 1e-6);
  EXPECT_EQ(status_->state, AgentState::kFlying) << "beacons are heard again";
}

// No time has passed; to the agent it is as if it had been stopped for so long.
TEST_F(AgentTest, AClockThatLeaptIsFoundAnewAndMeanwhileTheVehicleKnowsBetter) {
  for (const Duration leap : {Duration(milliseconds(700)), Duration(seconds(5)), Duration(std::chrono::hours(1))}) {
    restart(1);
    off_ = Duration::zero();
    heard_.clear();
    visit_ = nullptr;
    engage();
    now_ += leap;
    off_ = -leap;
    vehicle_at_rest();
    vehicle_->position_w_m.x() += 0.1;
    std::optional<protocol::Setpoint> first;
    visit_ = [&](const protocol::Setpoint& s) {
      if (!first) first = s;
    };
    fly(milliseconds(700));
    EXPECT_FALSE(first) << "beacons are old, all of them: what it would say is for another time";
    fly(seconds(2));
    EXPECT_NE(heard_.find("a clock jumped"), std::string::npos) << heard_;
    ASSERT_TRUE(first);
    EXPECT_LT((first->position_w_m - vehicle_->position_w_m).norm(), 1e-3) << "it begins where the vehicle has got to";
    EXPECT_LT(std::abs(gyre::seconds(setpoint_->swarm_time - swarm() - off_)), 0.05);
    vehicle_.reset();
    watch_for_steps();
    fly(seconds(60));
    EXPECT_LT(off_the_plan_m(), 1e-6);
    EXPECT_EQ(status_->state, AgentState::kFlying) << "beacons are heard again";
  }
}

// As a coordinator's is that learned swarm time from its agents' words, which were on their way for so long.
TEST_F(AgentTest, AClockThatIsALittleOffIsFoundAnewWhileTheVehicleIsLed) {
  for (const Duration off : {milliseconds(4), -milliseconds(4)}) {
    restart(1);
    off_ = Duration::zero();
    heard_.clear();
    visit_ = nullptr;
    engage();
    off_ = off;
    watch_for_steps();
    int setpoints = 0;
    visit_ = [&setpoints, watch = visit_](const protocol::Setpoint& s) {
      ++setpoints;
      watch(s);
    };
    fly(seconds(3));
    EXPECT_NE(heard_.find("a clock jumped"), std::string::npos) << heard_;
    EXPECT_EQ(setpoints, 300) << "it was told where to be all the time, and need not tell where it is";
    fly(seconds(60));
    EXPECT_LT(off_the_plan_m(), 1e-6);
  }
}

TEST_F(AgentTest, StoppedItDoesNotWaitForMoreThanItsFirstFreshBeacon) {
  engage();
  now_ += seconds(2);
  for (int i = 100; i > 0; --i) {  // what has waited for it
    tell(Beacon{kTerm, ++sequence_, swarm() - i * milliseconds(20), *course_, {}, {}});
  }
  int setpoints = 0;
  visit_ = [&](const protocol::Setpoint&) { ++setpoints; };
  vehicle_at_rest();
  fly(milliseconds(300));
  EXPECT_GE(setpoints, 14) << "after the time for which old words of its vehicle may come";
}

TEST_F(AgentTest, OneBeaconFromTheFutureSilencesNobody) {
  engage();
  watch_for_steps();
  Beacon lie{kTerm, sequence_ + 1, swarm() + seconds(1), *course_, {}, {}};
  tell(lie);
  int setpoints = 0;
  const auto watch = visit_;
  visit_ = [&](const protocol::Setpoint& s) {
    ++setpoints;
    watch(s);
  };
  fly(milliseconds(100));
  EXPECT_GE(setpoints, 9);
}

}  // namespace
}  // namespace gyre::agent
