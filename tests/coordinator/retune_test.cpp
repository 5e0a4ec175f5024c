// Going over to another motion of the same load, in flight and at rest.

#include "coordinator/core/coordinator.hpp"

#include <gtest/gtest.h>

#include "common/mechanics/orbit_figures.hpp"
#include "common/mechanics/skew.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::engaging;
using test::faster;
using test::Flying;
using test::job;
using test::says;
using test::SwarmOfAgents;

TEST(Retune, InMotionGoesOverAndMovesOn) {
  Flying swarm;
  const protocol::PlanNumber before = swarm.course().base.number;
  EXPECT_TRUE(says(swarm.retune(faster()), "done"));
  swarm.fly_until([&] { return swarm.course().transitions.empty(); });
  EXPECT_NE(swarm.course().base.number, before);
  EXPECT_EQ(swarm.pace(), 1.0);
  swarm.fly(seconds(10));
  EXPECT_EQ(swarm.pace(), 1.0) << "it was in motion, and stays so";
}

TEST(Retune, AtRestMovesThroughTheChangeAndRestsAgain) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  const protocol::PlanNumber before = swarm.course().base.number;
  EXPECT_TRUE(says(swarm.retune(faster(), seconds(3)), "done"));
  EXPECT_TRUE(swarm.moves());
  swarm.fly(seconds(30));
  EXPECT_NE(swarm.course().base.number, before);
  EXPECT_TRUE(swarm.course().transitions.empty());
  EXPECT_TRUE(swarm.rests());
  EXPECT_FALSE(swarm.moves());
  EXPECT_EQ(swarm.course().wish.pace, 0.0);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Retune, AtRestIsFollowedByMotionWhereSomebodyEngagesMeanwhile) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  EXPECT_TRUE(says(swarm.retune(faster(), seconds(8)), "done"));
  ASSERT_EQ(swarm.pace(), 1.0);
  ASSERT_FALSE(swarm.course().transitions.empty());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(200)), "done"))
      << "it was to rest when it is changed";
  swarm.fly(seconds(30));
  EXPECT_TRUE(swarm.course().transitions.empty());
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Retune, ToAMotionInWhichASwingGrowsAtThisPaceIsRefused) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.pace(0.7), "done"));
  EXPECT_TRUE(says(swarm.retune(test::swinging(faster())), "cannot retune: at 0.7 of full pace a swing of the load"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_TRUE(says(swarm.retune(test::swinging(faster())), "done"));
  swarm.fly_until([&] { return swarm.course().transitions.empty(); });
  EXPECT_TRUE(says(swarm.pace(0.7, {}), "refused: at 0.7 of full pace")) << "it is what is flown now";
}

TEST(Retune, ThatIsGivenUpLeavesTheMission) {
  CoordinatorOptions options;
  options.status_period = options.beacon_period;
  Flying swarm(job(), options);
  const protocol::PlanNumber plan = swarm.status->plan;
  EXPECT_EQ(plan, swarm.course().base.number);
  swarm.visit = [&] { EXPECT_EQ(swarm.status->plan, plan) << "until it is agreed"; };
  swarm.deaf = {1};
  EXPECT_TRUE(says(swarm.retune(faster(), seconds(3)), "given up"));
  swarm.deaf.clear();
  swarm.fly(seconds(1));
  EXPECT_EQ(swarm.status->mission, "polygon");
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "already in full motion"));
  swarm.visit = nullptr;
  EXPECT_TRUE(says(swarm.retune(faster()), "done"));
  EXPECT_EQ(swarm.status->mission, "faster");
  EXPECT_NE(swarm.status->plan, plan);
  EXPECT_EQ(swarm.status->plan, swarm.course().base.number);
}

TEST(Retune, AsksMoreOfTheClocksThanEitherPlanDoes) {
  Flying swarm;
  const auto budget_s = [](const mechanics::Plan& plan) {
    return mechanics::skew_budget_s(mechanics::slices(plan), plan.load.mass_kg * plan.gravity_m_s2);
  };
  const double least_s = std::min(budget_s(job().plan), budget_s(faster().plan));
  const auto uncertain_by = [&swarm](double uncertainty_s) {
    swarm.change_status = [=](protocol::AgentStatus& s) { s.clock_uncertainty = from_seconds(uncertainty_s); };
    swarm.fly(seconds(1));
  };
  uncertain_by(0.49 * least_s);  // two of them are within the budget of either
  EXPECT_EQ(swarm.coordinator().complaint(swarm.now).value_or("none"), "none");
  const std::string answer = swarm.retune(faster());
  EXPECT_TRUE(says(answer, "given up: the clocks may disagree by")) << answer;
  EXPECT_EQ(swarm.status->mission, "polygon");
  uncertain_by(0.01 * least_s);
  EXPECT_TRUE(says(swarm.retune(faster()), "done"));
}

