// What an agent does with what it is told.

#include <gtest/gtest.h>

#include "common/mechanics/orbit_figures.hpp"
#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

TEST_F(AgentTest, SendsNoSetpointWithoutSwarmTime) {
  offer({kMotion});
  course(kMotion);
  fly(seconds(2), false);
  beacon();
  EXPECT_FALSE(setpoint_);
  EXPECT_EQ(status_->state, AgentState::kWaiting);
}

TEST_F(AgentTest, SendsNoSetpointWithoutThePlan) {
  offer({kOther});
  course(kMotion);
  fly(seconds(2));
  EXPECT_FALSE(setpoint_);
  EXPECT_EQ(status_->state, AgentState::kWaiting);
  EXPECT_TRUE(status_->course.base.number.none()) << "flies a course it does not hold";
}

TEST_F(AgentTest, RestsAtTheBeginningOfItsPlanAndCompensatesStretch) {
  rest();
  EXPECT_EQ(status_->state, AgentState::kReady);
  const auto r = mechanics::evaluate(slice(kMotion), 0.0);
  EXPECT_LT((setpoint_->position_w_m - r.position_w_m.value).norm(), 1e-9);
  EXPECT_EQ(setpoint_->velocity_w_m_s.norm(), 0.0);
  EXPECT_EQ(setpoint_->acceleration_w_m_s2.norm(), 0.0);
  EXPECT_EQ(setpoint_->winch_rate_m_s, 0.0);
  EXPECT_NEAR(setpoint_->cable_length_m, r.length_m.value, 1e-9);
  const double k = slice(kMotion).cable_stiffness_n_m;
  EXPECT_NEAR(setpoint_->winch_length_m, r.length_m.value - (k > 0.0 ? r.tension_n.value / k : 0.0), 1e-9);
  EXPECT_LT(std::abs(gyre::seconds(status_->swarm_time.time_since_epoch() - now_.time_since_epoch() - kOffset)), 0.2);
}

TEST_F(AgentTest, FliesItsPlanAtAnyPaceByTheChainRule) {
  rest();
  vehicle_.reset();
  watch_for_steps();
  const auto values_and_rates_belong_together = visit_;
  double slowest = 1.0, fastest = 0.0, hardest_1_s = 0.0;
  visit_ = [&](const protocol::Setpoint& s) {
    values_and_rates_belong_together(s);
    // p = P(tau), v = pace P', a = pace² P'' + pace' P'; the winch as the carrier.
    const protocol::PlanMoment moment = course_->moment(s.swarm_time);
    const mechanics::Reference r = mechanics::evaluate(slice(kMotion), gyre::seconds(moment.at.time_since_epoch()));
    const double pace = moment.pace;
    EXPECT_LT((s.position_w_m - r.position_w_m.value).norm(), 1e-8);
    EXPECT_LT((s.velocity_w_m_s - pace * r.position_w_m.first).norm(), 1e-8);
    EXPECT_LT(
        (s.acceleration_w_m_s2 - pace * pace * r.position_w_m.second - moment.rate_1_s * r.position_w_m.first).norm(),
        1e-8);
    const double k = slice(kMotion).cable_stiffness_n_m;
    const auto winch = r.length_m - (k > 0.0 ? 1.0 / k : 0.0) * r.tension_n;
    EXPECT_NEAR(s.winch_length_m, winch.value, 1e-8);
    EXPECT_NEAR(s.winch_rate_m_s, pace * winch.first, 1e-8);
    EXPECT_NEAR(s.winch_acceleration_m_s2, pace * pace * winch.second + moment.rate_1_s * winch.first, 1e-8);
    slowest = std::min(slowest, pace), fastest = std::max(fastest, pace);
    hardest_1_s = std::max(hardest_1_s, std::abs(moment.rate_1_s));
  };
  for (const double pace : {1.0, 0.3, 0.7, 0.0}) {
    ramp(milliseconds(200), seconds(2), pace);
    fly(seconds(3));
    EXPECT_EQ(status_->state, pace > 0.0 ? AgentState::kFlying : AgentState::kReady);
  }
  EXPECT_EQ(slowest, 0.0);
  EXPECT_EQ(fastest, 1.0);
  EXPECT_GT(hardest_1_s, 0.5);
}

TEST_F(AgentTest, SaysWhatItHoldsAndAccepts) {
  rest();
  EXPECT_EQ(status_->accepted, (std::vector<PlanNumber>{kMotion, kOther}));
  ASSERT_EQ(held_->slices.size(), 2U);
  EXPECT_TRUE(held_->slices[1].slice == slice(kOther));
}

