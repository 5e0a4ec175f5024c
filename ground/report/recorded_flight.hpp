#pragma once
// A recording's file, read into the account of a flight.

#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "common/mission/mission.hpp"
#include "ground/recording/core/mcap_source.hpp"
#include "ground/report/core/account.hpp"

namespace gyre::ground {

/// The file is read from its front, a chunk at a time: one that was cut off, or is damaged, gives what is whole in it.
/// `given`: the mission of a recording that has none. An error: no recording of a swarm; it names the file.
[[nodiscard]] Result<Account> read_flight(const std::string& path, const McapSource& source,
                                          const std::optional<mission::Mission>& given);

}  // namespace gyre::ground