TEST(Retune, ThatAnAgentRefusesIsAnsweredWithItsWords) {
  Job mission = job();
  SwarmOfAgents swarm(mission);
  mechanics::Limits weak;
  weak.speed_max_m_s = 1.1 * mechanics::orbit_figures(mechanics::slices(mission.plan).front()).speed_m_s.max;
  swarm.start_agent(3, weak);
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  const std::string answer = swarm.retune(faster());
  EXPECT_TRUE(says(answer, "given up: refused: ") && says(answer, "speed")) << answer;
  EXPECT_EQ(swarm.status->mission, "polygon");
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done")) << "the plan in force is nobody's to refuse";
}

TEST(Retune, ThatIsTurnedBackRestoresTheMission) {
  for (const bool moves : {true, false}) {
    SwarmOfAgents swarm(job());
    swarm.fly(seconds(1));
    if (moves) {
      EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
    }
    const protocol::PlanNumber before = swarm.course().base.number;
    swarm.visit = [&, confirmed = swarm.statuses[2].confirmed] {
      if (swarm.statuses[2].confirmed > confirmed) swarm.deaf = {2};
    };
    ASSERT_TRUE(says(swarm.retune(faster(), milliseconds(1800)), "turning back"));
    swarm.visit = nullptr;
    swarm.deaf = {};
    swarm.fly(seconds(40));
    EXPECT_EQ(swarm.course().base.number, before);
    EXPECT_TRUE(swarm.course().transitions.empty());
    EXPECT_EQ(swarm.status->mission, "polygon");
    EXPECT_EQ(swarm.status->plan, before);
    EXPECT_EQ(swarm.pace(), moves ? 1.0 : 0.0);
    EXPECT_TRUE(says(swarm.retune(faster()), "done"));
  }
}

TEST(Retune, ThatNobodyWasSeenToFollowIsTheMissionOnceTheLeaseHasEnded) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.retune(faster(), milliseconds(400)), "done"));
  swarm.mute = swarm.deaf = {1, 2, 3, 4};
  swarm.fly(seconds(12));
  ASSERT_TRUE(swarm.rests());
  swarm.mute.clear();
  swarm.deaf.clear();
  swarm.fly(seconds(2));
  EXPECT_EQ(swarm.status->mission, "faster");
  EXPECT_EQ(swarm.status->plan, protocol::plans_of(swarm.course()).back());
}

TEST(Retune, IsRefusedWhereTooManyAreUnderWayWhichKeepsNobodyFromEngaging) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  // Each is stopped where it has hardly begun: transitions run on plan time.
  std::string answer;
  for (int i = 0; i < 6 && !says(answer, "refused"); ++i) {
    answer = swarm.retune(i % 2 == 0 ? faster() : job(), milliseconds(1500));
    if (says(answer, "done")) {
      EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, seconds(4)), "done"));
    }
  }
  EXPECT_TRUE(says(answer, "cannot retune: too many transitions are under way")) << answer;
  ASSERT_TRUE(swarm.rests());
  ASSERT_EQ(swarm.course().transitions.size(), 3U);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(20)), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_TRUE(swarm.course().transitions.empty());
  EXPECT_TRUE(says(swarm.retune(faster()), "done"));
}

TEST(Retune, OfAnotherLoadIsRefusedInWords) {
  Flying swarm;
  const protocol::Course before = swarm.course();
  Job other = job();
  other.plan.load.mass_kg *= 2.0;
  EXPECT_TRUE(says(swarm.retune(other), "the load weighs 39.2"));
  other = job();
  other.plan.carriers[1].attachment_b_m.x() += 0.1;
  EXPECT_TRUE(says(swarm.retune(other), "carrier 2 is attached elsewhere"));
  other = job();
  other.plan.cable.stiffness_n_m *= 2.0;
  EXPECT_TRUE(says(swarm.retune(other), "stiffness"));
  other = job();
  other.plan.carriers.pop_back();
  EXPECT_TRUE(says(swarm.retune(other), "it has 3 carriers, 4 are flying"));
  EXPECT_EQ(swarm.course().revision, before.revision);
}

TEST(Retune, ToAnotherSilenceHoldsFromItsStartOnAndNotWhileItIsAgreed) {
  Flying swarm;
  Job flies_on = faster();
  flies_on.silence.stop_after.reset();
  swarm.deaf = {1};
  swarm.visit = [&] { EXPECT_TRUE(swarm.course().lease); };
  EXPECT_TRUE(says(swarm.retune(flies_on, seconds(3)), "given up"));
  swarm.deaf.clear();
  swarm.fly(seconds(1));
  swarm.visit = nullptr;
  EXPECT_TRUE(says(swarm.retune(flies_on), "done"));
  EXPECT_FALSE(swarm.course().lease);
}

}  // namespace
}  // namespace gyre::coordinator
