#pragma once
// What is seen of a swarm, put into a table for a person.

#include <string>

#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

/// Everybody the coordinator counts on has been heard, and so has the load.
[[nodiscard]] bool complete(const SwarmView& view);

/// At a glance: course, wish, load, clocks, each carrier, what was dropped, who complains.
[[nodiscard]] std::string table(const SwarmView& view, LocalTime now);

/// "motion, as a person asked; the pace is 100 %; the lease runs for another 4.8 s"
[[nodiscard]] std::string wish_line(const protocol::Course& course, SwarmTime now);

/// "flying"
[[nodiscard]] const char* name(protocol::AgentState state);

}  // namespace gyre::ground
