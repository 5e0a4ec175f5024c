#pragma once
// How deep the blocks of a text lie inside each other. Protobuf's text parser recurses once per level, and without a
// limit over fields it does not know: a text of nothing but braces would end the process.

#include <optional>
#include <string>

namespace gyre::mission {

/// A mission's own blocks are 4 deep: carrier { directional { direction { .. } } }.
inline constexpr int kMaxDepth = 16;

/// In a text; both count from zero.
struct Place {
  int line = 0;
  int column = 0;
};

/// Where the text first goes deeper than kMaxDepth, if it does.
[[nodiscard]] std::optional<Place> too_deep(const std::string& text);

}  // namespace gyre::mission
