// What a laboratory may do to a process: each kind, its bounds, and what is dropped and counted.

#include "common/protocol/disturbance.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace gyre::protocol {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr LocalTime kStart(hours(5));

Disturbance loss(double share, Duration duration = {}) {
  return {"agent 3", DisturbanceKind::kLosePackets, share, {}, Eigen::Vector3d::Zero(), duration};
}
Disturbance shift(Duration by) {
  return {"agent 3", DisturbanceKind::kShiftClock, 0.0, by, Eigen::Vector3d::Zero(), {}};
}
Disturbance push(Duration duration) {
  return {"simulator", DisturbanceKind::kPushLoad, 0.0, {}, {1.0, 0.0, 0.0}, duration};
}
bool nothing(const Disturbing& out) {
  return !out.share && !out.shift && !out.push;
}

TEST(Disturbance, NamesAProcess) {
  for (const char* name : {"coordinator", "simulator", "agent 1", "agent 42", "agent 100"}) {
    EXPECT_TRUE(names_process(name)) << name;
  }
  for (const char* name : {"", "agent", "agent ", "agent 0", "agent 101", "agent 1000", "agent 03", "agent 3 ",
                           "agent -3", "agent 3x", "agent  3", "Agent 3", "coordinators", "ground"}) {
    EXPECT_FALSE(names_process(name)) << name;
  }
}

TEST(Disturbance, IsForTheProcessItNames) {
  DisturbanceJudge other("agent 4");
  const Disturbing out = other.take(kStart, loss(0.3));
  EXPECT_TRUE(nothing(out));
  EXPECT_TRUE(out.notices.empty());
  EXPECT_EQ(other.nonsense(), 0U);
  DisturbanceJudge meant("agent 3");
  EXPECT_EQ(meant.take(kStart, loss(0.3)).share, 0.3);
}

TEST(Disturbance, LosesPacketsUntilToldOtherwise) {
  DisturbanceJudge judge("agent 3");
  const Disturbing out = judge.take(kStart, loss(0.3));
  EXPECT_EQ(out.share, 0.3);
  ASSERT_EQ(out.notices.size(), 1U);
  EXPECT_EQ(out.notices.front().level, Notice::Level::kWarning);
  EXPECT_EQ(out.notices.front().text, "laboratory: 30 % of the packets are lost from now on");
  EXPECT_TRUE(nothing(judge.at(kStart + hours(24))));
  EXPECT_EQ(judge.take(kStart, loss(0.0)).share, 0.0);
}

TEST(Disturbance, LosesPacketsForAWhile) {
  DisturbanceJudge judge("agent 3");
  EXPECT_EQ(judge.take(kStart, loss(1.0, seconds(6))).share, 1.0);
  EXPECT_TRUE(nothing(judge.at(kStart + milliseconds(5999))));
  EXPECT_EQ(judge.at(kStart + seconds(6)).share, 0.0);
  EXPECT_TRUE(nothing(judge.at(kStart + seconds(7)))) << "it ends once";
  // The newest word counts, whatever was said before.
  (void)judge.take(kStart, loss(1.0, seconds(6)));
  (void)judge.take(kStart, loss(0.2));
  EXPECT_TRUE(nothing(judge.at(kStart + seconds(6))));
}

TEST(Disturbance, ALossLastsAsLongWhenTheClockLeaps) {
  DisturbanceJudge judge("agent 3");
  (void)judge.take(kStart, loss(1.0, seconds(6)));
  (void)judge.take(kStart, shift(seconds(100)));
  EXPECT_TRUE(nothing(judge.at(kStart + seconds(105))));
  EXPECT_EQ(judge.at(kStart + seconds(106)).share, 0.0);
}

TEST(Disturbance, ShiftsTheClockEitherWay) {
  DisturbanceJudge judge("agent 3");
  const Disturbing on = judge.take(kStart, shift(seconds(5)));
  EXPECT_EQ(on.shift, seconds(5));
  EXPECT_EQ(on.notices.front().text, "laboratory: this process's clock leaps by 5 s");
  const Disturbing back = judge.take(kStart, shift(-milliseconds(1500)));
  EXPECT_EQ(back.shift, -milliseconds(1500));
  EXPECT_EQ(back.notices.front().text, "laboratory: this process's clock stands still for 1.5 s");
  EXPECT_TRUE(nothing(judge.take(kStart, shift(-seconds(1))))) << "it stands still: this time has not passed";
  EXPECT_EQ(judge.take(kStart + kBetweenShiftsBack, shift(-seconds(1))).shift, -seconds(1));
}