TEST_F(AgentTest, ConfirmsWhatItHoldsAndFliesNoProposal) {
  rest();
  proposal_ = with_transition({kTerm, 99}, milliseconds(600), seconds(5));
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, 0U) << "a plan it does not hold";
  proposal_ = with_transition(kOther, milliseconds(600), seconds(5));
  ++proposal_->term;
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, 0U) << "another coordinator's";
  proposal_ = *course_;
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, 0U) << "what is flown already";
  proposal_ = with_ramp(milliseconds(600), seconds(2), 1.0);
  const Outputs out = beacon();
  ASSERT_TRUE(out.status) << "its word is waited for";
  EXPECT_EQ(out.status->confirmed, proposal_->revision);
  ++proposal_->revision;
  fly(milliseconds(30));
  EXPECT_EQ(status_->confirmed, proposal_->revision) << "the newest";
  fly(seconds(5));
  EXPECT_EQ(status_->state, AgentState::kReady);
  EXPECT_EQ(status_->course.revision, course_->revision);
}

TEST_F(AgentTest, ConfirmsNoRampThatItsVehicleCannotFly) {
  // The plan itself is well within what the vehicle can do.
  const mechanics::CarrierFigures figures = mechanics::orbit_figures(slice(kMotion));
  mechanics::Limits vehicle;
  vehicle.acceleration_max_m_s2 = 1.5 * figures.acceleration_max_m_s2;
  restart(2, vehicle);
  rest();
  ASSERT_EQ(status_->accepted.front(), kMotion);
  proposal_ = with_ramp(milliseconds(600), milliseconds(300), 1.0);
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, 0U);
  const std::uint64_t refused = proposal_->revision;
  proposal_ = with_ramp(milliseconds(600), seconds(10), 1.0);
  proposal_->revision = refused + 1;
  fly(milliseconds(300));
  EXPECT_EQ(status_->confirmed, refused + 1);
}

TEST_F(AgentTest, SpeaksFourTimesAsOftenWhileItsWordIsWaitedFor) {
  rest();
  const auto words_in_a_second = [this] {
    const std::uint64_t before = status_->sequence;
    fly(seconds(1));
    return status_->sequence - before;
  };
  EXPECT_NEAR(static_cast<double>(words_in_a_second()), 10.0, 1.0);
  ramp(milliseconds(600), seconds(4), 1.0);
  EXPECT_GT(words_in_a_second(), 30U) << "until it is seen that all have begun";
  fly(seconds(1));
  EXPECT_NEAR(static_cast<double>(words_in_a_second()), 10.0, 1.0);
}

TEST_F(AgentTest, FollowsATransitionWithoutAStepAndSettles) {
  engage();
  watch_for_steps();
  transition(kOther, milliseconds(600), seconds(4));
  fly(seconds(2));
  EXPECT_EQ(status_->state, AgentState::kFlying);
  ASSERT_EQ(status_->course.transitions.size(), 1U);
  fly(seconds(4));
  EXPECT_EQ(status_->course.base.number, kOther);
  EXPECT_TRUE(status_->course.transitions.empty());
  EXPECT_LT(off_the_plan_m(), 1e-9);
}

TEST_F(AgentTest, ATransitionWaitsWhereThePhaseRests) {
  engage();
  watch_for_steps();
  transition(kOther, milliseconds(200), seconds(2));
  ramp(milliseconds(300), seconds(1), 0.0);
  fly(seconds(20));
  ASSERT_EQ(status_->course.transitions.size(), 1U) << "it runs on plan time, which stands";
  EXPECT_EQ(status_->state, AgentState::kReady);
  EXPECT_EQ(setpoint_->velocity_w_m_s.norm(), 0.0);
  ramp(milliseconds(200), seconds(1), 1.0);
  fly(seconds(5));
  EXPECT_EQ(status_->course.base.number, kOther);
  EXPECT_LT(off_the_plan_m(), 1e-9);
}

TEST_F(AgentTest, AGoHeardAfterItsStartIsMergedNotJumpedTo) {
  rest();
  vehicle_.reset();
  watch_for_steps();
  ramp(milliseconds(100), seconds(3), 1.0);
  fly(seconds(2), false);  // all beacons of two seconds lost
  EXPECT_EQ(status_->state, AgentState::kAlone);
  EXPECT_EQ(setpoint_->velocity_w_m_s.norm(), 0.0);
  fly(seconds(10));
  EXPECT_LT(off_the_plan_m(), 1e-9);
}

