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

  /// Everything that has arrived, at the latest at `deadline`; empty then. It stays there until the next call.
  [[nodiscard]] std::deque<Event>& wait_until(LocalTime deadline) {
    const std::chrono::steady_clock::time_point until = steady_time(deadline);
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_until(lock, until, [this] { return !events_.empty(); });
    return take();
  }

  /// Everything that has arrived by `deadline`, all at once. For loops with a beat of their own: they wake once per
  /// beat and not once per message, which is most of what an idle process costs. Arrival stamps are the listeners'.
  [[nodiscard]] std::deque<Event>& sleep_until(LocalTime deadline) {
    using Steady = std::chrono::steady_clock;
    const Steady::time_point due = steady_time(deadline);
    const bool in_time = Steady::now() < due;
    std::this_thread::sleep_until(due);
    late_ = in_time ? Steady::now() - due : Duration{};
    const std::lock_guard<std::mutex> lock(mutex_);
    return take();
  }

  /// How late the last sleep ended: what the machine, or whoever stopped this process, is to blame for. Zero where the
  /// deadline had passed before: a loop that is late by its own work does not sleep. For the thread that sleeps.
  [[nodiscard]] Duration late() const { return late_; }

  [[nodiscard]] std::uint64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  [[nodiscard]] std::deque<Event>& take() {
    taken_.clear();
    events_.swap(taken_);
    return taken_;
  }

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Event> events_;
  std::deque<Event> taken_;  // the two change places: what one beat made room for, the next one fills
  std::uint64_t dropped_ = 0;
  Duration late_{};
};

}  // namespace gyre::dds
