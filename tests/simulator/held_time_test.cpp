// The time base that a vehicle flies by: as smooth as a clock, whatever the machine does to arrivals.

#include "simulator/core/held_time.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gyre::simulator {
namespace {

using namespace std::chrono_literals;

constexpr Duration kOldest = 1s;
constexpr Duration kPeriod = 10ms;

/// One agent's setpoints at 100 Hz, and what the vehicle makes of them.
class Stream {
 public:
  /// The next one, after a way of `delay`; by how much its time base moved since the one before.
  Duration next(Duration delay) {
    sent_ += kPeriod;
    const LocalTime held = time_.of(sent_ + clock_, LocalTime(sent_ + delay), kOldest);
    const Duration base = held.time_since_epoch() - sent_;
    const Duration moved = base - base_;
    base_ = base;
    return moved;
  }
  Duration many(int count, Duration delay) {
    Duration most{};
    for (int i = 0; i < count; ++i) most = std::max(most, std::chrono::abs(next(delay)));
    return most;
  }
  /// The agent's clock leaps.
  void leap(Duration by) { clock_ += by; }
  /// What it takes for delay now, but for the clock.
  [[nodiscard]] Duration base() const { return base_; }

 private:
  HeldTime time_;
  Duration sent_ = 100s;
  Duration clock_{};
  Duration base_{};
};

TEST(HeldTime, IsTheStampWhereTheWayIsAlwaysTheSame) {
  Stream stream;
  stream.next(200us);
  EXPECT_EQ(stream.many(1000, 200us), 0us);
  EXPECT_EQ(stream.base(), 200us);
}

RC_GTEST_PROP(HeldTime, IsSmoothWhileDelaysAreNot, ()) {
  const auto delays = *rc::gen::container<std::vector<int>>(600, rc::gen::inRange(100, 400));
  Stream stream;
  stream.many(150, 200us);
  for (const int delay_us : delays) {
    // A winch that pays out 4 m/s is asked for 10 µm more.
    RC_ASSERT(std::chrono::abs(stream.next(std::chrono::microseconds(delay_us))) <= 2500ns);
  }
}

TEST(HeldTime, DoesNotWaitForASetpointThatIsLate) {
  Stream stream;
  stream.many(150, 200us);
  EXPECT_LT(std::chrono::abs(stream.next(30ms)), 1us) << "it held when its stamp says, not when it came";
  EXPECT_LT(stream.many(100, 200us), 1us);
}

TEST(HeldTime, WalksOffAWayThatHasBecomeLonger) {
  Stream stream;
  stream.many(150, 200us);
  EXPECT_LT(stream.many(400, 500us), 5us);
  stream.many(600, 500us);
  EXPECT_NEAR(seconds(stream.base()), 500e-6, 20e-6);
}

TEST(HeldTime, FollowsAClockThatIsWalkedToANewTime) {
  Stream stream;
  stream.many(150, 200us);
  for (int i = 0; i < 100; ++i) {  // a hundredth of its rate, for a second
    stream.leap(100us);
    EXPECT_LE(std::chrono::abs(stream.next(200us)), 110us);
  }
  stream.many(1000, 200us);
  EXPECT_NEAR(seconds(stream.base()), 200e-6, 50e-6);
}

TEST(HeldTime, BelievesALeapOnceFourSaidIt) {
  for (const Duration leap : {Duration(300ms), Duration(-300ms)}) {
    Stream stream;
    stream.many(150, 200us);
    stream.leap(leap);
    for (int i = 0; i < 3; ++i) {
      stream.next(200us);
      EXPECT_NEAR(seconds(stream.base()), seconds(leap > 0s ? Duration(200us) : 200us + leap), 1e-6) << i;
    }
    stream.many(120, 200us);
    EXPECT_EQ(stream.base(), 200us);
  }
}

TEST(HeldTime, IsNeverOlderThanTold) {
  HeldTime time;
  for (int i = 0; i < 200; ++i) (void)time.of(i * kPeriod, LocalTime(i * kPeriod), kOldest);
  const LocalTime awake(5s);  // what came meanwhile was not read
  time.keep(awake);
  EXPECT_EQ(time.of(2s, awake, kOldest), awake - kOldest);
  EXPECT_EQ(time.of(5s, awake, kOldest), awake);
}

TEST(HeldTime, KeepsWhatItKnewWhileNobodyListened) {
  HeldTime time;
  for (int i = 0; i < 200; ++i) (void)time.of(i * kPeriod, LocalTime(i * kPeriod + 200us), kOldest);
  const Duration away = 20s;
  time.keep(LocalTime(2s + away));
  const LocalTime held = time.of(2s + away, LocalTime(2s + away + 700us), kOldest);
  EXPECT_NEAR(seconds(held.time_since_epoch() - (2s + away)), 200e-6, 20e-6);
}

}  // namespace
}  // namespace gyre::simulator
