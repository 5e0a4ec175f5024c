#pragma once
// Does what takes longer than a beat on a thread of its own: the one that beats gives it a task, and asks at every beat
// whether there is an answer.
//
// One task at a time, and nothing waits in it: what else there is to do, and what of it still matters by then, is known
// to who gives the tasks. A task that was begun is not interrupted. Nobody waits for it either, not even who ends: the
// thread goes with the process, and the work has to own what it uses.

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace gyre::program {

template <class Task, class Answer>
class Worker {
 public:
  explicit Worker(std::function<Answer(const Task&)> work) : desk_(std::make_shared<Desk>()) {
    std::thread([desk = desk_, work = std::move(work)] { run(*desk, work); }).detach();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    {
      const std::lock_guard<std::mutex> lock(desk_->mutex);
      desk_->closed = true;
    }
    desk_->changed.notify_one();
  }

  /// Returns at once. False, and nothing happens, until the answer to the last task was taken.
  [[nodiscard]] bool begin(Task task) {
    {
      const std::lock_guard<std::mutex> lock(desk_->mutex);
      if (desk_->task || desk_->answer) return false;
      desk_->task = std::move(task);
    }
    desk_->changed.notify_one();
    return true;
  }

  /// Takes the answer, once there is one.
  [[nodiscard]] std::optional<Answer> finished() {
    const std::lock_guard<std::mutex> lock(desk_->mutex);
    return std::exchange(desk_->answer, std::nullopt);
  }

 private:
  struct Desk {
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Task> task;  ///< until it is done
    std::optional<Answer> answer;
    bool closed = false;
  };

  static void run(Desk& desk, const std::function<Answer(const Task&)>& work) {
    for (std::unique_lock<std::mutex> lock(desk.mutex);;) {
      desk.changed.wait(lock, [&desk] { return desk.closed || desk.task; });
      if (desk.closed) return;
      lock.unlock();
      Answer answer = work(*desk.task);  // nobody else touches a task that was begun
      lock.lock();
      desk.answer = std::move(answer);
      desk.task.reset();
    }
  }

  std::shared_ptr<Desk> desk_;  ///< shared with the thread
};

}  // namespace gyre::program
