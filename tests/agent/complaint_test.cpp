// What an agent says keeps it from its work: one complaint after the other, in the order in which a start settles them.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

class ComplaintTest : public AgentTest {
 protected:
  [[nodiscard]] std::string complaint() const { return agent_->complaint(now_).value_or("none"); }
};

TEST_F(ComplaintTest, IsSettledStepByStepAtAStart) {
  fly(milliseconds(100), false);
  EXPECT_EQ(complaint(), "no coordinator was heard");
  course(kMotion);
  beacon();
  EXPECT_EQ(complaint(), "swarm time was not found");
  fly(seconds(1));
  EXPECT_EQ(complaint(), "has no plan yet");
  rest();
  EXPECT_EQ(complaint(), "none");
}

TEST_F(ComplaintTest, NamesACoordinatorAndAVehicleThatFellSilent) {
  rest();
  fly(seconds(2), false);
  EXPECT_EQ(complaint(), "the coordinator is silent since 2.0 s");
  fly(seconds(1));
  EXPECT_EQ(complaint(), "none");
  vehicle_.reset();
  fly(milliseconds(900));
  EXPECT_EQ(complaint(), "none") << "a few lost states are nothing";
  fly(milliseconds(600));
  EXPECT_EQ(complaint(), "its vehicle is silent since 1.5 s");
}

TEST_F(ComplaintTest, NamesAClockThatIsBeyondWhatThePlanInForceAllows) {
  rest();
  const Duration uncertainty = status_->clock_uncertainty;
  ASSERT_GT(uncertainty, Duration::zero());
  tell(Beacon{kTerm, ++sequence_, swarm(), *course_, {}, 3 * uncertainty});
  EXPECT_EQ(complaint(), "none");
  tell(Beacon{kTerm, ++sequence_, swarm(), *course_, {}, uncertainty});
  EXPECT_EQ(complaint().rfind("its clock may be wrong by ", 0), 0U) << complaint();
  tell(Beacon{kTerm, ++sequence_, swarm(), *course_, {}, Duration::zero()});
  EXPECT_EQ(complaint(), "none") << "a plan that does not move allows any";
}

}  // namespace
}  // namespace gyre::agent
