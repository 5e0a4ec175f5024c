#pragma once
// Who has a place at a server, and who has to give it up when others come and none is left.
//
// Intuition: a place costs a thread, so there are so many and no more. Who opens connections and says nothing takes
// them all at no cost; a bound on his silence alone lets him keep everybody out for as long as the bound is, again and
// again. So while a newcomer has no place, the one who has let the server wait for the longest loses his. Who is being
// answered, or looks on, lets nobody wait and loses nothing.
//
//   come -> enter -> (wait <-> go_on)* -> leave

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "common/base/time.hpp"

namespace gyre::ground {

class PlaceBook {
 public:
  explicit PlaceBook(std::size_t places) : places_(places) {}

  /// One more is at the door, and has no place yet.
  void come() { ++at_the_door_; }
  /// The one who came first has a place; `who` is a number that nobody else inside has.
  void enter(int who);
  void leave(int who) { inside_.erase(who); }

  /// The server waits for a word of his, `since` then.
  void wait(int who, LocalTime since);
  void go_on(int who);

  /// Whose places are needed; each is named once, and leaves soon.
  [[nodiscard]] std::vector<int> send_away();

 private:
  struct Guest {
    std::optional<LocalTime> waited_for_since;
    bool sent_away = false;
  };
  std::size_t places_;
  std::size_t at_the_door_ = 0;
  std::map<int, Guest> inside_;
};

}  // namespace gyre::ground
