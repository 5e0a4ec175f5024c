#pragma once
// How a program speaks to its operator: one line per event on stdout, with time, program and level. For mains only;
// cores return what happened and are silent.

#include <string>

#include "common/base/notice.hpp"
#include "common/base/result.hpp"

namespace gyre {

/// Makes spdlog's default logger write "[12:34:56.789] [gyre-agent 3] [info] text" to stdout. `level` is trace, debug,
/// info, warning, error or off; anything else is an error that lists them. Returns the level.
[[nodiscard]] Result<std::string> start_log(const std::string& process_name, const std::string& level);

/// What a core wants a person to know, through the default logger.
void log(const Notices& notices);

}  // namespace gyre
