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
    entries_.push_back({command, std::nullopt});
    return false;
  }
  if (known->reply) replies.push_back(*known->reply);
  return true;
}

void CommandDesk::answer(std::uint64_t command, bool done, const std::string& text, Replies& replies) {
  const protocol::CommandReply reply{command, done, text.substr(0, protocol::kMaxTextBytes)};
  for (Entry& entry : entries_) {
    if (entry.command == command) entry.reply = reply;
  }
  replies.push_back(reply);
}

}  // namespace gyre::coordinator