TEST_F(AgentTest, ManyLayersTurnedBackAndFrozenAreContinuous) {
  engage();
  watch_for_steps();
  transition(kOther, milliseconds(200), seconds(5));
  fly(seconds(2));
  transition(kMotion, milliseconds(150), seconds(2));
  fly(seconds(1));
  ramp(milliseconds(150), seconds(1), 0.0);
  fly(milliseconds(700));
  transition(kOther, milliseconds(150), seconds(3));
  ramp(milliseconds(200), seconds(1), 1.0);
  fly(milliseconds(700));
  ramp(milliseconds(-300), seconds(2), 0.5);
  transition(kMotion, milliseconds(-300), seconds(2));
  fly(seconds(12));
  EXPECT_EQ(status_->course.base.number, kMotion);
  EXPECT_LT(off_the_plan_m(), 1e-9);
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
  protocol::PlanOffer both = plans({});
  both.slices = {{kMotion, pulls(1.0)}, {kOther, pulls(-1.0)}};
  tell(both);
  course(kMotion, 1.0);
  fly(seconds(3));
  transition(kOther, setpoint_->swarm_time + milliseconds(600) - swarm(), seconds(1));
  const SwarmTime middle = setpoint_->swarm_time + milliseconds(1100);
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
  engage();
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
  engage();
  transition(kOther, milliseconds(200), seconds(2));
  fly(milliseconds(1200));
  watch_for_steps();
  Course taken_over = next();
  taken_over.term = 2 * kTerm;
  tell(Beacon{2 * kTerm, 1, swarm(), taken_over, {}, {}});
  fly(seconds(2), false);
  EXPECT_EQ(status_->term, 2 * kTerm);
  EXPECT_EQ(status_->course.term, 2 * kTerm);
  EXPECT_EQ(status_->course.base.number, kOther);
  EXPECT_LT(off_the_plan_m(), 1e-9);
  const auto before = agent_->dropped().wrong_term;
  beacon();
  offer({kMotion});
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
  proposal_ = with_ramp(milliseconds(600), seconds(5), 1.0);
  fly(milliseconds(100));
  ASSERT_EQ(status_->confirmed, proposal_->revision);
  course_->term = 2 * kTerm;
  tell(Beacon{2 * kTerm, 1, swarm(), *course_, {}, {}});
  fly(milliseconds(200), false);
  EXPECT_EQ(status_->confirmed, 0U);
}

TEST_F(AgentTest, CountsDuplicatesLateOnesAndNonsense) {
  rest();
  const auto before = agent_->dropped();
  const Beacon last{kTerm, sequence_, swarm(), *course_, {}, {}};
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
  protocol::PlanOffer foreign = plans({kOther});
  foreign.carrier = 2;
  foreign.slices[0].slice.id = 2;
  tell(foreign);
  EXPECT_EQ(agent_->dropped().nonsense, before.nonsense + 2);
  protocol::PlanOffer nan = plans({kOther});
  nan.slices[0].number = {kTerm, 9};
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
  tell(TimeReplyArrived{{1, 77, 1, kTerm, now_, swarm(), swarm(), 0, {}}, now_});
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
  weak.speed_max_m_s = 1.1 * mechanics::orbit_figures(slice(kMotion)).speed_m_s.max;
  restart(2, weak);
  rest();
  EXPECT_EQ(status_->accepted, std::vector<PlanNumber>{kMotion});
  EXPECT_EQ(status_->refused, kOther);
  EXPECT_NE(status_->refusal.find("speed"), std::string::npos);
  EXPECT_NE(heard_.find("plan refused"), std::string::npos);
  proposal_ = with_transition(kOther, milliseconds(300), seconds(2));
  fly(milliseconds(100));
  EXPECT_EQ(status_->confirmed, 0U);
  proposal_.reset();
  transition(kOther, milliseconds(300), seconds(2));
  ramp(milliseconds(300), seconds(2), 1.0);
  fly(seconds(5));
  EXPECT_EQ(status_->course.base.number, kMotion);
  EXPECT_TRUE(status_->course.transitions.empty());
  EXPECT_LT(setpoint_->velocity_w_m_s.norm(), 1e-12);
}

TEST_F(AgentTest, TellsNoMorePlansThanAMessageTakes) {
  rest();
  for (std::uint64_t round = 0; round < 3; ++round) {
    protocol::PlanOffer offer = plans({});
    for (std::uint64_t i = 0; i < protocol::kMaxPlans; ++i) {
      offer.slices.push_back({{kTerm, 10 + round * protocol::kMaxPlans + i}, slice(kOther)});
    }
    tell(offer);
    EXPECT_LE(status_->accepted.size(), protocol::kMaxPlans);
    EXPECT_LE(held_->slices.size(), protocol::kMaxPlans);
    EXPECT_EQ(status_->accepted.back(), offer.slices.back().number);
  }
  EXPECT_EQ(status_->course.base.number, kMotion) << "what is flown is kept";
  fly(milliseconds(100));
  EXPECT_LT(swarm() - setpoint_->swarm_time, milliseconds(20));
}

}  // namespace
}  // namespace gyre::agent
