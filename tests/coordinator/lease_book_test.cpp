// How long the phase may run on without another word: extended while all confirm, and never on a silent one's old word.

#include "coordinator/core/lease_book.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

namespace gyre::coordinator {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kTick = milliseconds(20);
const protocol::Silence kStop{seconds(5)};

protocol::AgentStatus status(CarrierId carrier, std::uint64_t sequence, std::uint64_t incarnation = 1) {
  protocol::AgentStatus s;
  s.carrier = carrier;
  s.sequence = sequence;
  s.incarnation = incarnation;
  return s;
}

/// Two carriers that confirm every lease they hear of, as long as they are heard.
class LeaseBookTest : public testing::Test {
 protected:
  void pass(Duration time, bool second_is_heard = true) {
    for (const SwarmTime until = now_ + time; now_ < until; now_ += kTick) {
      lease_ = *book_.step(LocalTime(now_.time_since_epoch()), now_, kStop, carriers_, fleet_);
      latest_ = std::max(latest_, lease_);
      confirm(1);
      if (second_is_heard) confirm(2);
    }
  }
  void confirm(CarrierId id) {
    protocol::AgentStatus status;
    status.carrier = id;
    status.incarnation = 1;
    status.sequence = ++sequence_;
    status.beacons_received = sequence_;
    if (id == 2) last_heard_ = sequence_;
    status.course.lease = lease_;
    fleet_.take(LocalTime(now_.time_since_epoch()), status);
  }
  [[nodiscard]] Duration ahead() const { return lease_ - now_; }

  std::vector<CarrierId> carriers_{1, 2};
  Fleet fleet_{carriers_, milliseconds(450)};
  LeaseBook book_;
  SwarmTime now_{seconds(100)};
  SwarmTime lease_{};
  SwarmTime latest_{};  ///< that was ever granted
  std::uint64_t sequence_ = 0;
  std::uint64_t last_heard_ = 0;  ///< of the second one's beacons
};

TEST_F(LeaseBookTest, RunsAheadWhileAllConfirm) {
  pass(seconds(10));
  EXPECT_GT(ahead(), seconds(5) - LeaseBook::kStep - 2 * kTick);
  EXPECT_LE(ahead(), seconds(5));
}

TEST_F(LeaseBookTest, GoesBackToWhatTheSilentOneConfirmedAndStaysThere) {
  pass(seconds(3));
  const SwarmTime confirmed = lease_;
  pass(milliseconds(120), false);
  EXPECT_GT(lease_, confirmed) << "a step was on its way when the link broke";
  pass(LeaseBook::kPatience, false);
  EXPECT_EQ(lease_, confirmed);
  latest_ = lease_;
  pass(seconds(15), false);
  EXPECT_EQ(lease_, confirmed);
  EXPECT_EQ(latest_, confirmed) << "an old word extends nothing";
}

TEST_F(LeaseBookTest, IsNotExtendedOnTheWordOfOneWhoSpeaksAndDoesNotHear) {
  pass(seconds(3));
  const SwarmTime confirmed = lease_;
  pass(LeaseBook::kPatience + milliseconds(120), false);
  latest_ = confirmed;
  for (int i = 0; i < 200; ++i) {
    pass(kTick, false);
    protocol::AgentStatus deaf;
    deaf.carrier = 2;
    deaf.incarnation = 1;
    deaf.sequence = ++sequence_;
    deaf.beacons_received = last_heard_;
    deaf.course.lease = confirmed;
    fleet_.take(LocalTime(now_.time_since_epoch()), deaf);
  }
  EXPECT_EQ(latest_, confirmed);
}

TEST_F(LeaseBookTest, RunsOnWhenTheSilentOneIsHeardAgain) {
  for (const Duration away : {seconds(2), seconds(20)}) {
    pass(seconds(1));
    pass(away, false);
    pass(seconds(1));
    EXPECT_GT(ahead(), seconds(5) - LeaseBook::kStep - 2 * kTick);
  }
}

TEST_F(LeaseBookTest, IsForEverWhereTheMissionFliesOn) {
  EXPECT_FALSE(book_.step(LocalTime{}, now_, protocol::Silence{std::nullopt}, carriers_, fleet_));
}

/// The same, step by step.
class Leases : public testing::Test {
 protected:
  std::optional<SwarmTime> step(Duration at) {
    now_ = kBegin + at;
    return book_.step(local(), now_, silence_, {1, 2}, fleet_);
  }
  void confirm(CarrierId carrier, std::optional<SwarmTime> lease) {
    protocol::AgentStatus s = status(carrier, ++sequence_);
    s.course.lease = lease;
    s.beacons_received = hears_ ? ++beacons_[carrier] : beacons_[carrier];
    (void)fleet_.take(local(), s);
  }
  [[nodiscard]] LocalTime local() const { return LocalTime(now_.time_since_epoch()); }
  void confirm_all(std::optional<SwarmTime> lease) {
    for (const CarrierId id : {1U, 2U}) confirm(id, lease);
  }

