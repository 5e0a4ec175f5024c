#include "ground/page/core/utf8.hpp"

#include <algorithm>

namespace gyre::ground {
namespace {

/// How many bytes of UTF-8 begin here: 1 to 4; 0: it is none (Unicode 15.0, table 3-7).
std::size_t utf8_bytes(std::string_view text) {
  const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&byte](std::size_t i, unsigned least = 0x80, unsigned most = 0xBF) {
    return byte(i) >= least && byte(i) <= most;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    return follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) && follows(2) ? 3 : 0;
  }
  if (first < 0xF0 || first > 0xF4) return 0;
  return follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) && follows(2) && follows(3) ? 4 : 0;
}

}  // namespace

std::string utf8(std::string_view words) {
  std::string text;
  while (!words.empty()) {
    const std::size_t bytes = utf8_bytes(words);
    text += bytes > 0 ? words.substr(0, bytes) : "?";
    words.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return text;
}

}  // namespace gyre::ground
