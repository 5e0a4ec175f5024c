// The conductor with real agents, on virtual time: how a flight begins, goes on, and ends.

#include "coordinator/core/coordinator.hpp"

#include <gtest/gtest.h>

#include "common/mechanics/orbit_figures.hpp"
#include "common/protocol/term.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using protocol::Wisher;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::engaging;
using test::faster;
using test::Flying;
using test::job;
using test::says;
using test::SwarmOfAgents;

TEST(Coordinator, OpensAtOnceWhenAllAgentsAreFresh) {
  SwarmOfAgents swarm(job());
  swarm.fly(milliseconds(300));
  EXPECT_NE(swarm.coordinator().term(), 0U);
  EXPECT_TRUE(says(swarm.news, "the load is held by the motion plan, at rest"));
  EXPECT_TRUE(swarm.rests());
  EXPECT_EQ(swarm.moment().at, PlanTime{});
}

TEST(Coordinator, SaysItsFirstBeaconWithThePlans) {
  SwarmOfAgents swarm(job());
  std::optional<LocalTime> offered, heard;
  swarm.visit = [&] {
    if (!offered && !swarm.statuses.empty() && !swarm.statuses.at(1).accepted.empty()) offered = swarm.now;
    if (!heard && swarm.beacon) heard = swarm.now;
  };
  swarm.fly(milliseconds(300));
  ASSERT_TRUE(offered && heard);
  EXPECT_EQ(*heard, *offered) << "everybody waits for it";
}

TEST(Coordinator, LooksOftenerWhileSomebodyWaitsForHisStartAndSpeaksAsEver) {
  SwarmOfAgents swarm(job());
  const auto until_it_looks = [&] { return swarm.coordinator().step(swarm.now, Tick{}).next_tick - swarm.now; };
  EXPECT_LE(until_it_looks(), milliseconds(5)) << "listening";
  swarm.deaf = {3};
  swarm.fly(seconds(1));
  const std::uint64_t before = swarm.beacon->sequence;
  for (int i = 0; i < 200; ++i, swarm.now += milliseconds(5)) swarm.tell(Tick{});
  EXPECT_NEAR(static_cast<double>(swarm.beacon->sequence - before), 50, 1);
  swarm.fly(milliseconds(200));
  EXPECT_LE(until_it_looks(), milliseconds(5)) << "carrier 3 has no swarm time";
  swarm.deaf.clear();
  swarm.fly(seconds(1));
  EXPECT_GT(until_it_looks(), milliseconds(5));
}

TEST(Coordinator, BeginsAFlightOnlyWithAll) {
  SwarmOfAgents swarm(job());
  swarm.mute = {3};
  swarm.fly(milliseconds(1400));
  EXPECT_EQ(swarm.coordinator().term(), 0U);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(20)), "listening"));
  swarm.fly(seconds(10));
  EXPECT_EQ(swarm.coordinator().term(), 0U) << "the missing one may fly out there, by another swarm time";
  EXPECT_TRUE(says(swarm.news, "waiting for carrier 3"));
  swarm.mute.clear();
  swarm.fly(milliseconds(300));
  EXPECT_NE(swarm.coordinator().term(), 0U);
}

TEST(Coordinator, EngagesReleasesAndEndsAtRest) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  EXPECT_FALSE(swarm.moves());
  swarm.tell(Shutdown{});
  swarm.fly(seconds(5));
  ASSERT_TRUE(swarm.finished);
  EXPECT_TRUE(swarm.finished->clean);
}

TEST(Coordinator, EndsAMotionAtRest) {
  Flying swarm;
  swarm.tell(Shutdown{});
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, {}), "the flight is ending"));
  swarm.fly(seconds(30));
  ASSERT_TRUE(swarm.finished);
  EXPECT_TRUE(swarm.finished->clean);
  EXPECT_FALSE(swarm.moves());
}

TEST(Coordinator, EngagesByItselfWhenAsked) {
  SwarmOfAgents swarm(job(), engaging());
  swarm.fly(seconds(10));
  EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
  EXPECT_EQ(swarm.course().wish.by, Wisher::kStart);
}

