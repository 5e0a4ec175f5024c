#pragma once
// What a core wants a person to know. Mains log it; tests read it.

#include <string>
#include <vector>

namespace gyre {

struct Notice {
  enum class Level { kInfo, kWarning, kError };
  Level level = Level::kInfo;
  std::string text;
};

using Notices = std::vector<Notice>;

}  // namespace gyre
