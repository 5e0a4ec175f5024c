#pragma once
// `gyre report`: recordings as figures, and what was flown against what was certified.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command report_command();

}  // namespace gyre::ground
