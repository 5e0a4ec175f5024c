#include "ground/swarm/core/order_desk.hpp"

#include <algorithm>
#include <utility>

namespace gyre::ground {

void OrderDesk::ask(LocalTime now, const protocol::Command& command) {
  waiting_.push_back({command, now, now, false});
}

void OrderDesk::see(const protocol::CommandReply& reply) {
  const auto asked = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& waiting) { return waiting.command.id == reply.id; });
  if (asked == waiting_.end()) return;
  answered_.push_back({reply.id, true, reply});
  waiting_.erase(asked);
}

OrderDesk::Outputs OrderDesk::step(LocalTime now, bool found) {
  Outputs out;
  out.answers = std::exchange(answered_, {});
  for (auto waiting = waiting_.begin(); waiting != waiting_.end();) {
    waiting->found = waiting->found || found;
    if (now - waiting->since > (waiting->found ? kPatienceOnceFound : kPatience)) {
      out.answers.push_back({waiting->command.id, waiting->found, std::nullopt});
      waiting = waiting_.erase(waiting);
      continue;
    }
    if (now >= waiting->next) {
      out.send.push_back(waiting->command);
      waiting->next = now + kRepeat;
    }
    ++waiting;
  }
  return out;
}

}  // namespace gyre::ground
