// The coordinator's parts, each by itself: who is there, and what they ask.

#include <gtest/gtest.h>

#include "coordinator/core/command_desk.hpp"
#include "coordinator/core/fleet.hpp"
#include "coordinator/core/time_consensus.hpp"

namespace gyre::coordinator {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr LocalTime kNow{std::chrono::hours(1)};

protocol::AgentStatus status(CarrierId carrier, std::uint64_t sequence, std::uint64_t incarnation = 1) {
  protocol::AgentStatus s;
  s.carrier = carrier;
  s.sequence = sequence;
  s.incarnation = incarnation;
  return s;
}

protocol::AgentStatus told(CarrierId carrier, SwarmTime time) {
  protocol::AgentStatus s = status(carrier, 1);
  s.swarm_time = time;
  s.course.base.number = {1, 1};
  return s;
}

// Heard at two beats of the coordinator, one or two of them at each.
TEST(TimeConsensus, BelievesWhoTellsTheSameOtherTimeAgainAndAgain) {
  const std::vector<CarrierId> carriers{1, 2, 3};
  for (const Duration period : {milliseconds(25), milliseconds(100)}) {
    TimeConsensus consensus;
    std::optional<Duration> correction;
    for (int i = 0; i < 3; ++i) {
      for (const CarrierId id : {1U, 2U}) {
        EXPECT_FALSE(correction) << "not before the third word of more than half";
        const SwarmTime sent(seconds(100) + i * period);
        const Duration beat = milliseconds(20);
        const SwarmTime heard((sent.time_since_epoch() / beat + 1) * beat - seconds(2));
        consensus.take(heard, told(id, sent));
        correction = consensus.correction(carriers);
      }
    }
    ASSERT_TRUE(correction);
    EXPECT_NEAR(gyre::seconds(*correction), 2.0, 0.021);
  }
}

// A change makes agents speak every 25 ms. What they said while this process did not run is heard all at once.
TEST(TimeConsensus, DoesNotBelieveWhatWaitedForAProcessThatDidNotRun) {
  const std::vector<CarrierId> carriers{1, 2, 3};
  for (const Duration period : {milliseconds(25), milliseconds(100)}) {
    TimeConsensus consensus;
    const SwarmTime heard(seconds(100));
    for (Duration ago = milliseconds(600); ago > Duration::zero(); ago -= period) {
      for (const CarrierId id : carriers) {
        consensus.take(heard, told(id, heard - ago));
        EXPECT_FALSE(consensus.correction(carriers));
      }
    }
    EXPECT_FALSE(consensus.doubtful(carriers)) << "the last word is fresh";
  }
}

TEST(Fleet, TellsWhoCameWentAndCameBackAnother) {
  Fleet fleet({1, 2}, milliseconds(450));
  EXPECT_TRUE(fleet.silent(kNow, 1));
  EXPECT_EQ(fleet.take(kNow, status(1, 5)), Fleet::Verdict::kTaken);
  EXPECT_EQ(fleet.take(kNow, status(1, 5)), Fleet::Verdict::kDuplicate);
  EXPECT_EQ(fleet.take(kNow, status(1, 4)), Fleet::Verdict::kLate);
  EXPECT_EQ(fleet.take(kNow, status(3, 1)), Fleet::Verdict::kStranger);
  auto changes = fleet.changes(kNow);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].carrier, 1U);
  EXPECT_FALSE(changes[0].lost);
  EXPECT_TRUE(fleet.changes(kNow + milliseconds(450)).empty());
  changes = fleet.changes(kNow + milliseconds(451));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(changes[0].lost);
  EXPECT_EQ(fleet.take(kNow + milliseconds(700), status(1, 1, 2)), Fleet::Verdict::kRival) << "not yet";
  EXPECT_EQ(fleet.take(kNow + seconds(1), status(1, 2, 2)), Fleet::Verdict::kTaken) << "a new life counts from one";
  changes = fleet.changes(kNow + seconds(1));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(changes[0].restarted);
  EXPECT_EQ(fleet.missing(kNow + seconds(1), [](const auto&) { return true; }), std::vector<CarrierId>{2});
}

