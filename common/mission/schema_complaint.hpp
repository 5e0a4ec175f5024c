#pragma once
// What Protobuf says about a text it cannot read, with what would be right.

#include <string>

namespace gyre::mission {

/// For an unknown field: the fields the message does have, the likeliest first; for an unknown way on silence: the
/// known ones; for a block that is never closed: that. Other messages pass unchanged.
[[nodiscard]] std::string with_cure(const std::string& parser_message);

}  // namespace gyre::mission
