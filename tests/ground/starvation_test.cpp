// A starved machine from a defect: told by the kernel's accounts.

#include "ground/flight/core/starvation.hpp"

#include <gtest/gtest.h>

namespace gyre::ground {
namespace {

using namespace std::chrono_literals;

constexpr int kAgent = 7;
constexpr int kHog = 8;
constexpr Duration kStep = 50ms;

/// Two processors, an agent that uses two percent of one and waits for nothing.
class StarvationTest : public testing::Test {
 protected:
  StarvationTest() {
    account_.processors = 2;
    account_.stolen.resize(2);
    account_.processes[kAgent] = {10s, 5s};
    see();
  }
  void see() { judge_.see(now_, account_); }
  ProcessorAccount::Process& agent() { return account_.processes[kAgent]; }
  /// One step in which the agent waits, or is told to have waited, and a process of ours uses processors.
  void step(Duration agent_waited, Duration hog_used) {
    now_ += kStep;
    agent().used += kStep / 50;
    agent().waited += agent_waited;
    if (hog_used > Duration::zero()) account_.processes[kHog].used += hog_used;
    see();
  }

  LocalTime now_{};
  ProcessorAccount account_;
  StarvationJudge judge_;
};

TEST_F(StarvationTest, AQuietFlightIsNotStarved) {
  for (int i = 0; i < 1000; ++i) step(1ms, {});
  EXPECT_FALSE(judge_.starved());
  EXPECT_NEAR(seconds(judge_.late_max()), 0.001 - 0.001 / 2, 1e-9) << "less what it used itself";
}

TEST_F(StarvationTest, NeighboursThatHaveTheProcessorsStarveIt) {
  for (int i = 0; i < 5; ++i) step({}, {});  // it waits all along; the kernel says so when the wait is over
  EXPECT_FALSE(judge_.starved());
  step(300ms, {});
  EXPECT_TRUE(judge_.starved());
  EXPECT_NEAR(seconds(judge_.late_max()), 0.3 - 0.3 * 0.02 / 2, 1e-9);
  for (int i = 0; i < 1000; ++i) step({}, {});
  EXPECT_TRUE(judge_.starved()) << "the worst is kept";
}

TEST_F(StarvationTest, AHogOfOurOwnIsADefect) {
  for (int i = 0; i < 20; ++i) step({}, 2 * kStep - kStep / 50);
  step(1s, 2 * kStep - kStep / 50);
  EXPECT_EQ(judge_.late_max(), Duration::zero());
}

TEST_F(StarvationTest, AHogOfOurOwnIsADefectWhenItsVictimTellsOfItLater) {
  for (int i = 0; i < 19; ++i) step({}, 2 * kStep);
  step(950ms, {});  // the hog is gone when the victim runs again
  EXPECT_FALSE(judge_.starved()) << seconds(judge_.late_max());
}

TEST_F(StarvationTest, AHogOfOurOwnIsADefectWhoeverComesLateToSeeIt) {
  now_ += 400ms;  // accounts are late on a busy machine
  step(300ms, 600ms);
  EXPECT_EQ(judge_.late_max(), Duration::zero());
}

TEST_F(StarvationTest, OneProcessorOfOursInTwoIsHalfOfTheBlame) {
  for (int i = 0; i < 6; ++i) step({}, kStep);
  step(300ms, kStep);
  EXPECT_NEAR(seconds(judge_.late_max()), 0.3 - 0.3 * 1.02 / 2, 1e-9);
}

TEST_F(StarvationTest, AStoppedProcessIsNotWaiting) {
  now_ += 2s;  // nothing of the account has changed
  see();
  EXPECT_EQ(judge_.late_max(), Duration::zero());
}

TEST_F(StarvationTest, ALongComputationIsNotWaiting) {
  for (int i = 0; i < 40; ++i) {
    now_ += kStep;
    agent().used += kStep;
    see();
  }
  EXPECT_EQ(judge_.late_max(), Duration::zero());
}

TEST_F(StarvationTest, AHypervisorThatKeepsAProcessorStarvesIt) {
  account_.stolen[1] += 200ms;
  step({}, {});
  EXPECT_NEAR(seconds(judge_.late_max()), 0.2 - 0.001 / 2, 1e-9);
}

TEST_F(StarvationTest, WhatWasBeforeIsNoneOfIt) {
  EXPECT_EQ(judge_.late_max(), Duration::zero()) << "the agent had waited for 5 s";
}

TEST_F(StarvationTest, AProcessThatComesHasItsAccountFromItsBeginning) {
  account_.processes[9] = {1ms, 150ms};
  step({}, {});
  EXPECT_TRUE(judge_.starved());
}

TEST_F(StarvationTest, ANumberThatIsUsedAgainIsAnotherProcess) {
  agent() = {1ms, 150ms};  // it had used 10 s and waited 5
  step({}, {});
  EXPECT_TRUE(judge_.starved());
}

TEST_F(StarvationTest, AProcessThatIsMissingOnceDoesNotBeginAnew) {
  const ProcessorAccount::Process kept = agent();
  account_.processes.clear();
  now_ += kStep;
  see();
  account_.processes[kAgent] = kept;
  step({}, {});
  EXPECT_EQ(judge_.late_max(), Duration::zero());
}

}  // namespace
}  // namespace gyre::ground
