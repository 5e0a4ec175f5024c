#pragma once
// Steps the real core of a process through its journal, as it was recorded, and compares what it says with what its
// process said then.

#include <optional>
#include <vector>

#include "common/base/ids.hpp"
#include "ground/recording/core/mcap_source.hpp"
#include "ground/replay/core/replayed.hpp"

namespace gyre::ground {

/// Of the agent of a carrier, or with none of the coordinator: each of its lives, in the order in which they began.
/// An error says why there is none that can be stepped.
[[nodiscard]] Result<std::vector<Replayed>> replay_core(const McapSource& source, std::optional<CarrierId> carrier);

}  // namespace gyre::ground
