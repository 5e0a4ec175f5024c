// Words to the coordinator: said again until they are answered, or nobody is patient any more.

#include "ground/swarm/core/order_desk.hpp"

#include <gtest/gtest.h>

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

protocol::Command order(std::uint64_t id) {
  protocol::Command command;
  command.id = id;
  return command;
}
protocol::CommandReply reply(std::uint64_t id, const std::string& text) {
  return {id, true, text};
}

class OrderDeskTest : public testing::Test {
 protected:
  OrderDesk::Outputs step(bool found, Duration passed = milliseconds(10)) {
    now_ += passed;
    return desk_.step(now_, found);
  }
  /// How often it is said until somebody answers or patience is over, and how long that took.
  struct Course {
    int said = 0;
    Duration took{};
    OrderAnswer answer;
  };
  Course until_answered(bool found) {
    Course course;
    for (int i = 0; i < 10'000; ++i) {
      const auto out = step(found);
      course.took += milliseconds(10);
      course.said += static_cast<int>(out.send.size());
      if (out.answers.empty()) continue;
      course.answer = out.answers.front();
      return course;
    }
    ADD_FAILURE() << "no end";
    return course;
  }

  LocalTime now_{seconds(100)};
  OrderDesk desk_;
};

TEST_F(OrderDeskTest, SaysAWordAtOnceAndAgainUntilItIsAnswered) {
  desk_.ask(now_, order(5));
  EXPECT_TRUE(desk_.waits());
  EXPECT_EQ(step(true).send.size(), 1U);
  int again = 0;
  for (int i = 0; i < 100; ++i) {
    const auto out = step(true);
    for (const protocol::Command& command : out.send) EXPECT_EQ(command.id, 5U);
    again += static_cast<int>(out.send.size());
  }
  EXPECT_EQ(again, 4) << "in a second";
  desk_.see(reply(5, "the swarm moves"));
  const auto out = step(true);
  ASSERT_EQ(out.answers.size(), 1U);
  EXPECT_EQ(out.answers[0].command, 5U);
  EXPECT_EQ(out.answers[0].reply->text, "the swarm moves");
  EXPECT_TRUE(out.send.empty());
  EXPECT_FALSE(desk_.waits());
  EXPECT_TRUE(step(true).answers.empty()) << "once";
}

TEST_F(OrderDeskTest, WhoFindsNobodyGivesUpSoonerThanWhoIsNotAnswered) {
  desk_.ask(now_, order(1));
  const Course nobody = until_answered(false);
  EXPECT_FALSE(nobody.answer.found);
  EXPECT_FALSE(nobody.answer.reply);
  EXPECT_EQ(nobody.took, OrderDesk::kPatience + milliseconds(10));
  EXPECT_EQ(nobody.said, 20);
  desk_.ask(now_, order(2));
  const Course silent = until_answered(true);
  EXPECT_TRUE(silent.answer.found);
  EXPECT_FALSE(silent.answer.reply);
  EXPECT_EQ(silent.took, OrderDesk::kPatienceOnceFound + milliseconds(10));
}

TEST_F(OrderDeskTest, OnceFoundIsFound) {
  desk_.ask(now_, order(1));
  (void)step(true);
  const Course gone = until_answered(false);
  EXPECT_TRUE(gone.answer.found);
  EXPECT_GT(gone.took, OrderDesk::kPatience);
}

TEST_F(OrderDeskTest, TwoAtOnceGetEachItsOwnAnswer) {
  desk_.ask(now_, order(1));
  desk_.ask(now_, order(2));
  EXPECT_EQ(step(true).send.size(), 2U);
  desk_.see(reply(3, "of somebody else"));
  desk_.see(reply(2, "two"));
  auto out = step(true);
  ASSERT_EQ(out.answers.size(), 1U);
  EXPECT_EQ(out.answers[0].reply->text, "two");
  EXPECT_TRUE(desk_.waits());
  desk_.see(reply(2, "two again"));
  desk_.see(reply(1, "one"));
  out = step(true);
  ASSERT_EQ(out.answers.size(), 1U);
  EXPECT_EQ(out.answers[0].command, 1U);
  EXPECT_FALSE(desk_.waits());
}

TEST_F(OrderDeskTest, AnAnswerInTimeCountsHoweverLateItIsLookedAt) {
  desk_.ask(now_, order(1));
  (void)step(true);
  desk_.see(reply(1, "done"));
  const auto out = step(true, OrderDesk::kPatienceOnceFound + seconds(1));
  ASSERT_EQ(out.answers.size(), 1U);
  EXPECT_TRUE(out.answers[0].reply);
}

}  // namespace
}  // namespace gyre::ground
