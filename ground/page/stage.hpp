#pragma once
// What is to be seen, between the one loop that makes it and the connections that carry it away.
//
// Intuition: a browser that is slow, or whose radio is, must not slow down anything, and must not be sent what is old
// when it is back. So nothing is queued for anybody: of a frame there is the newest, and a connection takes it when it
// can. Only what happened is kept as a list, because there every line counts.

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "common/base/time.hpp"

namespace gyre::ground {

/// In the order in which a connection that is new gets them.
enum class Scene { kHello, kMission, kStatus, kFrame };
inline constexpr std::size_t kScenes = 4;

class Stage {
 public:
  /// Takes the place of the one before it.
  void show(Scene scene, const std::string& json);
  void happen(const std::string& json);

  /// How far a connection is.
  struct Cursor {
    std::array<std::uint64_t, kScenes> seen{};
    std::uint64_t happenings = 0;
  };
  /// What is new for this connection, as events of a stream; waits for it at most so long, and is empty then. Absent:
  /// the stage is closed.
  [[nodiscard]] std::optional<std::string> next(Cursor& cursor, Duration patience);

  /// Sends everybody away.
  void close();

  /// While nobody looks, nothing has to be drawn.
  [[nodiscard]] int watchers() const;
  /// One more looks, unless there are `most` already.
  [[nodiscard]] bool enter(int most);
  void leave();

 private:
  [[nodiscard]] bool has_news(const Cursor& cursor) const;

  static constexpr std::size_t kKept = 200;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  struct Event {
    std::uint64_t version = 0;
    std::string text;
  };
  std::array<Event, kScenes> scenes_;
  std::deque<std::string> happenings_;
  std::uint64_t happened_ = 0;  ///< in all
  int watchers_ = 0;
  bool closed_ = false;
};

}  // namespace gyre::ground
