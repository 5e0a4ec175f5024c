#pragma once
// Words for people, put together in one line.

#include <string>
#include <vector>

#include "common/base/ids.hpp"

namespace gyre {

/// printf into a string.
[[nodiscard]] std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// "agent 2", "agents 2, 5 and 7"; of a long list the first twelve: "agents 1, 2, .. and 88 more".
[[nodiscard]] std::string listed(const char* noun, const std::vector<CarrierId>& ids);

}  // namespace gyre
