#pragma once
// What happened to a swarm, in order: the lines of a log that somebody reads who was not there.
//
// Intuition: messages tell how things are; what happened is where they differ from how they were. So this looks at the
// view after every message and writes a line where something worth one has changed: who leads, what the coordinator has
// to tell, an agent's state, a life of a process that follows another, a complaint that comes up or is settled, a word
// of a person and its answer.

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "common/base/notice.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

struct Happening {
  std::uint64_t number = 0;     ///< from 1 on
  std::optional<SwarmTime> at;  ///< absent: before a beacon was heard
  Notice::Level level = Notice::Level::kInfo;
  std::string who;
  std::string text;
};

/// "pace 0.5", "release, to rest at 90 degrees"
[[nodiscard]] std::string order_words(const protocol::Command& command);

class Happenings {
 public:
  static constexpr std::size_t kKept = 500;

  /// The view outlives it.
  explicit Happenings(const SwarmView& view) : view_(view) {}

  /// After every message that the view believed.
  void look(LocalTime now, const SwarmMessage& message);
  /// Now and then: silence is told by nobody.
  void look(LocalTime now);
  /// Something that whoever runs this did or saw.
  void tell(LocalTime now, Notice::Level level, const std::string& who, const std::string& text);

  /// The newest kKept, the oldest first.
  [[nodiscard]] const std::deque<Happening>& all() const { return all_; }

 private:
  void on(LocalTime now, const protocol::CoordinatorStatus& status);
  void on(LocalTime now, const protocol::AgentStatus& status);
  void on(LocalTime now, const protocol::Health& health);
  void on(LocalTime now, const protocol::Command& command);
  void on(LocalTime now, const protocol::CommandReply& reply);
  template <class Message>
  void on(LocalTime /*now*/, const Message& /*message*/) {}

  struct Agent {
    std::uint64_t incarnation = 0;
    protocol::AgentState state = protocol::AgentState::kWaiting;
    protocol::PlanNumber refused;
    bool named_silent = false;  ///< by the coordinator
    bool wordless = false;      ///< nothing is heard of how it is
    bool told_silent = false;
  };
  struct Process {
    bool complained = false;
    bool silent = false;
  };
  /// Its silence shows in several places, and is told once: when the first of them shows it, and when none does.
  void tell_silence(LocalTime now, CarrierId id, Agent& agent);
  [[nodiscard]] bool told_otherwise(const std::string& news) const;

  const SwarmView& view_;
  std::deque<Happening> all_;
  std::uint64_t last_number_ = 0;
  std::uint64_t term_ = 0;
  std::string news_;
  bool leaderless_ = false;
  std::map<CarrierId, Agent> agents_;
  std::map<std::string, Process> processes_;
  std::deque<std::uint64_t> commands_, replies_;  ///< told lately: both are said again until they are heard
};

}  // namespace gyre::ground