TEST(Fleet, TheDeadConfirmNothing) {
  Fleet fleet({1}, milliseconds(450));
  protocol::AgentStatus former = status(1, 7, 1);
  former.confirmed = 4;
  EXPECT_EQ(fleet.take(kNow, former), Fleet::Verdict::kTaken);
  const LocalTime later = kNow + milliseconds(451);
  (void)fleet.take(later - milliseconds(300), status(1, 1, 2));
  EXPECT_EQ(fleet.take(later, status(1, 2, 2)), Fleet::Verdict::kTaken);
  (void)fleet.changes(later);
  ++former.sequence;  // it was on its way for long
  EXPECT_EQ(fleet.take(later, former), Fleet::Verdict::kRival);
  EXPECT_EQ(fleet.status(1)->incarnation, 2U);
  EXPECT_EQ(fleet.status(1)->confirmed, 0U);
  EXPECT_TRUE(fleet.changes(later).empty());
  EXPECT_EQ(fleet.take(later, status(1, 3, 2)), Fleet::Verdict::kTaken);
}

TEST(Fleet, AnySignOfTheLifeThatIsBelievedKeepsItAlive) {
  Fleet fleet({1}, milliseconds(450));
  fleet.heard(kNow, 1, 5);
  EXPECT_TRUE(fleet.silent(kNow, 1)) << "nothing is known of it yet";
  (void)fleet.take(kNow, status(1, 1, 5));
  fleet.heard(kNow + milliseconds(400), 1, 5);
  fleet.heard(kNow + milliseconds(700), 1, 6);
  EXPECT_FALSE(fleet.silent(kNow + milliseconds(850), 1));
  EXPECT_TRUE(fleet.silent(kNow + milliseconds(851), 1)) << "another life is no sign of this one";
}

TEST(CommandDesk, TellsThatAWishIsDoneWhenItIsSafe) {
  CommandDesk desk;
  CommandDesk::Replies replies;
  const protocol::Wish rest{0.0, false, protocol::Wisher::kPerson};
  (void)desk.heard_before(1, replies);
  desk.promise(1, {rest, "at rest", kNow + seconds(1)});
  desk.keep_promises(kNow, rest, "", "nobody knows", replies);
  EXPECT_TRUE(desk.heard_before(1, replies));
  EXPECT_TRUE(replies.empty()) << "not yet";
  desk.keep_promises(kNow + milliseconds(20), rest, "", std::nullopt, replies);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_TRUE(replies[0].done);
  EXPECT_EQ(replies[0].text, "at rest");
  desk.keep_promises(kNow + milliseconds(40), rest, "", std::nullopt, replies);
  EXPECT_EQ(replies.size(), 1U) << "once, unless it is asked for";
}

TEST(CommandDesk, TellsWhyAWishIsNotDone) {
  const protocol::Wish rest{0.0, false, protocol::Wisher::kPerson};
  const protocol::Wish motion{1.0, false, protocol::Wisher::kPerson};
  const protocol::Wish silence{0.0, false, protocol::Wisher::kSilence};
  const auto told = [&](const protocol::Wish& asked, const protocol::Wish& in_force, Duration after) {
    CommandDesk desk;
    CommandDesk::Replies replies;
    (void)desk.heard_before(1, replies);
    desk.promise(1, {asked, "done", kNow + seconds(1)});
    desk.keep_promises(kNow + after, in_force, "the lease ended", "carrier 3 has not said so", replies);
    desk.break_promises("the coordinator ends", replies);
    EXPECT_EQ(replies.size(), 1U);
    EXPECT_FALSE(replies.at(0).done);
    return replies.at(0).text;
  };
  EXPECT_EQ(told(rest, rest, seconds(1)), "not safe yet: carrier 3 has not said so; ask again");
  EXPECT_EQ(told(rest, motion, {}), "overtaken by another command");
  EXPECT_EQ(told(motion, silence, {}), "overtaken: the lease ended");
  EXPECT_EQ(told(rest, rest, {}), "the coordinator ends");
}

TEST(CommandDesk, GivesAnAnswerAgainAndForgetsTheOldest) {
  CommandDesk desk;
  CommandDesk::Replies replies;
  EXPECT_FALSE(desk.heard_before(1, replies));
  EXPECT_TRUE(desk.heard_before(1, replies));
  EXPECT_TRUE(replies.empty()) << "not answered yet";
  desk.answer(1, true, "yes", replies);
  ASSERT_EQ(replies.size(), 1U);
  for (std::uint64_t id = 2; id <= 64; ++id) {
    EXPECT_FALSE(desk.heard_before(id, replies));
    desk.answer(id, false, "no", replies);
  }
  replies.clear();
  EXPECT_TRUE(desk.heard_before(1, replies));
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].id, 1U);
  EXPECT_TRUE(replies[0].done);
  EXPECT_EQ(replies[0].text, "yes");
  EXPECT_FALSE(desk.heard_before(65, replies));
  EXPECT_FALSE(desk.heard_before(1, replies)) << "sixty-four are remembered";
}

}  // namespace
}  // namespace gyre::coordinator
