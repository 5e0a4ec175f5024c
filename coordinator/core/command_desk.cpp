#include "coordinator/core/command_desk.hpp"

#include <algorithm>

namespace gyre::coordinator {
namespace {

/// More people than this do not ask at once.
constexpr std::size_t kRemembered = 64;

}  // namespace

bool CommandDesk::heard_before(std::uint64_t command, Replies& replies) {
  const auto known =
      std::find_if(entries_.begin(), entries_.end(), [command](const Entry& e) { return e.command == command; });
  if (known == entries_.end()) {
    if (entries_.size() == kRemembered) entries_.pop_front();
    entries_.push_back({command, std::nullopt, std::nullopt});
    return false;
  }
  if (known->reply) replies.push_back(*known->reply);
  return true;
}

void CommandDesk::answer(std::uint64_t command, bool done, const std::string& text, Replies& replies) {
  const protocol::CommandReply reply{command, done, text.substr(0, protocol::kMaxTextBytes)};
  for (Entry& entry : entries_) {
    if (entry.command != command) continue;
    entry.reply = reply;
    entry.promise.reset();
  }
  replies.push_back(reply);
}

void CommandDesk::promise(std::uint64_t command, const Promise& promise) {
  for (Entry& entry : entries_) {
    if (entry.command == command) entry.promise = promise;
  }
}

void CommandDesk::keep_promises(LocalTime now, const protocol::Wish& wish, const std::string& news,
                                const std::optional<std::string>& unsafe, Replies& replies) {
  for (const Entry& entry : entries_) {
    if (!entry.promise) continue;
    if (!(entry.promise->wish == wish)) {
      answer(entry.command, false,
             wish.by == protocol::Wisher::kPerson ? "overtaken by another command" : "overtaken: " + news, replies);
    } else if (!unsafe) {
      answer(entry.command, true, entry.promise->text, replies);
    } else if (now >= entry.promise->until) {
      answer(entry.command, false, "not safe yet: " + *unsafe + "; ask again", replies);
    }
  }
}

void CommandDesk::break_promises(const std::string& why, Replies& replies) {
  for (const Entry& entry : entries_) {
    if (entry.promise) answer(entry.command, false, why, replies);
  }
}

}  // namespace gyre::coordinator
