// No departure while somebody who is needed for it says that he cannot do his work.

#include <gtest/gtest.h>

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

TEST(Readiness, DepartsOnlyWhenNobodyComplains) {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  SwarmOfAgents swarm(job(), options);
  const auto complain = [&](const std::string& process, const std::string& text) {
    swarm.tell(protocol::Health{process, text, {}, 0, 0, 0});
  };
  complain("ground", "has nothing to look at");
  complain("agent 77", "is none of this swarm");
  complain("simulator", "no setpoints for carrier 2");
  swarm.fly(milliseconds(900));
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
  EXPECT_FALSE(says(swarm.news, "does not begin")) << "it may be only late";
  complain("simulator", "no setpoints for carrier 2");
  swarm.fly(milliseconds(2500));
  EXPECT_TRUE(says(swarm.news, "the motion does not begin: simulator: no setpoints for carrier 2"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(20)), "refused: simulator: no setpoints"));
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
  complain("simulator", "");
  swarm.fly(seconds(2));
  EXPECT_FALSE(swarm.coordinator().course().transitions.empty());
  complain("simulator", "no setpoints for carrier 2");
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done")) << "in motion nobody is asked";
}

TEST(Readiness, DoesNotWaitForWhoComplainedAndFellSilent) {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  SwarmOfAgents swarm(job(), options);
  swarm.tell(protocol::Health{"simulator", "no setpoints for carrier 2", {}, 0, 0, 0});
  swarm.fly(seconds(9));
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty()) << "that nobody withdraws it may be the radio's doing";
  swarm.fly(seconds(5));
  EXPECT_FALSE(swarm.coordinator().course().transitions.empty());
}

}  // namespace
}  // namespace gyre::coordinator
