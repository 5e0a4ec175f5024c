// Between the one loop that makes what is seen and the connections that carry it away: nobody is sent what is old, and
// nobody is waited for.

#include "ground/page/stage.hpp"

#include <gmock/gmock.h>

#include <thread>

namespace gyre::ground {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string news(Stage& stage, Stage::Cursor& cursor) {
  return stage.next(cursor, Duration::zero()).value_or("closed");
}

TEST(Stage, ANewConnectionGetsAllScenesInOrderAndThenWhatHappened) {
  Stage stage;
  stage.happen("{\"number\":1}");
  stage.show(Scene::kFrame, "{\"f\":1}");
  stage.show(Scene::kStatus, "{\"s\":1}");
  stage.show(Scene::kHello, "{\"h\":1}");
  stage.show(Scene::kMission, "{\"m\":1}");
  Stage::Cursor cursor;
  EXPECT_EQ(news(stage, cursor),
            "event: hello\ndata: {\"h\":1}\n\nevent: mission\ndata: {\"m\":1}\n\nevent: status\ndata: {\"s\":1}\n\n"
            "event: frame\ndata: {\"f\":1}\n\nevent: happening\ndata: {\"number\":1}\n\n");
  EXPECT_EQ(news(stage, cursor), "");
}

TEST(Stage, OnlyTheNewestOfAScene) {
  Stage stage;
  Stage::Cursor slow, quick;
  for (int i = 0; i < 1000; ++i) {
    stage.show(Scene::kFrame, std::to_string(i));
    EXPECT_EQ(news(stage, quick), "event: frame\ndata: " + std::to_string(i) + "\n\n");
  }
  EXPECT_EQ(news(stage, slow), "event: frame\ndata: 999\n\n");
  stage.show(Scene::kStatus, "s");
  EXPECT_EQ(news(stage, slow), "event: status\ndata: s\n\n") << "what did not change is not sent again";
}

TEST(Stage, OfWhatHappenedASlowReaderGetsEveryLineThatIsStillKept) {
  Stage stage;
  Stage::Cursor cursor;
  for (int i = 1; i <= 5; ++i) stage.happen("<" + std::to_string(i) + ">");
  EXPECT_THAT(news(stage, cursor), testing::AllOf(HasSubstr("<1>"), HasSubstr("<5>")));
  for (int i = 6; i <= 1000; ++i) stage.happen("<" + std::to_string(i) + ">");
  const std::string late = news(stage, cursor);
  EXPECT_THAT(late, testing::AllOf(HasSubstr("<1000>"), HasSubstr("<801>"), Not(HasSubstr("<800>"))));
  EXPECT_EQ(news(stage, cursor), "");
  stage.happen("<1001>");
  EXPECT_EQ(news(stage, cursor), "event: happening\ndata: <1001>\n\n");
}

TEST(Stage, ClosingSendsEverybodyAwayWhoeverWaits) {
  Stage stage;
  stage.show(Scene::kHello, "h");
  std::optional<std::string> last = "still waiting";
  std::thread watcher([&] {
    Stage::Cursor cursor;
    while ((last = stage.next(cursor, std::chrono::minutes(5)))) {
    }
  });
  stage.close();
  watcher.join();
  EXPECT_FALSE(last);
  Stage::Cursor cursor;
  EXPECT_FALSE(stage.next(cursor, std::chrono::minutes(5))) << "there is something to see, and it is over";
}

TEST(Stage, WhoWaitsIsWokenByNews) {
  Stage stage;
  std::string got;
  std::thread watcher([&] {
    Stage::Cursor cursor;
    got = stage.next(cursor, std::chrono::minutes(5)).value_or("closed");
  });
  stage.show(Scene::kFrame, "f");
  watcher.join();
  EXPECT_EQ(got, "event: frame\ndata: f\n\n");
}

TEST(Stage, SoManyLookAndNoMore) {
  Stage stage;
  EXPECT_EQ(stage.watchers(), 0);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(stage.enter(3));
  EXPECT_FALSE(stage.enter(3));
  EXPECT_EQ(stage.watchers(), 3);
  stage.leave();
  EXPECT_TRUE(stage.enter(3));
  EXPECT_FALSE(stage.enter(3));
}

}  // namespace
}  // namespace gyre::ground
