// Two agents claim one carrier: it is said, nothing is agreed, and when one of them goes everything works again.

#include <gtest/gtest.h>

#include <set>

#include "coordinator/core/fleet.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::Flying;
using test::job;
using test::says;
using test::SwarmOfAgents;

/// Lives of one carrier that speak ten times a second, each in a word of its own.
class Lives : public testing::Test {
 protected:
  Fleet::Verdict say(std::uint64_t incarnation) {
    protocol::AgentStatus status;
    status.carrier = 1;
    status.incarnation = incarnation;
    status.sequence = ++sequences_[incarnation];
    status.address = address(incarnation);
    if (with_course_.count(incarnation) > 0) status.course.base.number = {1, 1};
    return fleet_.take(now_, status);
  }
  /// Each of them is heard, one after the other; the last verdict on each.
  std::map<std::uint64_t, Fleet::Verdict> speak(const std::vector<std::uint64_t>& incarnations, Duration duration) {
    std::map<std::uint64_t, Fleet::Verdict> verdicts;
    for (const LocalTime end = now_ + duration; now_ < end; now_ += milliseconds(70)) {
      for (const std::uint64_t incarnation : incarnations) {
        now_ += milliseconds(10);
        verdicts[incarnation] = say(incarnation);
      }
    }
    return verdicts;
  }
  [[nodiscard]] static std::string address(std::uint64_t incarnation) { return "at " + std::to_string(incarnation); }
  void vehicle_follows(std::uint64_t incarnation) {
    protocol::CarrierState state;
    state.carrier = 1;
    state.follows = incarnation;
    EXPECT_TRUE(fleet_.believes(now_, state));
  }
  [[nodiscard]] bool claimed_twice() const { return !fleet_.claimed_twice(now_).empty(); }
  [[nodiscard]] std::uint64_t believed() const { return fleet_.status(1)->incarnation; }

  LocalTime now_{std::chrono::hours(1)};
  Fleet fleet_{{1, 2}, milliseconds(450)};
  std::map<std::uint64_t, std::uint64_t> sequences_;
  std::set<std::uint64_t> with_course_;
};

constexpr std::uint64_t kA = 11, kB = 7, kC = 23;

TEST_F(Lives, OfACarrierFollowOneAnother) {
  speak({kA}, seconds(2));
  // A dies; B starts at once, and is believed as soon as A is known to be silent.
  const LocalTime died = now_;
  while (believed() == kA) {
    speak({kB}, milliseconds(10));
    EXPECT_FALSE(claimed_twice());
    ASSERT_LT(now_ - died, milliseconds(600));
  }
  EXPECT_EQ(speak({kB}, seconds(2)).at(kB), Fleet::Verdict::kTaken);
  EXPECT_FALSE(claimed_twice());
}

TEST_F(Lives, ThatBothSpeakClaimItTwiceAndTheFirstIsBelieved) {
  speak({kA}, seconds(2));
  const auto verdicts = speak({kA, kB}, seconds(1));
  EXPECT_EQ(verdicts.at(kA), Fleet::Verdict::kTaken);
  EXPECT_EQ(verdicts.at(kB), Fleet::Verdict::kRival);
  EXPECT_TRUE(claimed_twice());
  speak({kB, kA}, seconds(30));
  EXPECT_TRUE(claimed_twice());
  EXPECT_EQ(believed(), kA);
}

TEST_F(Lives, OfWhichTheNewcomerGoesAreOneAgain) {
  speak({kA}, seconds(2));
  speak({kA, kB}, seconds(2));
  ASSERT_TRUE(claimed_twice());
  speak({kA}, milliseconds(1200));
  EXPECT_FALSE(claimed_twice());
  EXPECT_EQ(believed(), kA);
}

TEST_F(Lives, OfWhichTheFirstGoesAreOneAgain) {
  speak({kA}, seconds(2));
  speak({kA, kB}, seconds(2));
  ASSERT_TRUE(claimed_twice());
  speak({kB}, milliseconds(600));
  EXPECT_FALSE(claimed_twice());
  EXPECT_EQ(believed(), kB);
  // And back again.
  speak({kA, kB}, seconds(1));
  EXPECT_EQ(believed(), kB);
  EXPECT_TRUE(claimed_twice());
  speak({kA}, milliseconds(1600));
  EXPECT_EQ(believed(), kA);
  EXPECT_FALSE(claimed_twice());
}

TEST_F(Lives, ThatAreThreeClaimItTwiceAsWell) {
  speak({kA}, seconds(2));
  speak({kA, kB, kC}, seconds(2));
  EXPECT_TRUE(claimed_twice());
  EXPECT_EQ(believed(), kA);
  speak({kB, kC}, seconds(2));
  EXPECT_NE(believed(), kA);
  EXPECT_TRUE(claimed_twice());
  speak({kC}, seconds(2));
  EXPECT_EQ(believed(), kC);
  EXPECT_FALSE(claimed_twice());
}

TEST_F(Lives, ThatFollowOneAnotherAreNotDisturbedByALateWordOfTheFirst) {
  speak({kA}, seconds(2));
  speak({kB}, seconds(2));
  ASSERT_EQ(believed(), kB);
  EXPECT_EQ(say(kA), Fleet::Verdict::kRival) << "it was on its way for two seconds";
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(speak({kB}, milliseconds(50)).at(kB), Fleet::Verdict::kTaken);
    EXPECT_FALSE(claimed_twice()) << "one word is no life";
  }
  speak({kC}, seconds(1));
  ASSERT_EQ(believed(), kC);
  EXPECT_EQ(say(kA), Fleet::Verdict::kRival);
  EXPECT_EQ(say(kB), Fleet::Verdict::kRival);
  speak({kC}, seconds(1));
  EXPECT_EQ(believed(), kC);
  EXPECT_FALSE(claimed_twice());
}

