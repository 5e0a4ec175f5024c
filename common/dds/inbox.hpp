#pragma once
// Where listener threads leave what arrived and the one main loop picks it up.

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "common/dds/clock.hpp"

namespace gyre::dds {

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
    const std::chrono::steady_clock::time_point until = steady_time(deadline);
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_until(lock, until, [this] { return !events_.empty(); });
    return std::exchange(events_, {});
  }

  /// Everything that has arrived by `deadline`, all at once. For loops with a beat of their own: they wake once per
  /// beat and not once per message, which is most of what an idle process costs. Arrival stamps are the listeners'.
  [[nodiscard]] std::deque<Event> sleep_until(LocalTime deadline) {
    std::this_thread::sleep_until(steady_time(deadline));
    const std::lock_guard<std::mutex> lock(mutex_);
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
