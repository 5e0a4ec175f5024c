#pragma once
// Words that are text for certain. What comes over the wire may be any bytes, and JSON takes only text.

#include <string>
#include <string_view>

namespace gyre::ground {

/// UTF-8 as it is; each byte that is none becomes a question mark.
[[nodiscard]] std::string utf8(std::string_view words);

}  // namespace gyre::ground
