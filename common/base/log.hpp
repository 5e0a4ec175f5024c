#pragma once
// How a program speaks to its operator: one line per event on stdout, with time, program and level. For mains only;
// cores return what happened and are silent. Before start_log, or without it, the bare text goes to stderr, as from any
// command. What writes the lines stands in log.cpp alone: its headers cost every source that includes them seconds.

#include <string>

#include "common/base/notice.hpp"
#include "common/base/result.hpp"

namespace gyre {

/// From now on "[12:34:56.789] [gyre-agent 3] [info] text" on stdout. `level` is trace, debug, info, warning, error or
/// off; anything else is an error that lists them. Returns the level.
[[nodiscard]] Result<std::string> start_log(const std::string& process_name, const std::string& level);

void log(Notice::Level level, const std::string& text);
/// What a core wants a person to know.
void log(const Notices& notices);

inline void log_info(const std::string& text) {
  log(Notice::Level::kInfo, text);
}
inline void log_warning(const std::string& text) {
  log(Notice::Level::kWarning, text);
}
inline void log_error(const std::string& text) {
  log(Notice::Level::kError, text);
}

}  // namespace gyre
