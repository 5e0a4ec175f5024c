// What a person's command does: once, whenever it is said again; in spite of clocks; and nobody undoes it by himself.

#include <gtest/gtest.h>

#include "common/mechanics/orbit_figures.hpp"
#include "tests/coordinator/swarm_of_agents.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::job;
using test::says;
using test::SwarmOfAgents;

/// Beacons and statuses go nowhere.
void cut(SwarmOfAgents& swarm) {
  swarm.mute = swarm.deaf = {1, 2, 3, 4};
}
void heal(SwarmOfAgents& swarm) {
  swarm.mute.clear();
  swarm.deaf.clear();
}

TEST(Command, IsDoneOnceHoweverOftenItIsSaid) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  for (int i = 0; i < 30; ++i) {
    swarm.tell(protocol::Command{50, CommandKind::kEngage, ""});
    swarm.fly(milliseconds(100));
  }
  EXPECT_GT(swarm.replies.size(), 10U) << "the answer may be lost, too";
  for (const protocol::CommandReply& reply : swarm.replies) {
    EXPECT_EQ(reply.id, 50U);
    EXPECT_TRUE(reply.done) << reply.text;
    EXPECT_EQ(reply.text, swarm.replies.front().text);
  }
  ASSERT_EQ(swarm.coordinator().course().transitions.size(), 1U);
  EXPECT_EQ(swarm.coordinator().course().transitions.front().id, 1U);
}

TEST(Command, ToRestIsDoneWithClocksThatAreTooFarApartForTheMotion) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.change_status = [](protocol::AgentStatus& s) { s.clock_uncertainty = seconds(10); };
  swarm.fly(seconds(1));
  const std::string answer = swarm.command(CommandKind::kRelease);
  EXPECT_TRUE(says(answer, "done")) << answer;
}

TEST(Command, ToRetuneIsRehearsedOverWhatIsStillUnderWay) {
  Job fast = job();
  fast.transition = seconds(20);
  Job slow = fast;
  slow.plan.cycle.rate_rad_s *= 0.5;
  slow.plan.limits.speed_max_m_s = 0.7 * mechanics::orbit_figures(mechanics::slices(fast.plan).front()).speed_m_s.max;
  SwarmOfAgents from_rest(slow);
  from_rest.fly(seconds(1));
  EXPECT_TRUE(says(from_rest.command(CommandKind::kEngage), "done"));
  SwarmOfAgents swarm(fast);
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.fly(seconds(5));
  ASSERT_EQ(swarm.coordinator().course().transitions.size(), 1U);
  const std::string answer = swarm.retune(slow);
  EXPECT_TRUE(says(answer, "it would break a limit")) << answer;
}

TEST(Command, IsNotUndoneByACoordinatorThatHearsNobody) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  swarm.tell(protocol::Command{50, CommandKind::kEngage, ""});
  while (swarm.replies.empty()) swarm.fly(milliseconds(10));
  ASSERT_EQ(swarm.coordinator().course().transitions.size(), 1U);
  const protocol::Transition transition = swarm.coordinator().course().transitions.front();
  // Cut off when it wants to see that all have begun, and later for longer than anybody is waited for.
  while (swarm.beacon->swarm_time < transition.start - milliseconds(300)) swarm.fly(milliseconds(10));
  cut(swarm);
  swarm.fly(milliseconds(900));
  heal(swarm);
  swarm.fly(seconds(3));
  cut(swarm);
  swarm.fly(seconds(4));
  heal(swarm);
  swarm.fly(seconds(3));
  EXPECT_FALSE(says(swarm.news, "turning back")) << swarm.news;
  EXPECT_FALSE(says(swarm.news, "freezing")) << swarm.news;
  const protocol::Course& course = swarm.coordinator().course();
  EXPECT_EQ(course.transitions.empty() ? course.base.number : course.transitions.back().to.number,
            transition.to.number);
}

TEST(Command, ToStopIsNotUndoneByACoordinatorThatIsStartedToEngage) {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  SwarmOfAgents swarm(job(), options);
  swarm.fly(seconds(5));
  ASSERT_TRUE(says(swarm.command(CommandKind::kFreeze), "done"));
  swarm.stop_coordinator();
  swarm.stop_agent(2);  // and with it all that anybody knew of its part of the plan in force
  swarm.fly(seconds(1));
  swarm.start_agent(2);
  swarm.start_coordinator();
  swarm.fly(seconds(10));
  ASSERT_TRUE(says(swarm.news, "going to rest")) << swarm.news;
  swarm.fly(seconds(20));
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
  for (const auto& [id, s] : swarm.setpoints) EXPECT_EQ(s.velocity_w_m_s.norm(), 0.0);
}

}  // namespace
}  // namespace gyre::coordinator
