#pragma once
// Where listener threads leave what arrived and the one main loop picks it up.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>

#include "common/base/time.hpp"

namespace gyre::dds {

/// This process's steady clock. The one place where a main loop reads the time it hands to its core.
[[nodiscard]] inline LocalTime now() {
  return LocalTime(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

/// A bounded queue: when full, the oldest goes, because the newest is what a flight needs. `dropped()` counts them.
template <class Event>
class Inbox {
 public:
  explicit Inbox(std::size_t capacity = 4096) : capacity_(capacity) {}

  void push(Event event) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (events_.size() == capacity_) {
        events_.pop_front();
        ++dropped_;
      }
      events_.push_back(std::move(event));
    }
    arrived_.notify_one();
  }

  /// Everything that has arrived, at the latest at `deadline`; empty then.
  [[nodiscard]] std::deque<Event> wait_until(LocalTime deadline) {
    const std::chrono::steady_clock::time_point until(
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(deadline.time_since_epoch()));
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_until(lock, until, [this] { return !events_.empty(); });
    return std::exchange(events_, {});
  }

  [[nodiscard]] std::uint64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Event> events_;
  std::uint64_t dropped_ = 0;
};

}  // namespace gyre::dds
