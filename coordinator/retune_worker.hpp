#pragma once
// Reads and judges the missions of retunes on a thread of its own: the one that beats never waits for it.
//
// One at a time. Whoever asks for another meanwhile is told to try again; whoever repeats himself, as everybody does
// until he is answered, is told once.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "coordinator/core/job.hpp"

namespace gyre::coordinator {

class RetuneWorker {
 public:
  using Judge = std::function<Result<Job>(const std::string& mission)>;
  using Sink = std::function<void(Retune)>;  ///< called from this thread and from those that ask

  RetuneWorker(Judge judge, Sink sink)
      : judge_(std::move(judge)), sink_(std::move(sink)), thread_([this] { work(); }) {}
  RetuneWorker(const RetuneWorker&) = delete;
  RetuneWorker& operator=(const RetuneWorker&) = delete;
  ~RetuneWorker() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ending_ = true;
    }
    asked_.notify_one();
    thread_.join();
  }

  void ask(const protocol::Command& command) {
    std::optional<Retune> known;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (under_way_ && under_way_->id == command.id) return;
      if (under_way_) {
        known = Retune{command.id, Error{"another retune is being judged; try again"}};
      } else if (last_ && last_->command == command.id) {
        known = last_;  // its answer was lost: the core gives it again
      } else {
        under_way_ = command;
      }
    }
    if (known) return sink_(*std::move(known));
    asked_.notify_one();
  }

 private:
  void work() {
    for (std::unique_lock<std::mutex> lock(mutex_);;) {
      asked_.wait(lock, [this] { return ending_ || under_way_; });
      if (ending_) return;
      const protocol::Command command = *under_way_;
      lock.unlock();
      const Retune retune{command.id, judge_(command.mission)};
      sink_(retune);
      lock.lock();
      last_ = retune;
      under_way_.reset();
    }
  }

  Judge judge_;
  Sink sink_;
  std::mutex mutex_;
  std::condition_variable asked_;
  std::optional<protocol::Command> under_way_;
  std::optional<Retune> last_;
  bool ending_ = false;
  std::thread thread_;  // begins when all that it uses is there
};

}  // namespace gyre::coordinator
