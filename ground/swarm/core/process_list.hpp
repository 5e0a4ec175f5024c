#pragma once
// Who takes part in a swarm, and how each of them is: one line for each process, and what is still missing before a
// flight may begin.

#include <optional>
#include <string>
#include <vector>

#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

struct ProcessLine {
  std::string name;   ///< "agent 3"
  std::string state;  ///< of an agent "flying", ...; "silent", "not heard", "healthy", "complains"
  bool well = false;
  std::string complaint;
  std::string address;
  std::optional<Duration> age;                   ///< since its last word; absent: never heard
  CarrierId carrier = 0;                         ///< of an agent; 0: none
  const protocol::AgentStatus* agent = nullptr;  ///< its word; as long as the view is not stepped
  const protocol::Health* health = nullptr;
};

/// The coordinator, the simulator where one is, every carrier's agent, then whoever else speaks.
[[nodiscard]] std::vector<ProcessLine> process_list(const SwarmView& view, LocalTime now);

struct MissingThing {
  std::string who;
  std::string what;
};

/// What has to come before a flight may begin, one line each; empty: nothing is missing.
[[nodiscard]] std::vector<MissingThing> missing(const SwarmView& view, LocalTime now);

}  // namespace gyre::ground
