#pragma once
// A file that is written whole or not at all.

#include <optional>
#include <string>

#include "common/base/result.hpp"

namespace gyre::ground {

/// Whoever reads the file meanwhile reads the old one or the new one. What is there and no file (/dev/stdout, a pipe)
/// is written as it is. Absent: it was written.
[[nodiscard]] std::optional<Error> write_whole(const std::string& path, const std::string& content);

}  // namespace gyre::ground
