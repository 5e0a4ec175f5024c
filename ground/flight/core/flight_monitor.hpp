#pragma once
// Follows a flight by what its processes say: how far it has come, and what is missing.
//
// Pure: it reads the view (swarm/core/swarm_view.hpp), is told the time, and looks after each message, because of some
// things only the moment tells. It decides nothing; ground/flight/flight.cpp acts on what it answers.

#include <optional>
#include <string>
#include <vector>

#include "ground/flight/core/mission_plan.hpp"
#include "ground/swarm/core/swarm_view.hpp"

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
  /// The view outlives it.
  FlightMonitor(const SwarmView& view, const std::vector<CarrierId>& carriers, LocalTime now,
                const FlightPatience& patience = {});

  /// After every message that the view believed.
  void look(LocalTime now);

  [[nodiscard]] FlightPhase phase(LocalTime now) const;
  [[nodiscard]] int agents() const { return static_cast<int>(carriers_.size()); }
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
  enum class Place { kRest, kTowardsMotion, kMotion, kSlowed, kTowardsRest, kElsewhere };

  [[nodiscard]] const protocol::AgentStatus* agent(CarrierId id) const;
  [[nodiscard]] bool ready(CarrierId id) const;
  [[nodiscard]] std::optional<LocalTime> simulator_heard() const;
  [[nodiscard]] bool silent(std::optional<LocalTime> heard, LocalTime now) const;
  [[nodiscard]] Place place(LocalTime now) const;
  void remember_motion();
  [[nodiscard]] std::optional<std::string> somebody_silent(LocalTime now) const;

  const SwarmView& view_;
  std::vector<CarrierId> carriers_;
  FlightPatience patience_;
  LocalTime begin_;
  MissionPlan plan_;
  std::optional<LocalTime> all_ready_;
  std::optional<SwarmTime> motion_complete_;  // end of the ramp to full pace
  std::optional<SwarmTime> motion_left_;      // start of the ramp away from it
  Duration transition_duration_{};
};

}  // namespace gyre::ground
