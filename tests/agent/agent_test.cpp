// What an agent does with what it is told.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

TEST_F(AgentTest, SendsNoSetpointWithoutSwarmTime) {
  offer({kRest});
  course_ = Course{1, {kRest, swarm()}, {}};
  fly(seconds(2), false);
  beacon();
  EXPECT_FALSE(setpoint_);
  EXPECT_EQ(status_->state, AgentState::kWaiting);
}

TEST_F(AgentTest, SendsNoSetpointWithoutThePlan) {
  offer({kMotion});
  course_ = Course{1, {kRest, swarm()}, {}};
  fly(seconds(2));
  EXPECT_FALSE(setpoint_);
  EXPECT_EQ(status_->state, AgentState::kWaiting);
  EXPECT_TRUE(status_->course.base.number.none()) << "flies a course it does not hold";
}

TEST_F(AgentTest, FliesThePlanAtSwarmTimeAndCompensatesStretch) {
  rest();
  EXPECT_EQ(status_->state, AgentState::kReady);
  const auto r = reference(kRest, course_->base.epoch);
  EXPECT_LT((setpoint_->position_w_m - r.position_w_m.value).norm(), 1e-9);
  EXPECT_NEAR(setpoint_->cable_length_m, r.length_m.value, 1e-9);
  const double k = slice(kRest).cable_stiffness_n_m;
  EXPECT_NEAR(setpoint_->winch_length_m, r.length_m.value - (k > 0.0 ? r.tension_n.value / k : 0.0), 1e-9);
  EXPECT_LT(std::abs(gyre::seconds(status_->swarm_time.time_since_epoch() - now_.time_since_epoch() - kOffset)), 0.2);
}

TEST_F(AgentTest, SaysWhatItHoldsAndAccepts) {
  rest();
  EXPECT_EQ(status_->accepted, (std::vector<PlanNumber>{kRest, kMotion, kOther}));
  ASSERT_EQ(held_->slices.size(), 3U);
  EXPECT_TRUE(held_->slices[1].slice == slice(kMotion));
}

TEST_F(AgentTest, ConfirmsOnlyWhatItHoldsAndInTime) {
  rest();
  transition({kTerm, 99}, milliseconds(600), seconds(5), Stage::kProposed);
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, 0U) << "a plan it does not hold";
  course_->transitions.clear();
  transition(kMotion, -milliseconds(1), seconds(5), Stage::kProposed);
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, 0U) << "too late";
  course_->transitions.clear();
  transition(kMotion, milliseconds(600), seconds(5), Stage::kProposed);
  fly(milliseconds(100));
  EXPECT_EQ(status_->confirmed, id_);
  fly(seconds(10));
  EXPECT_EQ(status_->state, AgentState::kReady) << "a proposal is not flown";
}

TEST_F(AgentTest, SpeaksFourTimesAsOftenWhileItsWordIsWaitedFor) {
  rest();
  const auto words_in_a_second = [this] {
    const std::uint64_t before = status_->sequence;
    fly(seconds(1));
    return status_->sequence - before;
  };
  EXPECT_NEAR(static_cast<double>(words_in_a_second()), 10.0, 1.0);
  transition(kMotion, milliseconds(600), seconds(4));
  EXPECT_GT(words_in_a_second(), 30U) << "until it is seen that all have begun";
  fly(seconds(1));
  EXPECT_NEAR(static_cast<double>(words_in_a_second()), 10.0, 1.0);
}

TEST_F(AgentTest, FollowsATransitionWithoutAStepAndSettles) {
  rest();
  watch_for_steps();
  transition(kMotion, milliseconds(600), seconds(4));
  fly(seconds(2));
  EXPECT_EQ(status_->state, AgentState::kFlying);
  fly(seconds(4));
  EXPECT_EQ(status_->course.base.number, kMotion);
  EXPECT_TRUE(status_->course.transitions.empty());
  const auto r = reference(kMotion, course_->transitions[0].to.epoch);
  EXPECT_LT((setpoint_->position_w_m - r.position_w_m.value).norm(), 1e-9);
}

TEST_F(AgentTest, AGoHeardAfterItsStartIsMergedNotJumpedTo) {
  rest();
  watch_for_steps();
  transition(kMotion, milliseconds(100), seconds(3));
  fly(seconds(2), false);  // all beacons of two seconds lost
  EXPECT_EQ(status_->state, AgentState::kAlone);
  fly(seconds(8));
  const auto r = reference(kMotion, course_->transitions[0].to.epoch);
  EXPECT_LT((setpoint_->position_w_m - r.position_w_m.value).norm(), 1e-9);
}

