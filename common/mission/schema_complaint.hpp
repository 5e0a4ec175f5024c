#pragma once
// What Protobuf says about a text it cannot read, with what would be right.

#include <string>

namespace gyre::mission {

/// For an unknown field: the fields the message does have, the likeliest first. Other messages pass unchanged.
[[nodiscard]] std::string with_cure(const std::string& parser_message);

}  // namespace gyre::mission
