#pragma once
// Where two messages of one kind say different things, field by field, in words.

#include <string>
#include <vector>

namespace gyre::ground {

struct Difference {
  std::string field;  ///< "course.pace.ramps[1].target"
  std::string then;
  std::string now;
};

/// To the bit: whoever decides by the same words and the same arithmetic says the same. Defined for the messages of
/// protocol/messages.hpp that a core says.
template <class Message>
[[nodiscard]] std::vector<Difference> differences(const Message& then, const Message& now);

/// "position_w_m.x is 1.25, was 1.5; pace is 0, was 1; and 3 more".
[[nodiscard]] std::string told(const std::vector<Difference>& differences);

}  // namespace gyre::ground
