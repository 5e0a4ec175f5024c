// A coordinator that begins where another one ended: what it learns, what it keeps, and what it refuses.

#include "coordinator/core/coordinator.hpp"

#include <gtest/gtest.h>

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

TEST(Takeover, GoesOnAndTheFlightDoesNotNotice) {
  for (const int after_ms : {0, 700, 1200, 3000, 20'000}) {  // before, while and after a change of pace
    for (const bool retunes : {false, true}) {
      Flying swarm;
      (void)(retunes ? swarm.retune(faster(), milliseconds(after_ms))
                     : swarm.command(CommandKind::kRelease, milliseconds(after_ms)));
      const protocol::CoordinatorStatus told = *swarm.status;
      const protocol::Course before = swarm.course();
      const std::uint64_t term = swarm.coordinator().term();
      const Duration offset = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
      swarm.stop_coordinator();
      swarm.fly(seconds(2));
      swarm.visit = [&, last = swarm.setpoints]() mutable {
        for (const auto& [id, s] : swarm.setpoints) {
          const double dt = gyre::seconds(s.swarm_time - last[id].swarm_time);
          EXPECT_LT((s.position_w_m - last[id].position_w_m - dt * s.velocity_w_m_s).norm(), 1e-3);
          last[id] = s;
        }
      };
      swarm.start_coordinator();
      swarm.fly(seconds(2));
      EXPECT_GT(protocol::generation(swarm.coordinator().term()), protocol::generation(term));
      EXPECT_TRUE(says(swarm.news, "took over a swarm that flies"));
      // Proposals are dropped: nobody may have been told to go.
      protocol::Course expected = before;
      (void)protocol::settle(expected, swarm.beacon->swarm_time);
      EXPECT_TRUE(swarm.course().base == expected.base) << after_ms;
      EXPECT_TRUE(swarm.course().transitions == expected.transitions) << after_ms;
      EXPECT_TRUE(swarm.course().wish == expected.wish) << after_ms;
      EXPECT_EQ(swarm.pace(), expected.pace.at(swarm.beacon->swarm_time).pace) << after_ms;
      EXPECT_GT(swarm.course().revision, before.revision);
      const Duration now = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
      EXPECT_LT(std::abs(gyre::seconds(now - offset)), 0.011 + 1e-3);  // a beacon is up to two steps of the rig old
      swarm.expect_one_phase(seconds(10));
      // The plans are known again by what they are.
      EXPECT_EQ(swarm.status->term, swarm.coordinator().term());
      if (!retunes) {
        EXPECT_EQ(swarm.status->plan, told.plan);
      }
      EXPECT_FALSE(says(swarm.news, "lease")) << "in time";
    }
  }
}

// The first words are those that were said before it came, and what waits while it hangs is older still.
TEST(Takeover, WhoHungWhileItListenedListensAnew) {
  for (const Duration hung : {Duration(milliseconds(400)), Duration(seconds(2))}) {
    Flying swarm;
    const Duration offset = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
    swarm.stop_coordinator();
    swarm.fly(milliseconds(90));
    swarm.start_coordinator();
    swarm.tell(Tick{});
    swarm.now += hung;
    swarm.tell(Tick{});
    EXPECT_EQ(swarm.coordinator().term(), 0) << "by what was said before";
    swarm.fly(milliseconds(600));
    ASSERT_NE(swarm.coordinator().term(), 0);
    const Duration now = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
    EXPECT_LT(std::abs(gyre::seconds(now - offset)), 0.011 + 1e-3);
  }
}

// Until the next beat of the one that learns.
TEST(Takeover, LearnsTimeByWhenStatusesArrivedAndNotByWhenTheyAreHeard) {
  for (const bool another : {true, false}) {
    Flying swarm;
    swarm.statuses_wait = milliseconds(40);
    const Duration offset = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
    if (another) {
      swarm.stop_coordinator();
      swarm.fly(milliseconds(90));
      swarm.start_coordinator();
    } else {
      swarm.leapt = seconds(2);
    }
    swarm.fly(seconds(2));
    if (!another) {
      EXPECT_TRUE(says(swarm.news, "this clock jumped by 2.000 s")) << swarm.news;
    }
    const Duration now = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
    EXPECT_LT(std::abs(gyre::seconds(now - offset)), 0.011 + 1e-3) << another;
  }
}

TEST(Takeover, LetsTheMissionThatIsFlownBeTheMission) {
  Flying swarm;
  const Job mission = faster();
  EXPECT_TRUE(says(swarm.retune(mission), "done"));
  swarm.fly_until([&] { return swarm.course().transitions.empty(); });
  const protocol::PlanNumber flown = swarm.course().base.number;
  swarm.stop_coordinator();
  swarm.fly(seconds(1));
  swarm.start_coordinator(mission, {});
  swarm.fly(seconds(2));
  EXPECT_EQ(swarm.status->plan, flown);
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Takeover, OfAnotherLoadIsRefusedInWords) {
  const auto taken_over_by = [](const Job& mission) {
    Flying swarm;
    swarm.stop_coordinator();
    swarm.fly(milliseconds(500));
    swarm.start_coordinator(mission, {});
    swarm.fly(seconds(3));
    if (swarm.finished) {
      EXPECT_FALSE(swarm.finished->clean);
    }
    return swarm.finished ? swarm.finished->text : "leads";
  };
  EXPECT_EQ(taken_over_by(job()), "leads");
  Job other = job();
  other.plan.load.mass_kg *= 1.001;
  EXPECT_TRUE(says(taken_over_by(other), "a swarm with another load flies here: carrier 1 holds "));
  other = job();
  other.plan.carriers[2].attachment_b_m.y() += 0.01;
  EXPECT_TRUE(says(taken_over_by(other), "a swarm with another load flies here: carrier "));
  other = job();
  other.plan.cable.stiffness_n_m *= 1.1;
  EXPECT_TRUE(says(taken_over_by(other), "cables of another stiffness"));
  // The same mission, worked out on another machine.
  Job rounded = job();
  rounded.plan.load.mass_kg *= 1.0 + 1e-15;
  rounded.plan.cable.stiffness_n_m *= 1.0 - 1e-15;
  for (auto& carrier : rounded.plan.carriers) carrier.attachment_b_m *= 1.0 + 1e-15;
  EXPECT_EQ(taken_over_by(rounded), "leads");
  EXPECT_EQ(taken_over_by(faster()), "leads") << "another motion of the same load";
}

TEST(Takeover, KeepsTheWishWhateverTheCoordinatorIsStartedWith) {
  Flying swarm(job(), engaging());
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  ASSERT_TRUE(swarm.rests());
  swarm.stop_coordinator();
  swarm.fly(seconds(30));
  swarm.start_coordinator();
  swarm.fly(seconds(20));
  EXPECT_TRUE(swarm.rests()) << swarm.news;
  EXPECT_EQ(swarm.course().wish.by, Wisher::kPerson);
  EXPECT_FALSE(swarm.moves());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Takeover, OfASwarmThatWasNeverToldAnythingEngagesIt) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  swarm.stop_coordinator();
  swarm.fly(seconds(30));
  swarm.start_coordinator(job(), engaging());
  swarm.fly(seconds(20));
  EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
}