TEST(Coordinator, WhatIsNotConfirmedIsGivenUpAndNothingHappened) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  const protocol::Course before = swarm.course();
  swarm.deaf = {2};
  const std::string answer = swarm.command(CommandKind::kEngage, seconds(2));
  EXPECT_TRUE(says(answer, "not confirmed in time by carrier 2")) << answer;
  EXPECT_TRUE(same_motion(swarm.course(), before));
  swarm.deaf.clear();
  swarm.fly(seconds(10));
  EXPECT_FALSE(swarm.moves()) << "who was refused asks again himself";
}

TEST(Coordinator, EngageNeedsAll) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  swarm.stop_agent(4);
  const std::string early = swarm.command(CommandKind::kEngage, seconds(2));
  EXPECT_TRUE(says(early, "refused: ")) << early << ": not yet known to be silent, and confirms nothing";
  const std::string late = swarm.command(CommandKind::kEngage, seconds(2));
  EXPECT_TRUE(says(late, "carrier 4 is silent")) << late;
  EXPECT_TRUE(swarm.rests());
  swarm.start_agent(4);
  swarm.fly(seconds(2));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Coordinator, ARampThatBreaksALimitIsRefusedOrMadeLonger) {
  const double acceleration_m_s2 =
      mechanics::orbit_figures(mechanics::slices(job().plan).front()).acceleration_max_m_s2;
  Job fixed = job();
  fixed.plan.limits.acceleration_max_m_s2 = 1.2 * acceleration_m_s2;
  fixed.transition = milliseconds(500);
  SwarmOfAgents refused(fixed);
  refused.fly(seconds(2));
  const std::string answer = refused.command(CommandKind::kEngage);
  EXPECT_TRUE(says(answer, "it would break a limit: carrier 1: acceleration")) << answer;
  EXPECT_TRUE(refused.rests());

  Job longer = fixed;
  longer.transition.reset();
  CoordinatorOptions hasty;
  hasty.shortest_transition = milliseconds(500);
  SwarmOfAgents swarm(longer, hasty);
  double hardest_m_s2 = 0.0;
  swarm.visit = [&] {
    for (const auto& [id, s] : swarm.setpoints) hardest_m_s2 = std::max(hardest_m_s2, s.acceleration_w_m_s2.norm());
  };
  swarm.fly(seconds(2));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(60)), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_GT(hardest_m_s2, acceleration_m_s2 * 0.9);
  EXPECT_LE(hardest_m_s2, 1.2 * acceleration_m_s2 * 1.001);
}

TEST(Coordinator, WhoDoesNotFollowAStartIsWaitedForByTurningBack) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  // Everybody confirms; carrier 2 never hears the go.
  swarm.visit = [&] {
    if (swarm.statuses[2].confirmed > 0) swarm.deaf = {2};
  };
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(1500)),
                   "refused: carrier 2 does not follow the change that began: turning back"));
  EXPECT_EQ(swarm.course().pace.target(), 0.0);
  EXPECT_LT(swarm.pace(), 0.1) << "it had hardly begun";
  // It was wanted, and still is.
  swarm.visit = nullptr;
  swarm.deaf = {};
  swarm.fly(seconds(20));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Coordinator, ATurnedBackStartIsNotTriedAgainWhenSomebodyReleased) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  swarm.visit = [&] {
    if (swarm.statuses[2].confirmed > 0) swarm.deaf = {2};
  };
  ASSERT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(1500)), "turning back"));
  swarm.visit = nullptr;
  swarm.deaf = {};
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  swarm.fly(seconds(20));
  EXPECT_FALSE(swarm.moves());
}

TEST(Coordinator, ATurnedBackReleaseGoesOnMovingUntilAllCanStop) {
  Flying swarm;
  swarm.visit = [&, before = swarm.statuses[2].confirmed] {
    if (swarm.statuses[2].confirmed > before) swarm.deaf = {2};
  };
  ASSERT_TRUE(says(swarm.command(CommandKind::kRelease, milliseconds(1500)), "turning back"));
  EXPECT_EQ(swarm.course().pace.target(), 1.0);
  swarm.visit = nullptr;
  swarm.deaf = {};
  swarm.fly(seconds(20));
  EXPECT_FALSE(swarm.moves()) << "it was wanted, and still is";
  EXPECT_FALSE(says(swarm.news, "lease")) << swarm.news;
}

