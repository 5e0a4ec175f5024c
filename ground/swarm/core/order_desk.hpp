#pragma once
// Words to the coordinator, and its answers.
//
// The answer's way back may be found after the word's way there, so the same word is said again, with its id, until it
// is answered or nobody is patient any more. A coordinator that was found is given longer: a transition is answered
// when it is agreed, which takes several rehearsals on a busy machine.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/protocol/messages.hpp"

namespace gyre::ground {

struct OrderAnswer {
  std::uint64_t command = 0;
  bool found = true;                            ///< whether a coordinator was
  std::optional<protocol::CommandReply> reply;  ///< absent: none came in time
};

class OrderDesk {
 public:
  static constexpr Duration kPatience = std::chrono::seconds(5);  ///< to find a coordinator at all
  static constexpr Duration kPatienceOnceFound = std::chrono::seconds(20);
  static constexpr Duration kRepeat = std::chrono::milliseconds(250);

  /// `command.id` is fresh: two who send at once must not take each other's answer.
  void ask(LocalTime now, const protocol::Command& command);
  void see(const protocol::CommandReply& reply);

  struct Outputs {
    std::vector<protocol::Command> send;
    std::vector<OrderAnswer> answers;
  };
  /// As often as the loop turns. `found`: whether anybody listens to commands.
  [[nodiscard]] Outputs step(LocalTime now, bool found);

  [[nodiscard]] bool waits() const { return !waiting_.empty(); }

 private:
  struct Waiting {
    protocol::Command command;
    LocalTime since, next;
    bool found = false;
  };
  std::vector<Waiting> waiting_;
  std::vector<OrderAnswer> answered_;
};

}  // namespace gyre::ground
