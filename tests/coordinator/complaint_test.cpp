// What a coordinator says keeps it from its work.

#include <gtest/gtest.h>

#include "common/mechanics/skew.hpp"
#include "tests/coordinator/swarm_of_agents.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kCarriers = 3;

std::string complaint(test::SwarmOfAgents& swarm) {
  return swarm.coordinator().complaint(swarm.now).value_or("none");
}

TEST(Complaint, NamesWhoIsNotHeard) {
  test::SwarmOfAgents swarm(test::job(kCarriers));
  swarm.stop_agent(2);
  EXPECT_EQ(complaint(swarm), "has heard nobody yet");
  swarm.fly(seconds(3));
  EXPECT_EQ(complaint(swarm), "waiting for carrier 2: a flight begins with all");
  swarm.start_agent(2);
  swarm.fly(seconds(3));
  EXPECT_EQ(complaint(swarm), "none");
  swarm.mute = {1, 3};
  swarm.fly(milliseconds(600));
  EXPECT_EQ(complaint(swarm), "carriers 1 and 3 are silent");
  swarm.mute = {1, 2, 3};
  swarm.fly(milliseconds(600));
  EXPECT_EQ(complaint(swarm), "no agent is heard");
}

TEST(Complaint, NamesClocksThatMayDisagreeBeyondTheBudgetThatTheBeaconTells) {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  test::SwarmOfAgents swarm(test::job(kCarriers), options);
  swarm.fly(seconds(30));
  const mechanics::Plan plan = test::job(kCarriers).plan;
  const double budget_s = mechanics::skew_budget_s(mechanics::slices(plan), plan.load.mass_kg * plan.gravity_m_s2);
  ASSERT_EQ(swarm.coordinator().course().base.number, swarm.beacon->course.base.number);
  EXPECT_EQ(swarm.beacon->skew_budget, from_seconds(budget_s)) << "in the motion";
  EXPECT_EQ(complaint(swarm), "none");
  swarm.change_status = [&](protocol::AgentStatus& status) { status.clock_uncertainty = from_seconds(budget_s); };
  swarm.fly(seconds(1));
  EXPECT_EQ(complaint(swarm).rfind("the clocks may disagree by ", 0), 0U) << complaint(swarm);
}

}  // namespace
}  // namespace gyre::coordinator
