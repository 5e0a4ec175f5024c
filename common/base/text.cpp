#include "common/base/text.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace gyre {

std::string text(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  std::string out(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, arguments)), '\0');
  va_end(arguments);
  std::vsnprintf(out.data(), out.size() + 1, format, again);
  va_end(again);
  return out;
}

std::string listed(const char* noun, const std::vector<CarrierId>& ids) {
  constexpr std::size_t kMaxShown = 12;
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(ids.size(), kMaxShown); ++i) words.push_back(std::to_string(ids[i]));
  if (ids.size() > kMaxShown) words.push_back(std::to_string(ids.size() - kMaxShown) + " more");
  std::string out = noun + std::string(ids.size() == 1 ? " " : "s ");
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? " and " : ", ";
    out += words[i];
  }
  return out;
}

}  // namespace gyre
