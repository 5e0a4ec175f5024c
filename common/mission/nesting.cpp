#include "common/mission/nesting.hpp"

#include <algorithm>

namespace gyre::mission {

std::optional<Place> too_deep(const std::string& text) {
  Place place;
  int depth = 0;
  bool comment = false;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i, ++place.column) {
    const char c = text[i];
    if (c == '\n') {  // ends comments, and strings too: they cannot cross lines
      comment = false;
      quote = '\0';
      place = {place.line + 1, -1};
    } else if (comment) {
      continue;
    } else if (quote != '\0') {
      const bool escape = c == '\\' && i + 1 < text.size() && text[i + 1] != '\n';
      if (escape) {
        ++i;
        ++place.column;
      } else if (c == quote) {
        quote = '\0';
      }
    } else if (c == '#') {
      comment = true;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '{' || c == '<' || c == '[') {
      if (++depth > kMaxDepth) return place;
    } else if (c == '}' || c == '>' || c == ']') {
      depth = std::max(0, depth - 1);
    }
  }
  return std::nullopt;
}

}  // namespace gyre::mission
