// Missions are judged beside the beat: whoever asks does not wait, one at a time, and nobody is told twice.

#include "coordinator/retune_worker.hpp"

#include <gtest/gtest.h>

#include <future>
#include <vector>

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
  /// The next one that was told.
  Retune told() {
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait(lock, [this] { return !told_.empty(); });
    Retune first = told_.front();
    told_.erase(told_.begin());
    return first;
  }
  std::size_t waiting() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return told_.size();
  }

  std::promise<void> may_end_;
  std::shared_future<void> end_ = may_end_.get_future().share();
  std::promise<void> began_;
  int judged_ = 0;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Retune> told_;
  RetuneWorker worker_{[this](const std::string& mission) -> Result<Job> {
                         if (++judged_ == 1) began_.set_value();
                         end_.wait();
                         return Error{"judged " + mission};
                       },
                       [this](const Retune& retune) {
                         const std::lock_guard<std::mutex> lock(mutex_);
                         told_.push_back(retune);
                         arrived_.notify_all();
                       }};
};

TEST_F(RetuneWorkerTest, WhoeverAsksDoesNotWaitAndAnotherIsToldToTryAgain) {
  worker_.ask(retune(1));  // returns, or this test never ends
  began_.get_future().wait();
  worker_.ask(retune(1));
  EXPECT_EQ(waiting(), 0U) << "repeated, it is still the one that is judged";
  worker_.ask(retune(2));
  const Retune refused = told();
  EXPECT_EQ(refused.command, 2U);
  EXPECT_EQ(refused.job.error().text, "another retune is being judged; try again");
  may_end_.set_value();
  const Retune first = told();
  EXPECT_EQ(first.command, 1U);
  EXPECT_EQ(first.job.error().text, "judged mission 1");
}

TEST_F(RetuneWorkerTest, TheNextOneIsJudgedAndARepeatedOneIsNotAgain) {
  may_end_.set_value();
  worker_.ask(retune(1));
  EXPECT_EQ(told().job.error().text, "judged mission 1");
  // It is free a moment after it told.
  std::uint64_t id = 2;
  worker_.ask(retune(id));
  while (told().job.error().text != "judged mission " + std::to_string(id)) worker_.ask(retune(++id));
  const std::uint64_t last = id;
  std::string again;
  do {
    worker_.ask(retune(last));
    again = waiting() > 0 ? told().job.error().text : "";
  } while (again.empty());
  EXPECT_EQ(again, "judged mission " + std::to_string(last));
  EXPECT_EQ(judged_, 2);
}

}  // namespace
}  // namespace gyre::coordinator
