#pragma once
// Until when the phase may run on without another word, and who knows it.
//
// Intuition: at the end of the lease everybody stops on one profile. That works only if everybody has the same lease,
// whoever fell silent, too. So the lease is not extended with every beacon, but in steps, each of them only when all
// have confirmed the one before; agents confirm at once. Whoever falls silent then holds, nearly always, exactly what
// it confirmed last: the others go back to that, and all stop together. What is left to chance is a step that was on
// its way when the link broke. Nothing is extended while somebody is out of touch: not heard, or not hearing.
//
// And no step is made so late that it could not be taken back.
//
//   granted      what beacons say
//   confirmed    per carrier, what its agent last said it holds; it survives the agent, whose vehicle holds it as well

#include <map>
#include <optional>

#include "common/protocol/silence.hpp"
#include "coordinator/core/fleet.hpp"

namespace gyre::coordinator {

class LeaseBook {
 public:
  static constexpr Duration kStep = std::chrono::milliseconds(100);
  /// Without a confirmation for so long, a step is taken back.
  static constexpr Duration kPatience = std::chrono::milliseconds(450);
  /// A beacon may be so old and is still taken (agent/core/agent.hpp, beacon_age_max): one that comes late must not
  /// wake those who have stopped.
  static constexpr Duration kBelieved = std::chrono::milliseconds(300);

  /// `taken_over`: what the swarm flies by already.
  explicit LeaseBook(std::optional<SwarmTime> taken_over = std::nullopt) : granted_(taken_over) {}

  /// What the next beacon is to say. `carriers`: those that fly the course.
  std::optional<SwarmTime> step(LocalTime now, SwarmTime time, const protocol::Silence& silence,
                                const std::vector<CarrierId>& carriers, const Fleet& fleet);

 private:
  std::optional<SwarmTime> granted_;
  SwarmTime granted_at_{};
  std::map<CarrierId, SwarmTime> confirmed_;
};

}  // namespace gyre::coordinator
