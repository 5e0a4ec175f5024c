#pragma once
// Commands and their answers: whoever asks says it again until it is answered, so each is done once and its answer
// kept.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

class CommandDesk {
 public:
  using Replies = std::vector<protocol::CommandReply>;

  /// Whether this command was taken in before. If it is answered already, the answer was lost: it is given again.
  [[nodiscard]] bool heard_before(std::uint64_t command, Replies& replies);
  void answer(std::uint64_t command, bool done, const std::string& text, Replies& replies);

 private:
  struct Entry {
    std::uint64_t command = 0;
    std::optional<protocol::CommandReply> reply;
  };
  std::deque<Entry> entries_;  // the newest last
};

}  // namespace gyre::coordinator
