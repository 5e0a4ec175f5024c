#pragma once
// Commands and their answers: whoever asks says it again until it is answered, so each is done once and its answer
// kept.
//
// "Done" is a promise to somebody who may walk up to the load. What only the coordinator knows dies with it; so a wish
// that is granted is promised here, and told to be done when the agents hold it.

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

  /// What is granted, and to be told so as soon as it is safe.
  struct Promise {
    protocol::Wish wish;
    std::string text;
    LocalTime until{};  ///< then the answer is that it is not
  };
  void promise(std::uint64_t command, const Promise& promise);
  /// Answers every promise that can be. `wish`: in force now, and why it is, `news`; `unsafe`: why it may be forgotten
  /// yet, absent where the agents hold it.
  void keep_promises(LocalTime now, const protocol::Wish& wish, const std::string& news,
                     const std::optional<std::string>& unsafe, Replies& replies);
  /// Nobody will be there to keep them.
  void break_promises(const std::string& why, Replies& replies);

 private:
  struct Entry {
    std::uint64_t command = 0;
    std::optional<protocol::CommandReply> reply;
    std::optional<Promise> promise;  ///< until it is answered
  };
  std::deque<Entry> entries_;  // the newest last
};

}  // namespace gyre::coordinator