TEST(Coordinator, EndsAtRestWithASilentAgentAtTheEndOfTheLease) {
  Flying swarm;
  swarm.stop_agent(2);
  swarm.tell(Shutdown{});
  swarm.fly(seconds(30));
  ASSERT_TRUE(swarm.finished) << swarm.news;
  EXPECT_TRUE(swarm.finished->clean) << swarm.finished->text;
  swarm.setpoints.erase(2);
  EXPECT_FALSE(swarm.moves());
}

TEST(Coordinator, EndsAndSaysSoWhereNobodyCanStopASwarmThatFliesOn) {
  Job flies_on = job();
  flies_on.silence.stop_after.reset();
  Flying swarm(flies_on);
  swarm.stop_agent(2);
  swarm.tell(Shutdown{});
  swarm.fly(seconds(30));
  ASSERT_TRUE(swarm.finished);
  EXPECT_FALSE(swarm.finished->clean);
  EXPECT_TRUE(says(swarm.finished->text, "it flies on")) << swarm.finished->text;
}

TEST(Coordinator, HoldsTheEngageBackWhileClocksMayDisagreeTooMuchAndSaysSo) {
  SwarmOfAgents swarm(job(), engaging());
  swarm.change_status = [](protocol::AgentStatus& s) { s.clock_uncertainty = seconds(10); };
  swarm.fly(seconds(5));
  EXPECT_TRUE(says(swarm.news, "the motion does not begin: the clocks may disagree"));
  EXPECT_TRUE(swarm.rests());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(1)), "clocks may disagree"));
  swarm.change_status = nullptr;
  swarm.fly(seconds(3));
  EXPECT_FALSE(swarm.rests());
}

TEST(Coordinator, StandsDownForAHigherTermAndAnswersWhoWaits) {
  Flying swarm;
  swarm.tell(protocol::Command{99, CommandKind::kRelease, 1.0, {}, ""});
  protocol::Beacon other = *swarm.beacon;
  other.term += 0x10000;
  other.course.term = other.term;
  if (other.proposal) other.proposal->term = other.term;
  swarm.tell(other);
  ASSERT_TRUE(swarm.finished);
  EXPECT_FALSE(swarm.finished->clean);
  EXPECT_TRUE(says(swarm.finished->text, "standing down"));
  ASSERT_FALSE(swarm.replies.empty());
  EXPECT_EQ(swarm.replies.back().id, 99U);
  EXPECT_FALSE(swarm.replies.back().done);
}

TEST(Coordinator, CountsStrangersDuplicatesLateOnesAndNonsense) {
  Flying swarm;
  const auto before = swarm.coordinator().dropped();
  protocol::AgentStatus s = swarm.statuses[1];
  swarm.tell(s);
  EXPECT_EQ(swarm.coordinator().dropped().duplicate, before.duplicate + 1);
  --s.sequence;
  swarm.tell(s);
  EXPECT_EQ(swarm.coordinator().dropped().late, before.late + 1);
  s.carrier = 9;
  swarm.tell(s);
  s.carrier = 1;
  s.clock_drift_ppm = std::numeric_limits<double>::quiet_NaN();
  swarm.tell(s);
  swarm.tell(protocol::HeldPlans{9, 1, {}, {}});
  swarm.tell(TimeRequestArrived{protocol::TimeRequest{9, 1, 1, swarm.now}, swarm.now});
  swarm.tell(TimeRequestArrived{protocol::TimeRequest{1, 1, 1, swarm.now}, swarm.now + seconds(1)});
  EXPECT_EQ(swarm.coordinator().dropped().nonsense, before.nonsense + 5);
  protocol::Beacon former = *swarm.beacon;
  former.term = 1;
  former.course.term = 1;
  swarm.tell(former);
  EXPECT_EQ(swarm.coordinator().dropped().wrong_term, before.wrong_term + 1);
}

TEST(Coordinator, AStallIsNotMadeUpFor) {
  Flying swarm;
  const std::uint64_t before = swarm.beacon->sequence;
  swarm.now += seconds(2);
  for (int i = 0; i < 50; ++i) swarm.tell(Tick{});
  EXPECT_EQ(swarm.beacon->sequence, before + 1);
}

}  // namespace
}  // namespace gyre::coordinator
