// Missions are judged beside the beat: whoever asks does not wait, one at a time, and nobody is told twice.

#include "coordinator/retune_worker.hpp"

#include <gtest/gtest.h>

#include <future>
#include <thread>

namespace gyre::coordinator {
namespace {

protocol::Command retune(std::uint64_t id) {
  protocol::Command command;
  command.id = id;
  command.kind = protocol::CommandKind::kRetune;
  command.mission = "mission " + std::to_string(id);
  return command;
}

class RetuneWorkerTest : public testing::Test {
 protected:
  /// However long that takes.
  Retune judged() {
    for (;;) {
      if (auto retune = worker_.finished()) return *retune;
      std::this_thread::yield();
    }
  }

  std::promise<void> may_end_;
  std::shared_future<void> end_ = may_end_.get_future().share();
  int judged_ = 0;
  RetuneWorker worker_{[this](const std::string& mission) -> Result<Job> {
    ++judged_;
    end_.wait();
    return Error{"judged " + mission};
  }};
};

TEST_F(RetuneWorkerTest, WhoeverAsksDoesNotWaitAndAnotherIsToldToTryAgain) {
  EXPECT_FALSE(worker_.ask(retune(1)));  // returns, or this test never ends
  EXPECT_FALSE(worker_.ask(retune(1))) << "repeated, it is still the one that is judged";
  const auto refused = worker_.ask(retune(2));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->command, 2U);
  EXPECT_EQ(refused->job.error().text, "another retune is being judged; try again");
  may_end_.set_value();
  const Retune first = judged();
  EXPECT_EQ(first.command, 1U);
  EXPECT_EQ(first.job.error().text, "judged mission 1");
}

TEST_F(RetuneWorkerTest, TheNextOneIsJudgedAndARepeatedOneIsNotAgain) {
  may_end_.set_value();
  for (const std::uint64_t id : {1U, 2U}) {
    EXPECT_FALSE(worker_.ask(retune(id)));
    EXPECT_EQ(judged().job.error().text, "judged mission " + std::to_string(id));
  }
  const auto again = worker_.ask(retune(2));
  ASSERT_TRUE(again) << "its answer was lost";
  EXPECT_EQ(again->job.error().text, "judged mission 2");
  EXPECT_FALSE(worker_.finished());
  EXPECT_EQ(judged_, 2);
}

}  // namespace
}  // namespace gyre::coordinator
