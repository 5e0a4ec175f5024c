// When an agent asks for the time: at every beat until it knows it, again where no answer came, else seldom.

#include <gtest/gtest.h>

#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

using TimeTest = AgentTest;

TEST_F(TimeTest, FindsSwarmTimeWithinAFewBeatsOfTheFirstBeacon) {
  int asked = 0;
  const auto beats = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const Outputs out = tell(Tick{});
      if (out.time_request) ++asked;
      if (out.time_request && course_) tell(TimeReplyArrived{reply_to(*out.time_request), now_});
      now_ = out.next_tick;
    }
  };
  beats(100);
  EXPECT_LE(asked, 9) << "nobody is there to answer";
  course(kMotion);
  beacon();
  const LocalTime begin = now_;
  beats(protocol::TimekeeperOptions{}.exchanges_to_trust);
  EXPECT_LE(now_ - begin, milliseconds(30)) << "and its beats are short meanwhile";
  ASSERT_TRUE(status_);
  EXPECT_LT(status_->clock_uncertainty, seconds(1));
}

TEST_F(TimeTest, AsksAgainAtTheStartWhereNoAnswerCame) {
  course(kMotion);
  int asked = 0;
  for (const LocalTime end = now_ + seconds(1); now_ < end;) {
    beacon();
    const Outputs out = tell(Tick{});
    if (out.time_request) ++asked;
    now_ = out.next_tick;
  }
  EXPECT_NEAR(asked, 50, 2);
}

// At 60 % loss five of six exchanges fail; how clocks drift is learned from those that do not.
TEST_F(TimeTest, AsksAgainSoonWhereNoAnswerCameUnlessNobodyIsThere) {
  rest();
  const auto asked_in_a_second = [&](bool beacons, bool answers) {
    int asked = 0;
    for (int i = 0; i < 100; ++i, now_ += milliseconds(10)) {
      if (beacons) beacon();
      const Outputs out = tell(Tick{});
      if (!out.time_request) continue;
      ++asked;
      if (answers) tell(TimeReplyArrived{reply_to(*out.time_request), now_});
    }
    return asked;
  };
  EXPECT_NEAR(asked_in_a_second(true, true), 8, 1);
  EXPECT_NEAR(asked_in_a_second(true, false), 25, 1);
  asked_in_a_second(false, false);
  EXPECT_NEAR(asked_in_a_second(false, false), 8, 1) << "alone";
}

}  // namespace
}  // namespace gyre::agent
