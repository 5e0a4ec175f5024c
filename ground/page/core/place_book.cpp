#include "ground/page/core/place_book.hpp"

#include <algorithm>

namespace gyre::ground {

void PlaceBook::enter(int who) {
  if (at_the_door_ > 0) --at_the_door_;
  inside_[who] = {};
}

void PlaceBook::wait(int who, LocalTime since) {
  const auto found = inside_.find(who);
  if (found != inside_.end()) found->second.waited_for_since = since;
}

void PlaceBook::go_on(int who) {
  const auto found = inside_.find(who);
  if (found != inside_.end()) found->second.waited_for_since.reset();
}

std::vector<int> PlaceBook::send_away() {
  std::size_t staying = 0;
  for (const auto& [who, guest] : inside_) staying += guest.sent_away ? 0U : 1U;
  std::vector<int> named;
  while (staying + at_the_door_ > places_) {
    auto longest = inside_.end();
    for (auto guest = inside_.begin(); guest != inside_.end(); ++guest) {
      if (guest->second.sent_away || !guest->second.waited_for_since) continue;
      if (longest == inside_.end() || *guest->second.waited_for_since < *longest->second.waited_for_since) {
        longest = guest;
      }
    }
    if (longest == inside_.end()) break;  // all are being answered: the newcomer waits
    longest->second.sent_away = true;
    named.push_back(longest->first);
    --staying;
  }
  return named;
}

}  // namespace gyre::ground