TEST_F(AgentTest, ManyLayersTurnedBackAndFrozenAreContinuous) {
  rest();
  watch_for_steps();
  transition(kMotion, milliseconds(200), seconds(5));
  fly(seconds(2));
  transition(kRest, milliseconds(150), seconds(2));
  fly(seconds(1));
  transition(kOther, milliseconds(150), seconds(3));
  fly(milliseconds(700));
  transition(kMotion, milliseconds(-300), seconds(2));
  fly(seconds(6));
  EXPECT_EQ(status_->course.base.number, kMotion);
}

TEST_F(AgentTest, SaysNothingAtTheMomentWhenItsCableWouldGoSlack) {
  // From a force upwards to one downwards, through zero half-way.
  const auto pulls = [](double up_n) {
    mechanics::CarrierSlice slice = mechanics::slices(mechanics::test::polygon_plan(4)).front();
    slice.particular_force_w_n = {0.0, 0.0, up_n};
    slice.incoming = slice.outgoing = {};
    slice.law = mechanics::LengthLaw::fixed(2.0);
    return slice;
  };
  tell(protocol::PlanOffer{1, kTerm, {{kRest, pulls(1.0)}, {kOther, pulls(-1.0)}}});
  course_ = Course{1, {kRest, swarm()}, {}};
  fly(seconds(3));
  transition(kOther, setpoint_->swarm_time + milliseconds(600) - swarm(), seconds(1));
  const SwarmTime middle = course_->transitions.back().start + milliseconds(500);
  bool up = false;
  bool down = false;
  visit_ = [&](const protocol::Setpoint& s) {
    EXPECT_TRUE(s.position_w_m.allFinite() && s.direction_w.allFinite() && std::isfinite(s.winch_length_m));
    EXPECT_GT(std::abs(gyre::seconds(s.swarm_time - middle)), 1e-3);
    (s.swarm_time < middle ? up : down) = true;
  };
  fly(seconds(3));
  EXPECT_TRUE(up && down);
}

TEST_F(AgentTest, FliesOnAloneAndSaysSo) {
  rest();
  transition(kMotion, milliseconds(200), seconds(2));
  fly(seconds(3));
  watch_for_steps();
  const Duration before = status_->clock_uncertainty;
  fly(seconds(20), false);
  EXPECT_EQ(status_->state, AgentState::kAlone);
  EXPECT_GT(status_->clock_uncertainty, before);
  EXPECT_NE(heard_.find("flying on alone"), std::string::npos);
  EXPECT_LT(swarm() - setpoint_->swarm_time, milliseconds(30));
  fly(seconds(1));
  EXPECT_EQ(status_->state, AgentState::kFlying);
  EXPECT_NE(heard_.find("is back"), std::string::npos);
}

TEST_F(AgentTest, ANewTermWithTheSameCourseIsNoStep) {
  rest();
  transition(kMotion, milliseconds(200), seconds(2));
  fly(milliseconds(1200));
  watch_for_steps();
  tell(Beacon{2 * kTerm, 1, swarm(), *course_});
  fly(seconds(2), false);
  EXPECT_EQ(status_->term, 2 * kTerm);
  EXPECT_EQ(status_->course.base.number, kMotion);
  const auto before = agent_->dropped().wrong_term;
  beacon();
  offer({kRest});
  EXPECT_EQ(agent_->dropped().wrong_term, before + 2) << "the former coordinator is not heard any more";
  EXPECT_EQ(status_->term, 2 * kTerm);
}

TEST_F(AgentTest, ANewTermsSwarmTimeMayBeALittleOffAndIsWalkedTo) {
  rest();
  const Duration before = status_->clock_uncertainty;
  const auto nonsense = agent_->dropped().nonsense;
  term_ = 2 * kTerm;
  off_ = milliseconds(2);
  beacon();
  watch_for_steps();
  fly(milliseconds(110), false);
  EXPECT_GT(status_->clock_uncertainty, before + off_);
  fly(seconds(8));
  EXPECT_EQ(agent_->dropped().nonsense, nonsense) << "no exchange was a contradiction";
  const SwarmTime now = swarm() - milliseconds(10);  // of the last tick
  EXPECT_NEAR(gyre::seconds(setpoint_->swarm_time - now), gyre::seconds(off_), 1e-4);
}

TEST_F(AgentTest, WhatWasConfirmedToOneTermIsNotConfirmedToTheNext) {
  rest();
  transition(kMotion, milliseconds(600), seconds(5), Stage::kProposed);
  fly(milliseconds(100));
  ASSERT_EQ(status_->confirmed, 1U);
  course_->transitions.clear();
  tell(Beacon{2 * kTerm, 1, swarm(), *course_});
  fly(milliseconds(200), false);
  EXPECT_EQ(status_->confirmed, 0U);
}

