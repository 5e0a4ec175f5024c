#pragma once
// Watches a swarm that flies, whoever started it: is it calm, and how far did the load move?
//
// Pure: told each message that was believed, with the view that took it (swarm_view.hpp), and asked for an account. An
// account speaks of a window, from the last account to this one (load_gauge.hpp).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mission/mission.hpp"
#include "ground/swarm/core/load_gauge.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

struct Account {
  double time_s = 0.0;                            ///< since the watch began
  std::string complaint;                          ///< what is not as it should be; empty: the swarm is calm
  std::string course;                             ///< course_line.hpp
  std::uint64_t term = 0;                         ///< how many coordinators have led this swarm
  std::vector<CarrierId> silent;                  ///< as the coordinator says
  std::map<std::string, std::string> complaints;  ///< of processes, each about itself
  std::map<std::string, Duration> late_max;       ///< how late processes woke in the window, each by its own word
  LoadWindow load;
  mission::LoadTolerance allowed;  ///< of the load, by the mission
  Duration skew{};
  Duration skew_budget{};  ///< 0: any

  [[nodiscard]] bool calm() const { return complaint.empty(); }
};

class SwarmWatch {
 public:
  SwarmWatch(const mission::Mission& mission, LocalTime now);

  /// Every message goes through here, to the view within.
  void see(LocalTime arrived, const SwarmMessage& message);

  /// Ends the window.
  [[nodiscard]] Account account(LocalTime now);

  /// Whether the coordinator and the load are heard at all; absent: they are.
  [[nodiscard]] std::optional<std::string> out_of_contact(LocalTime now) const;

 private:
  const mission::LoadTolerance tolerance_;
  const LocalTime begin_;
  SwarmView view_;
  LoadGauge load_;
  std::map<std::string, Duration> late_max_;
};

}  // namespace gyre::ground
