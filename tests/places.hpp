#pragma once
// Where the sources and the programs of this build are: known to one source file alone, so that what ccache knows of
// one clone of the repository serves every other.

#include <string>

namespace gyre::test {

/// Absolute, without a slash at its end.
[[nodiscard]] std::string source_directory();

/// With gyre, gyre-agent and the others in it, once they are built; absolute, without a slash at its end.
[[nodiscard]] std::string program_directory();

}  // namespace gyre::test
