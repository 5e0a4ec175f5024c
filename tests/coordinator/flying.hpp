#pragma once
// A swarm of agents that flies already.

#include "tests/coordinator/swarm_of_agents.hpp"

namespace gyre::coordinator::test {

/// In full motion: by a person's command, or by itself where the coordinator engages when it is ready.
struct Flying : SwarmOfAgents {
  explicit Flying(const Job& j = job(), const CoordinatorOptions& options = {}) : SwarmOfAgents(j, options) {
    fly(std::chrono::seconds(1));
    if (options.engage_when_ready) {
      fly(std::chrono::seconds(10));
    } else {
      EXPECT_TRUE(says(command(protocol::CommandKind::kEngage), "done")) << news;
    }
    EXPECT_EQ(pace(), 1.0);
    EXPECT_TRUE(moves());
  }
};

/// The mission whose swarm flies on, whoever falls silent.
inline Job flies_on() {
  Job flies_on = job();
  flies_on.silence.stop_after.reset();
  return flies_on;
}

inline void heal(SwarmOfAgents& swarm) {
  swarm.deaf.clear();
  swarm.mute.clear();
}

}  // namespace gyre::coordinator::test
