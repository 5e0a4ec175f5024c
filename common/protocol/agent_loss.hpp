#pragma once
// What the swarm does when an agent falls silent in flight: the mission says it, the coordinator does it.

namespace gyre::protocol {

enum class AgentLoss {
  kFreeze,    ///< everyone comes to rest where the lost carrier stopped
  kContinue,  ///< everyone flies on
};

}  // namespace gyre::protocol