TEST_F(AgentTest, CountsDuplicatesLateOnesAndNonsense) {
  rest();
  const auto before = agent_->dropped();
  const Beacon last{kTerm, sequence_, swarm(), *course_};
  tell(last);
  EXPECT_EQ(agent_->dropped().duplicate, before.duplicate + 1);
  Beacon old = last;
  --old.sequence;
  tell(old);
  EXPECT_EQ(agent_->dropped().late, before.late + 1);
  Beacon ancient = last;
  ancient.sequence += 10;
  ancient.swarm_time -= seconds(2);
  tell(ancient);
  EXPECT_EQ(agent_->dropped().late, before.late + 2);
  Beacon future = last;
  future.sequence += 10;
  future.swarm_time += seconds(2);
  tell(future);
  EXPECT_EQ(agent_->dropped().nonsense, before.nonsense + 1);
  protocol::PlanOffer foreign{2, kTerm, {{kOther, slice(kOther)}}};
  foreign.slices[0].slice.id = 2;
  tell(foreign);
  EXPECT_EQ(agent_->dropped().nonsense, before.nonsense + 2);
  protocol::PlanOffer nan{1, kTerm, {{{kTerm, 9}, slice(kOther)}}};
  nan.slices[0].slice.rate_rad_s = std::numeric_limits<double>::quiet_NaN();
  tell(nan);
  EXPECT_EQ(agent_->dropped().nonsense, before.nonsense + 3);
  protocol::CarrierState state = *vehicle_;
  state.position_w_m.x() = std::numeric_limits<double>::infinity();
  tell(state);
  state = *vehicle_;
  state.carrier = 3;
  tell(state);
  EXPECT_EQ(agent_->dropped().nonsense, before.nonsense + 5);
  tell(TimeReplyArrived{{1, 77, 1, kTerm, now_, swarm(), swarm()}, now_});
  EXPECT_EQ(agent_->dropped().nonsense, before.nonsense + 6) << "a reply to a former life";
}

TEST_F(AgentTest, ALieToldTwiceIsOneLie) {
  rest();
  Outputs out;
  while (!out.time_request) {
    now_ += milliseconds(10);
    out = tell(Tick{});
  }
  protocol::TimeReply lie = reply_to(*out.time_request);
  lie.request_received += seconds(9);
  lie.reply_sent += seconds(9);
  const auto duplicates = agent_->dropped().duplicate;
  for (int i = 0; i < 20; ++i) tell(TimeReplyArrived{lie, now_});
  EXPECT_EQ(agent_->dropped().duplicate, duplicates + 19);
  fly(milliseconds(50));
  EXPECT_LT(std::abs(gyre::seconds(swarm() - setpoint_->swarm_time)), 0.05);
}

TEST_F(AgentTest, RefusesAPlanItsVehicleCannotFlyAndNeverFliesIt) {
  mechanics::Limits weak;
  weak.speed_max_m_s = 1e-3;
  restart(2, weak);
  rest();
  EXPECT_EQ(status_->accepted, std::vector<PlanNumber>{kRest});
  EXPECT_FALSE(status_->refused.none());
  EXPECT_NE(status_->refusal.find("speed"), std::string::npos);
  EXPECT_NE(heard_.find("plan refused"), std::string::npos);
  transition(kMotion, milliseconds(300), seconds(2));
  fly(seconds(4));
  EXPECT_EQ(status_->course.base.number, kRest);
  EXPECT_TRUE(status_->course.transitions.empty());
  EXPECT_LT(setpoint_->velocity_w_m_s.norm(), 1e-12);
}

TEST_F(AgentTest, TellsNoMorePlansThanAMessageTakes) {
  rest();
  for (std::uint64_t round = 0; round < 3; ++round) {
    protocol::PlanOffer offer{1, kTerm, {}};
    for (std::uint64_t i = 0; i < protocol::kMaxPlans; ++i) {
      offer.slices.push_back({{kTerm, 10 + round * protocol::kMaxPlans + i}, slice(kOther)});
    }
    tell(offer);
    EXPECT_LE(status_->accepted.size(), protocol::kMaxPlans);
    EXPECT_LE(held_->slices.size(), protocol::kMaxPlans);
    EXPECT_EQ(status_->accepted.back(), offer.slices.back().number);
  }
  EXPECT_EQ(status_->course.base.number, kRest) << "what is flown is kept";
  fly(milliseconds(100));
  EXPECT_LT(swarm() - setpoint_->swarm_time, milliseconds(20));
}

}  // namespace
}  // namespace gyre::agent
