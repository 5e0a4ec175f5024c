#pragma once
// Follows a flight by what its processes say: how far it has come, and what is missing.
//
// Pure: told the time, told each message. It decides nothing; ground/flight/flight.cpp acts on what it answers.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"
#include "ground/flight/core/mission_plan.hpp"

namespace gyre::ground {

enum class FlightPhase {
  kStarting,   ///< the coordinator or the simulator has not been heard, or not which plan is the mission's
  kMatching,   ///< not every agent has accepted the motion
  kEngaging,   ///< from rest to full pace; also the wait for it to begin
  kFlying,     ///< the motion, at full pace
  kSlowed,     ///< the motion at another pace, as a person asked
  kReleasing,  ///< back to rest, and at rest
  kDeviated,   ///< the swarm stopped by itself, because somebody fell silent, or went to another mission's plan
};

/// "starting", "matching", ...
[[nodiscard]] const char* name(FlightPhase phase);

struct FlightPatience {
  Duration starting = from_seconds(20.0);
  Duration matching = from_seconds(30.0);
  Duration engaging = from_seconds(30.0);  ///< until the motion begins
  Duration silence = from_seconds(5.0);    ///< of anybody, once heard
};

class FlightMonitor {
 public:
  FlightMonitor(const std::vector<CarrierId>& carriers, LocalTime now, const FlightPatience& patience = {});

  void see(const protocol::Beacon& beacon, LocalTime arrived);
  void see(const protocol::CoordinatorStatus& status) { plan_.learn(status); }
  void see(const protocol::AgentStatus& status, LocalTime arrived);
  void see(const protocol::CarrierState& state, LocalTime arrived);

  [[nodiscard]] FlightPhase phase(LocalTime now) const;
  [[nodiscard]] int agents() const { return static_cast<int>(agents_.size()); }
  /// Agents that have accepted the motion.
  [[nodiscard]] int agents_ready() const;
  /// Since full pace was reached and until it was left; 0 before.
  [[nodiscard]] Duration flown(LocalTime now) const;
  /// Whether the load has been handed over to moving carriers and is not at rest again.
  [[nodiscard]] bool under_way(LocalTime now) const;
  /// How long the newest change of pace takes: the bound of a release.
  [[nodiscard]] Duration transition_duration() const { return transition_duration_; }

  /// What has not come in time, who refused, or who fell silent: a sentence that names them.
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  struct Agent {
    protocol::Liveness heard;
    bool ready = false;
    std::string refusal;
  };
  enum class Place { kRest, kTowardsMotion, kMotion, kSlowed, kTowardsRest, kElsewhere };

  [[nodiscard]] SwarmTime swarm_time(LocalTime now) const;
  [[nodiscard]] Place place(LocalTime now) const;
  void remember_motion();
  [[nodiscard]] std::optional<std::string> somebody_silent(LocalTime now) const;

  FlightPatience patience_;
  LocalTime begin_;
  std::map<CarrierId, Agent> agents_;
  protocol::Liveness simulator_;
  protocol::Liveness coordinator_;
  MissionPlan plan_;
  protocol::Beacon beacon_;
  LocalTime beacon_arrived_{};
  std::optional<LocalTime> all_ready_;
  std::optional<SwarmTime> motion_complete_;  // end of the ramp to full pace
  std::optional<SwarmTime> motion_left_;      // start of the ramp away from it
  Duration transition_duration_{};
};

}  // namespace gyre::ground
