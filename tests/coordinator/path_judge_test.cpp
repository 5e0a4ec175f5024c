// Who is stuck, by what his vehicle says, and where all the others then have to stop.

#include "coordinator/core/path_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coordinator/core/ramps.hpp"

namespace gyre::coordinator {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Carriers on circles of a metre at 1 rad/s, whose vehicles say every 20 ms where they are.
class PathJudgeTest : public testing::Test {
 protected:
  static constexpr Duration kPeriod = milliseconds(20);

  [[nodiscard]] static mechanics::TaylorVector<double> planned(double t_s) {
    mechanics::TaylorVector<double> p;
    p.value = {std::cos(t_s), std::sin(t_s), 0.0};
    p.first = {-std::sin(t_s), std::cos(t_s), 0.0};
    return p;
  }
  /// It says that it is where it would be `behind_s` ago, making that share of its way.
  void say(CarrierId carrier, double behind_s = 0.0, double way = 1.0) {
    const double t_s = gyre::seconds(now_.time_since_epoch());
    const auto there = planned(t_s - behind_s);
    protocol::CarrierState state;
    state.carrier = carrier;
    state.position_w_m = there.value;
    state.velocity_w_m_s = way * there.first;
    judge_.take(now_, state, planned(t_s));
  }
  /// All on their paths, until something else is told of one.
  void fly(Duration time, CarrierId but = 0) {
    for (const LocalTime end = now_ + time; now_ < end; now_ += kPeriod) {
      for (CarrierId id = 1; id <= 4; ++id) {
        if (id != but) say(id, 0.015);
      }
      EXPECT_FALSE(judge_.stuck(now_, 4));
    }
  }

  LocalTime now_{seconds(100)};
  PathJudge judge_;
};

TEST_F(PathJudgeTest, NamesWhoStopsAndWhereWithinATenthOfASecond) {
  fly(seconds(2));
  EXPECT_TRUE(judge_.on_path(now_, 3));
  const LocalTime stopped = now_;
  std::optional<PathJudge::Stuck> stuck;
  while (!stuck && now_ < stopped + seconds(1)) {
    for (const CarrierId id : {1U, 2U, 4U}) say(id);
    say(3, gyre::seconds(now_ - stopped), 0.0);
    stuck = judge_.stuck(now_, 4);
    if (!stuck) now_ += kPeriod;
  }
  ASSERT_TRUE(stuck);
  EXPECT_EQ(stuck->carrier, 3U);
  EXPECT_LT(now_ - stopped, milliseconds(100));
  EXPECT_NEAR(gyre::seconds(stuck->lag), gyre::seconds(now_ - stopped), 1e-3);
  EXPECT_FALSE(judge_.on_path(now_, 3));
  EXPECT_FALSE(judge_.stuck(now_, 4)) << "it is told once";
}

TEST_F(PathJudgeTest, WhoWasNeverOnHisPathIsNotStuck) {
  for (int i = 0; i < 100; ++i, now_ += kPeriod) {
    for (const CarrierId id : {1U, 2U, 4U}) say(id);
    say(3, 2.0, 0.0);  // an agent that merges back, a vehicle that waits
    EXPECT_FALSE(judge_.stuck(now_, 4));
  }
}

TEST_F(PathJudgeTest, OneStrangeWordIsNoEvidenceAndFasterIsNotStuck) {
  fly(seconds(2));
  say(3, 0.0, 0.1);
  EXPECT_FALSE(judge_.stuck(now_, 4));
  now_ += kPeriod;
  fly(seconds(1));
  for (int i = 0; i < 50; ++i, now_ += kPeriod) {
    for (const CarrierId id : {1U, 2U, 4U}) say(id);
    say(3, -0.02 * i, 2.0);  // it never heard that the others slow down
    EXPECT_FALSE(judge_.stuck(now_, 4));
  }
}

TEST_F(PathJudgeTest, WhereMostAreSlowItIsTheClockHere) {
  fly(seconds(2));
  for (int i = 0; i < 50; ++i, now_ += kPeriod) {
    for (const CarrierId id : {1U, 2U, 3U}) say(id, 0.02 * i, 0.0);
    say(4);
    EXPECT_FALSE(judge_.stuck(now_, 4));
  }
}

TEST_F(PathJudgeTest, WhatIsNotSaidAnyMoreIsNotSo) {
  fly(seconds(2));
  say(3, 0.02, 0.0);
  now_ += milliseconds(300);
  EXPECT_FALSE(judge_.stuck(now_, 4));
  EXPECT_FALSE(judge_.off_m(now_, 3));
  EXPECT_FALSE(judge_.on_path(now_, 1)) << "nobody says anything";
}

TEST(StoppedAt, StopsAndGoesBackToWhereTheStuckOneStands) {
  protocol::Pace motion;
  motion.ramps.front().from.pace = motion.ramps.front().target = 1.0;
  for (const double lag_s : {0.0, 0.05, 0.2, 0.5, 2.0}) {
    const SwarmTime now{seconds(50)};
    const PlanTime where = motion.at(now - from_seconds(lag_s)).at;
    const protocol::Pace stop = stopped_at(where, motion, now, milliseconds(300));
    const SwarmTime end = stop.ramps.back().end();
    EXPECT_NEAR(gyre::seconds(stop.at(end).at - where), 0.0, 1e-6) << lag_s;
    EXPECT_TRUE(stop.rests(end));
    EXPECT_LE(stop.ramps.size(), 3U);
    for (SwarmTime t = now; t < end; t += milliseconds(10)) {
      EXPECT_GE(stop.at(t).pace, -0.31);
      EXPECT_LE(stop.at(t).pace, 1.0);
    }
  }
}

}  // namespace
}  // namespace gyre::coordinator
