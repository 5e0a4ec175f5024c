#pragma once
// Until when the phase may run on without another word, and who knows it.
//
// Intuition: at the end of the lease everybody stops on one profile. That works only if everybody has the same lease,
// whoever fell silent, too. So the lease is not extended with every beacon, but in steps, each of them only when all
// have confirmed the one before; agents confirm at once. Whoever falls silent then holds, nearly always, exactly what
// it confirmed last: the others go back to that, and all stop together. What is left to chance is a step that was on
// its way when the link broke. Nothing is extended while somebody is out of touch: not heard, or not hearing.
//
// A step is what two of them may stop apart. So it is no longer than it has to be, whatever silence lies behind it:
// kStep where it is confirmed at once; where packets are lost, twice as long as the one before took to be confirmed,
// for the lease has to grow faster than time passes; never longer than kReach. And none is made so late that it could
// not be taken back.
//
//   granted      what beacons say
//   reach        the longest that the next step may be
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
  /// A step is no longer. Where 60 % of all packets are lost, 4 agents confirm one within 0.15 s, 16 within 0.25 s, 100
  /// within 0.35 s, on average; after a silence of 2 s their lease is long again after 2, 3 and 7 s. With 0.3 s it is
  /// after 3 and 8 s, and 100 run out of it.
  static constexpr Duration kReach = kPatience;
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
  Duration reach_ = kStep;
  std::map<CarrierId, SwarmTime> confirmed_;
};

}  // namespace gyre::coordinator
