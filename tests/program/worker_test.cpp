// A task is done beside the thread that gave it, one at a time, and its answer is taken once.

#include "common/program/worker.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace gyre::program {
namespace {

class WorkerTest : public testing::Test {
 protected:
  using StringWorker = Worker<std::string, std::string>;

  /// Outlives the worker, as whatever a task uses has to.
  struct Work {
    std::promise<void> may_end;
    std::shared_future<void> end = may_end.get_future().share();
    std::promise<std::thread::id> began;
    std::promise<void> ended;
    int begun = 0;

    std::string operator()(const std::string& task) {
      if (++begun == 1) began.set_value(std::this_thread::get_id());
      end.wait();
      if (begun == 1) ended.set_value();
      return task + " is done";
    }
  };

  /// However long that takes.
  std::string answer() {
    for (;;) {
      if (auto answer = worker_->finished()) return *answer;
      std::this_thread::yield();
    }
  }

  std::shared_ptr<Work> work_ = std::make_shared<Work>();
  std::unique_ptr<StringWorker> worker_ =
      std::make_unique<StringWorker>([work = work_](const std::string& task) { return (*work)(task); });
};

TEST_F(WorkerTest, WhoeverGivesATaskGoesOnMeanwhile) {
  EXPECT_FALSE(worker_->finished());
  ASSERT_TRUE(worker_->begin("first"));  // returns, or this test never ends
  EXPECT_NE(work_->began.get_future().get(), std::this_thread::get_id());
  EXPECT_FALSE(worker_->finished());
  work_->may_end.set_value();
  EXPECT_EQ(answer(), "first is done");
  EXPECT_FALSE(worker_->finished()) << "an answer is taken once";
}

TEST_F(WorkerTest, ItIsFreeWhenItsAnswerIsTakenAndNoSooner) {
  ASSERT_TRUE(worker_->begin("first"));
  EXPECT_FALSE(worker_->begin("second"));
  work_->may_end.set_value();
  work_->ended.get_future().wait();
  EXPECT_FALSE(worker_->begin("third")) << "before the first answer was taken";
  EXPECT_EQ(answer(), "first is done");
  ASSERT_TRUE(worker_->begin("fourth"));
  EXPECT_EQ(answer(), "fourth is done");
  EXPECT_EQ(work_->begun, 2) << "what was turned away was never begun";
}

TEST_F(WorkerTest, NobodyWaitsForItsTaskWhenItEnds) {
  ASSERT_TRUE(worker_->begin("first"));
  work_->began.get_future().wait();
  worker_.reset();  // returns, or this test never ends
  work_->may_end.set_value();
  work_->ended.get_future().wait();
  EXPECT_EQ(work_->begun, 1);
}

}  // namespace
}  // namespace gyre::program
