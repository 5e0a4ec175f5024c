// What goes onto the page's stage, and when.

#include "ground/page/page_feed.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "tests/ground/heard_swarm.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

class PageFeedTest : public testing::Test {
 protected:
  void hear_all() {
    for (const SwarmMessage& message : swarm_.all()) {
      if (view_.step(swarm_.now, message)) feed_.hear(swarm_.now, message);
    }
  }
  void turn() {
    swarm_.pass(milliseconds(40));
    hear_all();
    feed_.step(swarm_.now, {});
  }
  /// Reading a mission takes as long as it takes: beside this thread.
  template <class Condition>
  bool turns_until(Condition holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      if (holds()) return true;
      turn();
      std::this_thread::yield();
    }
    return false;
  }
  std::string news() { return stage_.next(cursor_, Duration::zero()).value_or("closed"); }

  test::HeardSwarm swarm_{3};
  SwarmView view_;
  Stage stage_;
  Stage::Cursor cursor_;
  PageFeed feed_{view_, stage_, {"server", 7, true, false, ""}, swarm_.now};
};

TEST_F(PageFeedTest, WhileNobodyLooksNothingMovesButWhatHappenedIsKept) {
  for (int i = 0; i < 20; ++i) turn();
  std::string shown = news();
  EXPECT_THAT(shown, testing::AllOf(HasSubstr("event: hello"), HasSubstr("event: happening"), HasSubstr("is here")));
  EXPECT_THAT(shown, testing::AllOf(Not(HasSubstr("event: frame")), Not(HasSubstr("event: status"))));
  ASSERT_TRUE(stage_.enter(1));
  for (int i = 0; i < 20; ++i) turn();
  shown = news();
  EXPECT_THAT(shown, testing::AllOf(HasSubstr("event: frame"), HasSubstr("event: status"), Not(HasSubstr("hello"))));
}

TEST_F(PageFeedTest, AMissionIsReadOnceItIsToldAndForgottenWhenAnotherOneIsTooLongToBeTold) {
  EXPECT_FALSE(feed_.mission());
  ASSERT_TRUE(turns_until([&] { return feed_.mission().has_value(); }));
  EXPECT_EQ(feed_.mission()->mission.name, "polygon");
  EXPECT_TRUE(turns_until([&] { return news().find("\"complete\":true") != std::string::npos; }));
  swarm_.text.plan.revision = swarm_.status.plan.revision = 9;
  swarm_.text.text.clear();
  EXPECT_TRUE(turns_until([&] { return !feed_.mission(); }));
  EXPECT_TRUE(turns_until([&] { return news().find("\"complete\":false") != std::string::npos; }));
}

TEST_F(PageFeedTest, FiguresComeOnceASecond) {
  int texts = 0;
  for (int i = 0; i < 100; ++i) {  // four seconds, and one at the beginning
    turn();
    const auto text = feed_.take_metrics();
    if (!text) continue;
    ++texts;
    EXPECT_THAT(*text, HasSubstr("gyre_calm "));
  }
  EXPECT_EQ(texts, 5);
}

TEST_F(PageFeedTest, AHurtIsALineOfTheLog) {
  turn();
  (void)news();
  feed_.hurt(swarm_.now, "agent 3 was killed");
  turn();
  EXPECT_THAT(news(), testing::AllOf(HasSubstr("\"who\":\"a person\""), HasSubstr("agent 3 was killed")));
}

}  // namespace
}  // namespace gyre::ground