  static constexpr SwarmTime kBegin{seconds(1000)};
  SwarmTime now_ = kBegin;
  protocol::Silence silence_;
  Fleet fleet_{{1, 2}, milliseconds(450)};
  LeaseBook book_;
  std::uint64_t sequence_ = 0;
  std::map<CarrierId, std::uint64_t> beacons_;
  bool hears_ = true;
};

TEST_F(Leases, AreWholeStepsAhead) {
  EXPECT_EQ(step(milliseconds(0)), kBegin + seconds(5));
  confirm_all(kBegin + seconds(5));
  EXPECT_EQ(step(milliseconds(99)), kBegin + seconds(5)) << "no step has passed";
  EXPECT_EQ(step(milliseconds(100)), kBegin + milliseconds(5100));
}

TEST_F(Leases, GrowByOneStepThatAllHaveConfirmed) {
  const auto first = step(milliseconds(0));
  confirm(1, first);
  EXPECT_EQ(step(milliseconds(300)), first) << "one is not heard yet";
  confirm(2, first);
  EXPECT_EQ(step(milliseconds(320)), kBegin + milliseconds(5300));
  confirm(1, kBegin + milliseconds(5300));
  EXPECT_EQ(step(milliseconds(440)), kBegin + milliseconds(5300)) << "one has not confirmed this step";
}

TEST_F(Leases, GoBackToTheLeastConfirmedAfterAWhile) {
  confirm_all(step(milliseconds(0)));
  const auto second = step(milliseconds(200));
  ASSERT_EQ(second, kBegin + milliseconds(5200));
  confirm(1, second);
  EXPECT_EQ(step(milliseconds(650)), second);
  EXPECT_EQ(step(milliseconds(651)), kBegin + seconds(5));
  EXPECT_EQ(step(milliseconds(4000)), kBegin + seconds(5));
  EXPECT_EQ(step(milliseconds(9000)), kBegin + seconds(5)) << "over is over";
  confirm_all(kBegin + seconds(5));
  EXPECT_EQ(step(milliseconds(9000)), kBegin + milliseconds(14000)) << "all hold the same: it may be another one";
}

TEST_F(Leases, ThatWentBackDoNotGrowUntilAllHaveHeardMore) {
  const auto first = step(milliseconds(0));
  confirm_all(first);
  confirm(1, step(milliseconds(200)));
  ASSERT_EQ(step(milliseconds(700)), first);
  confirm(1, first);
  hears_ = false;
  for (int at_ms = 800; at_ms < 3000; at_ms += 100) {
    confirm(1, first);
    confirm(2, first);  // it is heard, and says what it holds
    EXPECT_EQ(step(milliseconds(at_ms)), first) << "it would not hear of more";
  }
  hears_ = true;
  confirm_all(first);
  EXPECT_EQ(step(milliseconds(3000)), *first + milliseconds(200) + Duration(1))
      << "not what was taken back, of which one knows";
}

TEST_F(Leases, DoNotGrowWhereAStepCouldNotBeTakenBackAnyMore) {
  const auto first = step(milliseconds(0));
  confirm(1, first);
  ASSERT_EQ(step(milliseconds(4249)), first);
  confirm_all(first);
  const LeaseBook in_time = book_;
  EXPECT_EQ(LeaseBook(in_time).step(local(), now_, silence_, {1, 2}, fleet_), *first + LeaseBook::kStep);
  EXPECT_EQ(step(milliseconds(4250)), first);
  EXPECT_EQ(step(milliseconds(5000)), first);
  confirm_all(first);
  EXPECT_EQ(step(milliseconds(5001)), kBegin + seconds(10)) << "all have stopped, and hold the same";
}

TEST_F(Leases, GrowByNoMoreThanAStepWhateverSilenceWasBefore) {
  const auto first = step(milliseconds(0));
  ASSERT_EQ(step(milliseconds(3000)), first);
  confirm_all(first);
  ASSERT_EQ(step(milliseconds(3010)), *first + LeaseBook::kStep) << "two of them may stop so far apart, and no more";
  confirm_all(first);
  EXPECT_EQ(step(milliseconds(3020)), *first + LeaseBook::kStep);
  confirm_all(*first + LeaseBook::kStep);
  EXPECT_EQ(step(milliseconds(3030)), *first + 2 * LeaseBook::kStep) << "at once, to catch up";
}

TEST_F(Leases, GrowBySoMuchThatTheyGrowFasterThanTimeWhereWordsAreLate) {
  auto lease = *step(milliseconds(0));
  Duration at = milliseconds(2000);
  ASSERT_EQ(step(at), lease);
  const auto grown = [&](Duration took) {
    confirm_all(lease);
    const auto next = *step(at += took);
    return next - std::exchange(lease, next);
  };
  EXPECT_EQ(grown(milliseconds(150)), LeaseBook::kStep) << "a silence is no late word";
  EXPECT_EQ(grown(milliseconds(150)), milliseconds(300));
  EXPECT_EQ(grown(milliseconds(180)), milliseconds(360));
  EXPECT_EQ(grown(milliseconds(400)), LeaseBook::kReach) << "and not by twice as much";
  EXPECT_EQ(grown(milliseconds(20)), LeaseBook::kStep);
}

TEST_F(Leases, AreNotForThoseToConfirmWhoFlyNothing) {
  const auto first = step(milliseconds(0));
  now_ = kBegin + seconds(1);
  confirm(1, first);
  EXPECT_EQ(book_.step(local(), now_, silence_, {1}, fleet_), *first + LeaseBook::kStep);
}

TEST_F(Leases, TakenOverAreWhatTheSwarmHas) {
  book_ = LeaseBook(kBegin + seconds(3));
  EXPECT_EQ(step(milliseconds(0)), kBegin + seconds(3));
  confirm(1, kBegin + seconds(3));
  confirm(2, kBegin + seconds(2));
  EXPECT_EQ(step(milliseconds(100)), kBegin + seconds(2)) << "nobody waits for a step that is long gone";
  confirm_all(kBegin + seconds(2));
  EXPECT_EQ(step(milliseconds(200)), kBegin + seconds(3) + Duration(1))
      << "who knows of that one confirms nothing by it";
}

TEST_F(Leases, AreNotOfASwarmThatFliesOn) {
  EXPECT_TRUE(step(milliseconds(0)));
  silence_.stop_after.reset();
  EXPECT_FALSE(step(milliseconds(100)));
  confirm_all(std::nullopt);
  EXPECT_FALSE(step(milliseconds(200)));
}

TEST_F(Leases, ThatBecomeShorterGoBackAtOnceOrStand) {
  confirm_all(step(milliseconds(0)));
  silence_.stop_after = seconds(2);
  // What was promised stays promised, and no more is until it is within what is now to be.
  for (int at_ms = 100; at_ms < 3000; at_ms += 100) {
    EXPECT_EQ(step(milliseconds(at_ms)), kBegin + seconds(5)) << at_ms;
    confirm_all(kBegin + seconds(5));
  }
  EXPECT_EQ(step(milliseconds(3100)), kBegin + milliseconds(5100));
}

}  // namespace
}  // namespace gyre::coordinator
