#pragma once
// `gyre check MISSION`: the certificate, for a person or (--json) for a program.

#include "common/program/command_line.hpp"

namespace gyre::ground {

[[nodiscard]] program::Command check_command();

}  // namespace gyre::ground