/// In the plan of a retune, at the end of which a coordinator begins with the mission before it, and these agents anew.
void begin_anew(Flying& swarm, const std::vector<CarrierId>& agents, bool moves) {
  EXPECT_TRUE(says(swarm.retune(faster()), "done"));
  if (!moves) {
    EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze), "done"));
  }
  swarm.stop_coordinator();
  for (const CarrierId agent : agents) swarm.stop_agent(agent);
  swarm.fly(seconds(1));
  for (const CarrierId agent : agents) swarm.start_agent(agent);
}

TEST(Takeover, LearnsAPlanThatAnAgentForgotFromItsNeighbour) {
  for (const CarrierId agent : {1U, 2U, 4U}) {
    Flying swarm(job(), engaging());
    begin_anew(swarm, {agent}, true);
    swarm.start_coordinator();
    swarm.fly(seconds(20));
    EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
    EXPECT_FALSE(says(swarm.news, "nobody knows")) << swarm.news;
    EXPECT_TRUE(says(swarm.news, "by the former plan")) << swarm.news;
    swarm.expect_one_phase(seconds(1));
  }
}

TEST(Takeover, WithAPartOfThePlanInForceThatNobodyKnowsGoesOverToTheMissionsAndRests) {
  Flying swarm(job(), engaging());
  begin_anew(swarm, {1, 2}, true);  // and with both, all that anybody knew of the second one's part
  swarm.nobody_knows = {2};
  swarm.start_coordinator();
  swarm.fly(seconds(8));
  ASSERT_TRUE(says(swarm.news, "nobody knows the plan in force for carrier 2")) << swarm.news;
  swarm.fly(seconds(40));
  EXPECT_TRUE(swarm.course().transitions.empty());
  EXPECT_EQ(swarm.course().base.number, swarm.status->plan);
  EXPECT_TRUE(swarm.rests()) << swarm.news;
  EXPECT_FALSE(swarm.moves());
  swarm.expect_one_phase(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
}

TEST(Takeover, AtRestWithAPartOfThePlanInForceThatNobodyKnowsWaitsForAPerson) {
  Flying swarm(job(), engaging());
  begin_anew(swarm, {1, 2}, false);
  swarm.nobody_knows = {2};
  swarm.start_coordinator();
  swarm.fly(seconds(30));
  EXPECT_TRUE(swarm.rests()) << swarm.news;
  EXPECT_TRUE(says(swarm.coordinator().complaint(swarm.now).value_or(""), "engage, and all go over")) << swarm.news;
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.fly(seconds(30));
  EXPECT_EQ(swarm.course().base.number, swarm.status->plan);
  EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
  swarm.expect_one_phase(seconds(1));
}

}  // namespace
}  // namespace gyre::coordinator
