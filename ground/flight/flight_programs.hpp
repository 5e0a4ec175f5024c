#pragma once
// Which processes a flight consists of.

#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "ground/flight/supervisor.hpp"

namespace gyre::ground {

inline constexpr const char* kCoordinatorName = "coordinator";

/// Simulator, coordinator, and one agent per carrier, in the order to start them. Executables are looked for in
/// `directory`; a missing one is an error that names its path and the cure. `network` goes to each of them.
[[nodiscard]] Result<std::vector<Program>> flight_programs(const std::string& directory,
                                                           const std::string& mission_path,
                                                           const std::vector<CarrierId>& carriers,
                                                           const std::vector<std::string>& network);

/// Where this process's own executable is: the others are beside it.
[[nodiscard]] Result<std::string> own_directory();

}  // namespace gyre::ground
