// Whoever joins a flight is told its mission as a text: once for each that comes into force, and only then.

#include <gtest/gtest.h>

#include "coordinator/core/coordinator.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using std::chrono::seconds;
using test::Flying;
using test::says;
using test::SwarmOfAgents;

Job told(Job job, const std::string& text) {
  job.mission_text = text;
  return job;
}
Job polygon() {
  return told(test::job(), "the polygon");
}
Job faster() {
  return told(test::faster(), "the faster one");
}

TEST(MissionText, IsToldOnceWithItsPlan) {
  SwarmOfAgents swarm(polygon());
  swarm.fly(seconds(20));
  ASSERT_EQ(swarm.missions.size(), 1U);
  EXPECT_EQ(swarm.missions[0].text, "the polygon");
  EXPECT_EQ(swarm.missions[0].plan, swarm.status->plan);
  EXPECT_EQ(swarm.missions[0].term, swarm.beacon->term);
}

TEST(MissionText, IsToldAgainWhenARetuneIsAgreed) {
  Flying swarm(polygon());
  EXPECT_TRUE(says(swarm.retune(faster()), "done"));
  swarm.fly(seconds(1));
  ASSERT_EQ(swarm.missions.size(), 2U);
  EXPECT_EQ(swarm.missions[1].text, "the faster one");
  EXPECT_EQ(swarm.missions[1].plan, swarm.status->plan);
  EXPECT_NE(swarm.missions[1].plan, swarm.missions[0].plan);
  swarm.fly(seconds(60));
  EXPECT_EQ(swarm.missions.size(), 2U) << "that the change is over is nothing new";
}

TEST(MissionText, IsNotToldOfARetuneThatIsGivenUp) {
  CoordinatorOptions options;
  options.status_period = options.beacon_period;
  Flying swarm(polygon(), options);
  swarm.deaf = {1};
  EXPECT_TRUE(says(swarm.retune(faster(), seconds(3)), "given up"));
  swarm.deaf.clear();
  swarm.fly(seconds(10));
  ASSERT_EQ(swarm.missions.size(), 1U);
  EXPECT_EQ(swarm.missions[0].text, "the polygon");
}

TEST(MissionText, ALaterCoordinatorTellsItInItsOwnTerm) {
  Flying swarm(polygon());
  swarm.stop_coordinator();
  swarm.fly(seconds(1));
  swarm.start_coordinator();
  swarm.fly(seconds(10));
  ASSERT_EQ(swarm.missions.size(), 2U);
  EXPECT_GT(swarm.missions[1].term, swarm.missions[0].term);
  EXPECT_EQ(swarm.missions[1].text, "the polygon");
  EXPECT_EQ(swarm.missions[1].plan, swarm.status->plan);
}

TEST(MissionText, OneThatIsTooLongIsToldEmpty) {
  for (const auto& [bytes, fits] :
       {std::pair{protocol::kMaxMissionBytes, true}, {protocol::kMaxMissionBytes + 1, false}}) {
    SwarmOfAgents swarm(told(test::job(), std::string(bytes, 'x')));
    swarm.fly(seconds(5));
    ASSERT_EQ(swarm.missions.size(), 1U);
    EXPECT_EQ(swarm.missions[0].text.size(), fits ? bytes : 0U);
    EXPECT_EQ(swarm.missions[0].plan, swarm.status->plan) << "who knew another one learns that this is not it";
  }
}

}  // namespace
}  // namespace gyre::coordinator
