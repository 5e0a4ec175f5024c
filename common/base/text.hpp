#pragma once
// Words for people, put together in one line.

#include <string>

namespace gyre {

/// printf into a string.
[[nodiscard]] std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace gyre
