// Laws of the clock that can be made wrong: what it shows, when it shows it, and that waiting heeds both.

#include "common/dds/clock.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <thread>

#include "common/dds/inbox.hpp"

namespace gyre {
namespace {

using namespace std::chrono_literals;
using Steady = dds::ClockError::Steady;

constexpr Duration kHundredDays = 24h * 100;

/// A clock with any error there may be, and a moment on the machine's clock.
struct Case {
  dds::ClockError error;
  Steady moment;
};

Case any_case() {
  const auto offset = Duration(*rc::gen::inRange<std::int64_t>(-1'000'000'000'000'000, 1'000'000'000'000'001));
  const double drift_ppm = 1e-3 * *rc::gen::inRange(-10'000'000, 10'000'001);
  const auto since = Duration(*rc::gen::inRange<std::int64_t>(0, kHundredDays.count()));
  const auto elapsed = Duration(*rc::gen::inRange<std::int64_t>(-1'000'000'000, kHundredDays.count()));
  return {dds::ClockError(offset, drift_ppm, Steady(since)), Steady(since + elapsed)};
}

TEST(ClockError, IsNoneUnlessThereIsOne) {
  const dds::ClockError none;
  const Steady moment(123'456'789'012'345'678ns);
  EXPECT_EQ(none.shown_at(moment).time_since_epoch(), moment.time_since_epoch());
  EXPECT_EQ(none.moment_of(none.shown_at(moment)), moment);
}

TEST(ClockError, AddsTheOffsetAtOnceAndTheDriftAsTimePasses) {
  const dds::ClockError error(-2h, 100.0, Steady(5s));
  EXPECT_EQ(error.shown_at(Steady(5s)), LocalTime(5s - 2h));
  EXPECT_EQ(error.shown_at(Steady(5s + 1000s)), LocalTime(5s + 1000s + 100ms - 2h));
  const dds::ClockError slow(0s, -200.0, Steady(0s));
  EXPECT_EQ(slow.shown_at(Steady(10s)), LocalTime(10s - 2ms));
}

RC_GTEST_PROP(ClockError, NeverRunsBackwards, ()) {
  const auto [error, moment] = any_case();
  for (const Duration step : {1ns, 2ns, 99ns, 100ns, 101ns}) {
    RC_ASSERT(error.shown_at(moment) <= error.shown_at(moment + step));
  }
}

RC_GTEST_PROP(ClockError, KnowsTheFirstMomentAtWhichItShowsATime, ()) {
  const auto [error, moment] = any_case();
  // Rounding decides only now and then: many times in a row, so that it has to be right.
  const LocalTime from = error.shown_at(moment);
  for (LocalTime shown = from; shown < from + 300ns; shown += 1ns) {
    const Steady first = error.moment_of(shown);
    RC_ASSERT(error.shown_at(first) >= shown);
    RC_ASSERT(error.shown_at(first - Duration(1)) < shown);
  }
}

class ProcessClock : public testing::Test {
 protected:
  void TearDown() override { dds::set_clock_error({}, 0.0); }
};

TEST_F(ProcessClock, IsTheMachinesUnlessMadeWrong) {
  const Steady before = std::chrono::steady_clock::now();
  const Duration shown = dds::now().time_since_epoch();
  const Steady after = std::chrono::steady_clock::now();
  EXPECT_LE(before.time_since_epoch(), shown);
  EXPECT_GE(after.time_since_epoch(), shown);
}

TEST_F(ProcessClock, IsWrongByWhatItIsTold) {
  for (const Duration offset : {Duration(-5h), Duration(5h)}) {
    dds::set_clock_error(offset, 0.0);
    const Steady before = std::chrono::steady_clock::now();
    const Duration shown = dds::now().time_since_epoch() - offset;
    const Steady after = std::chrono::steady_clock::now();
    EXPECT_LE(before.time_since_epoch(), shown);
    EXPECT_GE(after.time_since_epoch(), shown);
  }
}

// With the deadline taken for the machine's, this would not wait at all, or for hours.
TEST_F(ProcessClock, IsWhatAnInboxsDeadlineIsOn) {
  for (const Duration offset : {Duration(-5h), Duration(5h)}) {
    dds::set_clock_error(offset, -dds::kMaxClockDrift_ppm);
    dds::Inbox<int> inbox;
    const LocalTime deadline = dds::now() + 2ms;
    EXPECT_TRUE(inbox.wait_until(deadline).empty());
    EXPECT_GE(dds::now(), deadline);
  }
}

TEST_F(ProcessClock, ASleepTellsHowLateItEnded) {
  dds::set_clock_error(5h, dds::kMaxClockDrift_ppm);
  dds::Inbox<int> inbox;
  const LocalTime deadline = dds::now() + 2ms;
  const Steady due = dds::steady_time(deadline);
  EXPECT_TRUE(inbox.sleep_until(deadline).empty());
  const Duration at_most = std::chrono::steady_clock::now() - due;
  EXPECT_GT(inbox.late(), Duration::zero());
  EXPECT_LE(inbox.late(), at_most);
  EXPECT_TRUE(inbox.sleep_until(deadline).empty());
  EXPECT_EQ(inbox.late(), Duration::zero()) << "who comes after his deadline has only himself to blame";
}

TEST_F(ProcessClock, LeapsForwardsWhenItIsShifted) {
  dds::set_clock_error(-5h, 100.0);
  const LocalTime before = dds::now();
  dds::shift_clock(5s);
  const LocalTime after = dds::now();
  EXPECT_GE(after, before + 5s);
  EXPECT_LT(after, before + 5s + 1h) << "by no more than what has passed meanwhile";
  const LocalTime deadline = dds::now() + 2ms;
  dds::Inbox<int> inbox;
  EXPECT_TRUE(inbox.wait_until(deadline).empty());
  EXPECT_GE(dds::now(), deadline);
  dds::set_clock_error({}, 0.0);
  EXPECT_EQ(dds::steady_time(LocalTime(7s)), Steady(7s)) << "forgotten with the error";
}

TEST_F(ProcessClock, StandsStillAndNeverRunsBackwardsWhenItIsShiftedBack) {
  dds::shift_clock(-1h);
  const LocalTime stands = dds::now();
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(dds::now(), stands);
  // It goes on when the machine's clock has passed so much more.
  const Duration moment = dds::steady_time(stands + Duration(1)).time_since_epoch();
  EXPECT_EQ(moment, stands.time_since_epoch() + 1h + Duration(1));
  const Steady shown = dds::steady_time(stands);
  EXPECT_LE(shown, std::chrono::steady_clock::now()) << "what it shows has come";
  dds::shift_clock(2h);
  EXPECT_GE(dds::now(), stands + 1h) << "a leap ends it, by what is left";
}

TEST_F(ProcessClock, GoesOnAfterItStoodStill) {
  const LocalTime before = dds::now();
  dds::shift_clock(-2ms);
  const LocalTime deadline = dds::now() + 1ms;
  dds::Inbox<int> inbox;
  EXPECT_TRUE(inbox.wait_until(deadline).empty());
  EXPECT_GE(dds::now(), deadline);
  EXPECT_GE(std::chrono::steady_clock::now().time_since_epoch(), before.time_since_epoch() + 3ms);
}

TEST_F(ProcessClock, IsReadByOthersWhileItIsShifted) {
  std::atomic<bool> done{false};
  std::atomic<int> steps{0};
  std::thread reader([&] {
    LocalTime before = dds::now();
    while (!done) {
      const LocalTime after = dds::now();
      // What another thread reads in the middle of a shift may be ahead of where the clock then stands by what the
      // call takes, which is nothing to a second.
      if (after < before - 1s) ++steps;
      before = after;
    }
  });
  for (int i = 0; i < 2000; ++i) dds::shift_clock(i % 2 == 0 ? Duration(5s) : Duration(-5s));
  done = true;
  reader.join();
  EXPECT_EQ(steps, 0);
}

TEST(Inbox, GivesEveryEventOnceAndWhenItIsFullTheNewest) {
  dds::Inbox<int> inbox(3);
  const auto taken = [&](bool sleeps) {
    const auto& events = sleeps ? inbox.sleep_until(dds::now()) : inbox.wait_until(dds::now());
    return std::vector<int>(events.begin(), events.end());
  };
  for (const bool sleeps : {false, true}) {
    for (int i = 1; i <= 4; ++i) inbox.push(i);
    EXPECT_EQ(taken(sleeps), (std::vector<int>{2, 3, 4}));
    inbox.push(5);
    EXPECT_EQ(taken(sleeps), std::vector<int>{5});
    EXPECT_TRUE(taken(sleeps).empty());
  }
  EXPECT_EQ(inbox.dropped(), 2U);
}

}  // namespace
}  // namespace gyre
