// What is believed of counters that others tell: no leap that stands alone, and every leap that others confirm.

#include "common/protocol/counting.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace gyre::protocol {
namespace {

constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
using Verdict = SequenceJudge::Verdict;

SequenceJudge heard_up_to(std::uint64_t last) {
  SequenceJudge judge;
  EXPECT_EQ(judge.take(last), Verdict::kNew);
  return judge;
}

TEST(SequenceJudge, TakesWhatFollowsAndTellsTheRestApart) {
  SequenceJudge judge = heard_up_to(7);
  EXPECT_EQ(judge.take(8), Verdict::kNew);
  EXPECT_EQ(judge.take(8), Verdict::kDuplicate);
  EXPECT_EQ(judge.take(6), Verdict::kLate);
  EXPECT_EQ(judge.take(8 + SequenceJudge::kFurthest), Verdict::kNew);
}

TEST(SequenceJudge, IsNotMadeDeafByALeap) {
  for (const std::uint64_t leap : {kLargest, kMostCounted, std::uint64_t{1000}}) {
    SequenceJudge judge = heard_up_to(7);
    for (std::uint64_t honest = 8; honest < 50; ++honest) {
      EXPECT_EQ(judge.take(leap), Verdict::kLeap) << "however often it is said, nothing follows on it";
      EXPECT_EQ(judge.take(honest), Verdict::kNew);
    }
  }
  SequenceJudge judge = heard_up_to(7);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(judge.take(kLargest), Verdict::kLeap);
}

TEST(SequenceJudge, HearsAgainAfterANight) {
  SequenceJudge judge = heard_up_to(7);
  const std::uint64_t morning = 8 * 3600 * 50;
  EXPECT_EQ(judge.take(morning), Verdict::kLeap);
  EXPECT_EQ(judge.take(morning), Verdict::kLeap) << "the same twice is one witness";
  EXPECT_EQ(judge.take(morning + 3), Verdict::kLeap);
  EXPECT_EQ(judge.take(morning + 4), Verdict::kNew);
  EXPECT_EQ(judge.take(morning + 5), Verdict::kNew);
}

TEST(SequenceJudge, HearsAgainAfterALieThatCameFirst) {
  SequenceJudge judge = heard_up_to(kLargest);
  for (std::uint64_t i = 1; i < SequenceJudge::kBehind; ++i) EXPECT_EQ(judge.take(i), Verdict::kLate);
  EXPECT_EQ(judge.take(SequenceJudge::kBehind), Verdict::kNew);
  EXPECT_EQ(judge.take(SequenceJudge::kBehind + 1), Verdict::kNew);
}

TEST(SequenceJudge, IsNotTakenBackByLateOnesAmongNewOnes) {
  SequenceJudge judge = heard_up_to(500);
  for (std::uint64_t i = 1; i < 100; ++i) {
    EXPECT_EQ(judge.take(400 + i), Verdict::kLate);
    if (i % 5 == 0) {
      EXPECT_EQ(judge.take(500 + i), Verdict::kNew);
    }
  }
}

TEST(TermJudge, BelievesNoGenerationThatIsFarAndSaidOnce) {
  const std::uint64_t known = next_term(0, 1);
  TermJudge judge;
  EXPECT_TRUE(judge.believes(known, next_term(known, 2)));
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(judge.believes(known, kLargest)) << "nobody has counted so far";
  const std::uint64_t far = std::uint64_t{1000} << kTermNonceBits;
  EXPECT_FALSE(judge.believes(known, far));
  EXPECT_FALSE(judge.believes(known, 2 * far)) << "no witness of the one before";
  EXPECT_FALSE(judge.believes(known, far));
  EXPECT_FALSE(judge.believes(known, far + 1));
  EXPECT_TRUE(judge.believes(known, next_term(far, 5))) << "somebody who was away is told by more than one";
}

TEST(TermJudge, BelievesNoLeapFromWhichNobodyCouldCountOn) {
  TermJudge judge;
  std::uint64_t term = kMostLeapt;
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(judge.believes(next_term(0, 1), term));
  ASSERT_TRUE(judge.believes(next_term(0, 1), term));
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t next = next_term(term, kLargest);
    EXPECT_TRUE(counted(next) && judge.believes(term, next));
    term = next;
  }
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(judge.believes(next_term(0, 1), kMostCounted));
}

TEST(LeapJudge, BelievesNoLeapFromWhichNobodyCouldCountOn) {
  LeapJudge judge(100);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(judge.believes(7, kMostLeapt + 1));
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(judge.believes(7, kMostLeapt));
  EXPECT_TRUE(judge.believes(7, kMostLeapt));
  EXPECT_TRUE(judge.believes(kMostLeapt, kMostLeapt + 1)) << "it is counted on from";
}

}  // namespace
}  // namespace gyre::protocol