TEST(Disturbance, TheShiftsOfAClockAreBoundedTogether) {
  DisturbanceJudge judge("agent 3");
  for (int hour = 0; hour < 100; ++hour) EXPECT_EQ(judge.take(kStart, shift(hours(1))).shift, hours(1));
  EXPECT_TRUE(nothing(judge.take(kStart, shift(Duration(1)))));
  EXPECT_EQ(judge.take(kStart, shift(-seconds(5))).shift, -seconds(5));
}

TEST(Disturbance, OnlyTheSimulatorIsPushedAndOnlyItsClockStays) {
  DisturbanceJudge judge("simulator");
  const Disturbing out = judge.take(kStart, push(milliseconds(200)));
  ASSERT_TRUE(out.push);
  EXPECT_EQ(out.push->force_w_n.x(), 1.0);
  EXPECT_EQ(out.push->duration, milliseconds(200));
  Disturbance clock = shift(seconds(1));
  clock.process = "simulator";
  EXPECT_TRUE(nothing(judge.take(kStart, clock)));
  DisturbanceJudge agent("agent 3");
  Disturbance elsewhere = push(milliseconds(200));
  elsewhere.process = "agent 3";
  EXPECT_TRUE(nothing(agent.take(kStart, elsewhere)));
  EXPECT_EQ(judge.nonsense() + agent.nonsense(), 2U);
}

TEST(Disturbance, IsDroppedCountedAndExplainedBeyondItsBounds) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    Disturbance disturbance;
    const char* explained;
  };
  Disturbance nobodys = loss(0.3);
  nobodys.process = "agent 0";
  Disturbance unknown = loss(0.3);
  unknown.kind = static_cast<DisturbanceKind>(4);
  const Case cases[] = {
      {nobodys, "names no process"},
      {unknown, "names no process"},
      {loss(kNan), "nothing can be"},
      {loss(0.91), "give a duration"},
      {loss(0.5, seconds(61)), "60 s at most"},
      {shift({}), "not by nothing"},
      {shift(hours(1) + Duration(1)), "5 s back to 3600 s on"},
      {shift(-seconds(5) - Duration(1)), "5 s back"},
  };
  DisturbanceJudge judge("agent 3");
  LocalTime now = kStart;
  for (const Case& wrong : cases) {
    const Disturbing out = judge.take(now += seconds(1), wrong.disturbance);
    EXPECT_TRUE(nothing(out));
    ASSERT_EQ(out.notices.size(), 1U);
    EXPECT_EQ(out.notices.front().level, Notice::Level::kWarning);
    EXPECT_NE(out.notices.front().text.find(wrong.explained), std::string::npos) << out.notices.front().text;
  }
  EXPECT_EQ(judge.nonsense(), std::size(cases));
  EXPECT_EQ(judge.take(now += seconds(1), loss(0.9)).share, 0.9) << "the bounds are allowed";
  EXPECT_EQ(judge.take(now, shift(hours(1))).shift, hours(1));
  DisturbanceJudge simulator("simulator");
  for (const Duration wrong : {Duration{}, kLongestPush + Duration(1)}) {
    EXPECT_TRUE(nothing(simulator.take(now += seconds(1), push(wrong))));
  }
  EXPECT_TRUE(simulator.take(now, push(kLongestPush)).push);
}

TEST(Disturbance, AFloodOfNonsenseIsCountedAndExplainedOnce) {
  DisturbanceJudge judge("agent 3");
  std::size_t words = 0;
  for (int i = 0; i < 100; ++i) words += judge.take(kStart + i * milliseconds(1), loss(2.0)).notices.size();
  EXPECT_EQ(words, 1U);
  EXPECT_EQ(judge.nonsense(), 100U);
}

}  // namespace
}  // namespace gyre::protocol