TEST_F(Lives, AreToldWhoIsBelievedAndWhereTheOtherIs) {
  EXPECT_EQ(fleet_.standing(now_, 1, kA).believed, 0U);
  speak({kA}, seconds(2));
  EXPECT_EQ(fleet_.standing(now_, 1, kA).believed, kA);
  EXPECT_EQ(fleet_.standing(now_, 1, kA).rival, "");
  // A newcomer asks for the time before it has said anything.
  fleet_.heard(now_, 1, kB);
  EXPECT_EQ(fleet_.standing(now_, 1, kB).believed, kA);
  EXPECT_EQ(fleet_.standing(now_, 1, kB).rival, address(kA));
  EXPECT_EQ(fleet_.standing(now_, 1, kA).rival, "") << "it may have been the last word of a dead one";
  speak({kA, kB}, milliseconds(500));
  EXPECT_EQ(fleet_.standing(now_, 1, kA).rival, address(kB));
  ASSERT_EQ(fleet_.claimed_twice(now_).size(), 1U);
  EXPECT_EQ(fleet_.claimed_twice(now_).front().believed, address(kA));
  EXPECT_EQ(fleet_.claimed_twice(now_).front().rival, address(kB));
}

TEST_F(Lives, OfWhichOneIsFollowedByTheVehicleThatOneIsBelieved) {
  // A coordinator that starts anew hears the newcomer first.
  speak({kB}, seconds(1));
  vehicle_follows(kA);
  const auto verdicts = speak({kB, kA}, milliseconds(200));
  EXPECT_EQ(believed(), kA);
  EXPECT_EQ(verdicts.at(kB), Fleet::Verdict::kRival);
  vehicle_follows(kA);
  speak({kA, kB}, milliseconds(200));
  EXPECT_EQ(believed(), kA);
}

TEST_F(Lives, OfWhichOneHasACourseThatOneIsBelieved) {
  speak({kB}, seconds(1));
  with_course_ = {kA};
  speak({kB, kA}, milliseconds(200));
  EXPECT_EQ(believed(), kA);
  with_course_ = {kA, kB};
  speak({kA, kB}, seconds(1));
  EXPECT_EQ(believed(), kA);
}

TEST_F(Lives, AVehicleThatSpeaksBesideTheFirstTellsNothing) {
  speak({kA}, seconds(1));
  vehicle_follows(kA);
  protocol::CarrierState state;
  state.carrier = 1;
  state.incarnation = 5;
  state.follows = kB;
  EXPECT_FALSE(fleet_.believes(now_, state));
  speak({kA, kB}, milliseconds(200));
  EXPECT_EQ(believed(), kA);
  EXPECT_TRUE(fleet_.told_twice(now_).empty());
  vehicle_follows(kA);
  now_ += milliseconds(300);
  EXPECT_FALSE(fleet_.believes(now_, state));
  EXPECT_TRUE(fleet_.told_twice(now_).empty()) << "the first one was not heard since";
  vehicle_follows(kA);
  EXPECT_EQ(fleet_.told_twice(now_), std::vector<CarrierId>{1});
}

TEST(ClaimedTwice, IsComplainedOfAndKeepsAFlightFromBeginning) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  swarm.start_twin(2);
  swarm.fly(seconds(1));
  const std::string words = "carrier 2: two agents claim it, agent 2, which is believed, and agent 5; end one of them";
  EXPECT_EQ(swarm.coordinator().complaint(swarm.now).value_or("none"), words);
  EXPECT_EQ(swarm.agent(2).complaint(swarm.now).value_or("none"),
            "another agent claims this carrier, at agent 5; end one of the two");
  EXPECT_EQ(swarm.twin(2).complaint(swarm.now).value_or("none"),
            "another agent flies this carrier, at agent 2; end one of the two");
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(1)), words));
  EXPECT_TRUE(swarm.rests());
  swarm.stop_twin(2);
  swarm.fly(milliseconds(1200));
  EXPECT_EQ(swarm.coordinator().complaint(swarm.now).value_or("none"), "none");
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(ClaimedTwice, IsOverWhenTheFirstGoesAsWell) {
  Flying swarm;
  swarm.start_twin(2);
  swarm.fly(seconds(2));
  ASSERT_TRUE(says(swarm.coordinator().complaint(swarm.now).value_or("none"), "two agents claim it"));
  EXPECT_EQ(swarm.pace(), 1.0) << "the first is believed, and flies";
  EXPECT_TRUE(says(swarm.pace(0.5), "done")) << "and does as it is told";
  EXPECT_EQ(swarm.pace(), 0.5);
  EXPECT_EQ(swarm.twin_setpoints, 0) << "the other one sends nothing";
  swarm.stop_agent(2);
  swarm.fly(seconds(2));
  EXPECT_EQ(swarm.coordinator().complaint(swarm.now).value_or("none"), "none");
  EXPECT_EQ(swarm.pace(), 0.5) << swarm.news;
  EXPECT_GT(swarm.twin_setpoints, 100) << "and now it flies the carrier";
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  EXPECT_TRUE(swarm.rests());
}

TEST(ClaimedTwice, IsAnsweredByACoordinatorThatStartsAnewAsBefore) {
  Flying swarm;
  swarm.start_twin(2);
  swarm.fly(seconds(2));
  swarm.stop_coordinator();
  swarm.fly(milliseconds(500));
  swarm.start_coordinator();
  swarm.fly(seconds(3));
  EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
  EXPECT_EQ(swarm.twin_setpoints, 0);
  EXPECT_TRUE(says(swarm.coordinator().complaint(swarm.now).value_or("none"), "agent 2, which is believed"));
}

}  // namespace
}  // namespace gyre::coordinator
