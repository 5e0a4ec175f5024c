#pragma once
// The word by which a program is told what to fly.

#include <string>

#include "common/base/result.hpp"
#include "common/mission/mission.hpp"
#include "common/program/command_line.hpp"

namespace gyre::program {

/// MISSION, as the first word or GYRE_MISSION; required.
[[nodiscard]] Option mission_argument(std::string& path, Take take = Take::kRequired);

/// Its file, read. When it cannot be, every complaint went to stderr, and the error is what to exit with.
[[nodiscard]] Result<mission::Mission, ExitCode> read_mission(const std::string& path);

}  // namespace gyre::program
