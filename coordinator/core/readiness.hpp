#pragma once
// Whether those whom a departure needs say that nothing keeps them from their work: the agents, and the simulator that
// stands for vehicles and load. Only it knows that an agent's setpoints do not reach it; the agent cannot.
//
// Who says nothing about itself is not waited for: vehicles need not speak this protocol.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::coordinator {

class Readiness {
 public:
  explicit Readiness(const std::vector<CarrierId>& carriers);

  /// Health of anybody else is passed over.
  void take(LocalTime now, const protocol::Health& health);

  /// The first of what is complained of: "simulator: no setpoints for carrier 2". What was not said again for ten
  /// seconds is forgotten; somebody who died is missed otherwise.
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  struct Word {
    protocol::Liveness fresh;
    std::string complaint;
  };
  std::map<std::string, Word> words_;  ///< by process, each there from the beginning
};

}  // namespace gyre::coordinator
