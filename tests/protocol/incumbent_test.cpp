// Of several who claim one place one is believed, and when it goes another.

#include "common/protocol/incumbent.hpp"

#include <gtest/gtest.h>

#include <map>

namespace gyre::protocol {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Verdict = Incumbent::Verdict;

constexpr std::uint64_t kA = 11, kB = 7, kC = 23;

class Lives : public testing::Test {
 protected:
  /// Each of them is heard, one after the other; the last verdict on each.
  std::map<std::uint64_t, Verdict> speak(const std::vector<std::uint64_t>& lives, Duration duration) {
    std::map<std::uint64_t, Verdict> verdicts;
    for (const LocalTime end = now_ + duration; now_ < end; now_ += milliseconds(10)) {
      for (const std::uint64_t who : lives) verdicts[who] = incumbent_.hear(now_, who);
    }
    return verdicts;
  }

  LocalTime now_{-std::chrono::hours(1)};
  Incumbent incumbent_{milliseconds(250)};
};

TEST_F(Lives, BeginWithNobody) {
  EXPECT_FALSE(incumbent_.who());
  EXPECT_TRUE(incumbent_.silent(now_));
  EXPECT_FALSE(incumbent_.rival(now_));
  EXPECT_EQ(incumbent_.hear(now_, kA), Verdict::kSucceeds);
  EXPECT_EQ(incumbent_.hear(now_, kA), Verdict::kBelieved);
}

TEST_F(Lives, OfWhichTheFirstIsBelievedHoweverLongTheOtherSpeaks) {
  speak({kA}, seconds(1));
  for (const auto& order : {std::vector{kB, kA}, std::vector{kA, kB}}) {
    const auto verdicts = speak(order, seconds(30));
    EXPECT_EQ(verdicts.at(kA), Verdict::kBelieved);
    EXPECT_EQ(verdicts.at(kB), Verdict::kRival);
    EXPECT_EQ(incumbent_.rival(now_), kB);
    EXPECT_TRUE(incumbent_.contested(now_));
  }
}

TEST_F(Lives, SucceedOneAnotherWhenOneIsSilentAndNoSooner) {
  speak({kA}, seconds(1));
  const LocalTime last = now_ - milliseconds(10);
  EXPECT_EQ(speak({kB}, milliseconds(300)).at(kB), Verdict::kRival);
  EXPECT_EQ(incumbent_.hear(last + milliseconds(310), kB), Verdict::kSucceeds);
  EXPECT_EQ(incumbent_.who(), kB);
  EXPECT_FALSE(incumbent_.rival(now_));
}

TEST_F(Lives, WhoHungDoesNotBelieveWhoeverSpeaksFirst) {
  speak({kA}, seconds(1));
  speak({kA, kB}, seconds(1));
  now_ += seconds(10);
  EXPECT_EQ(speak({kB}, milliseconds(200)).at(kB), Verdict::kRival);
  EXPECT_EQ(speak({kA, kB}, seconds(1)).at(kB), Verdict::kRival);
  // And again: what was counted before does not count.
  now_ += seconds(10);
  EXPECT_EQ(speak({kB}, milliseconds(200)).at(kB), Verdict::kRival);
  EXPECT_EQ(speak({kB}, milliseconds(200)).at(kB), Verdict::kBelieved) << "it succeeded meanwhile";
}

TEST_F(Lives, OfSetpointsAreSucceededAtOnceWhenOneIsSilent) {
  Incumbent setpoints(milliseconds(250), Duration::zero());
  EXPECT_EQ(setpoints.hear(now_, kA), Verdict::kSucceeds);
  EXPECT_EQ(setpoints.hear(now_ + milliseconds(250), kB), Verdict::kRival);
  EXPECT_EQ(setpoints.hear(now_ + milliseconds(251), kB), Verdict::kSucceeds);
}

TEST_F(Lives, ARivalThatGoesIsForgotten) {
  speak({kA}, seconds(1));
  speak({kA, kB}, seconds(1));
  speak({kA}, Incumbent::kGone + milliseconds(20));
  EXPECT_FALSE(incumbent_.rival(now_));
  EXPECT_FALSE(incumbent_.contested(now_));
}

TEST_F(Lives, OneLateWordIsARivalAndNoContest) {
  speak({kB}, seconds(1));
  speak({kC}, seconds(1));
  EXPECT_EQ(incumbent_.hear(now_, kB), Verdict::kRival);
  for (int i = 0; i < 20; ++i) {
    speak({kC}, milliseconds(50));
    EXPECT_FALSE(incumbent_.contested(now_));
  }
}

TEST_F(Lives, ThatArePreferredTakeOverAtOnce) {
  speak({kA}, seconds(1));
  speak({kA, kB}, seconds(1));
  EXPECT_EQ(incumbent_.hear(now_, kB, true), Verdict::kSucceeds);
  EXPECT_EQ(incumbent_.hear(now_, kA), Verdict::kRival);
  EXPECT_EQ(incumbent_.who(), kB);
}

}  // namespace
}  // namespace gyre::protocol
