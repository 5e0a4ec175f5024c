// No departure while somebody who is needed for it says that he cannot do his work.

#include <gtest/gtest.h>

#include "tests/coordinator/swarm_of_agents.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::engaging;
using test::job;
using test::says;
using test::SwarmOfAgents;

TEST(Readiness, DepartsOnlyWhenNobodyComplains) {
  SwarmOfAgents swarm(job(), engaging());
  const auto complain = [&](const std::string& process, const std::string& text) {
    swarm.tell(protocol::Health{process, text, {}, 0, 0, 0, {}});
  };
  complain("ground", "has nothing to look at");
  complain("agent 77", "is none of this swarm");
  complain("simulator", "no setpoints for carrier 2");
  swarm.fly(milliseconds(900));
  EXPECT_EQ(swarm.course().pace.target(), 0.0);
  EXPECT_FALSE(says(swarm.news, "does not begin")) << "it may be only late";
  complain("simulator", "no setpoints for carrier 2");
  swarm.fly(milliseconds(2500));
  EXPECT_TRUE(says(swarm.news, "the motion does not begin: simulator: no setpoints for carrier 2"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(20)), "refused: simulator: no setpoints"));
  EXPECT_EQ(swarm.course().pace.target(), 0.0);
  complain("simulator", "");
  swarm.fly(seconds(2));
  EXPECT_EQ(swarm.course().pace.target(), 1.0);
  complain("simulator", "no setpoints for carrier 2");
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done")) << "in motion nobody is asked";
}

TEST(Readiness, DoesNotWaitForWhoComplainedAndFellSilent) {
  SwarmOfAgents swarm(job(), engaging());
  swarm.tell(protocol::Health{"simulator", "no setpoints for carrier 2", {}, 0, 0, 0, {}});
  swarm.fly(seconds(9));
  EXPECT_EQ(swarm.course().pace.target(), 0.0) << "that nobody withdraws it may be the radio's doing";
  swarm.fly(seconds(5));
  EXPECT_EQ(swarm.course().pace.target(), 1.0);
}

}  // namespace
}  // namespace gyre::coordinator
