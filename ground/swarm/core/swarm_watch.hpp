#pragma once
// Watches a swarm that flies, whoever started it: is it calm, and how far did the load move?
//
// Pure: told the time, told each message, asked for an account. An account speaks of a window, from the last account to
// this one, so that no peak is lost between two of them however seldom they are asked for.
//
//   symbol     meaning                                                          unit
//   v, w       the load's velocity (W) and angular velocity (B)                 m/s, rad/s
//   F = m dv/dt, M = J dw/dt + w x J w      what the cables leave unbalanced     N, N m
//   residual   max(|F|, |M| / r) / (m g), r the longest attachment arm          1
//
// The residual is Newton's: it is taken from the load alone and trusts nobody's word of what he pulls. A load that
// hangs still, or drifts steadily, has none. Derivatives are differences between samples, by the stamps of whoever
// measures.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mission/mission.hpp"
#include "common/protocol/incumbent.hpp"
#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

/// How the load was in a window; all zero without a sample.
struct LoadWindow {
  double displacement_max_m = 0.0;  ///< from the mission's pose
  double rotation_max_deg = 0.0;
  double residual_max = 0.0;  ///< share of the weight
  std::uint64_t samples = 0;
};

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

  void see(const protocol::Beacon& beacon, LocalTime arrived);
  void see(const protocol::CoordinatorStatus& status, LocalTime arrived);
  void see(const protocol::Health& health, LocalTime arrived);
  void see(const protocol::LoadState& load, LocalTime arrived);

  /// Ends the window.
  [[nodiscard]] Account account(LocalTime now);

  /// Whether the coordinator and the load are heard at all; absent: they are.
  [[nodiscard]] std::optional<std::string> out_of_contact(LocalTime now) const;

 private:
  [[nodiscard]] std::string complaint(LocalTime now) const;
  [[nodiscard]] double residual(const protocol::LoadState& before, const protocol::LoadState& after) const;

  const mechanics::Load load_;
  const double gravity_m_s2_;
  const mission::LoadTolerance tolerance_;
  double arm_m_ = 0.0;
  const LocalTime begin_;

  std::optional<protocol::Beacon> beacon_;
  std::optional<protocol::CoordinatorStatus> coordinator_;
  std::optional<protocol::LoadState> last_load_;
  std::map<std::string, std::string> complaints_;
  std::map<std::string, Duration> late_max_;
  protocol::Liveness beacon_heard_;
  protocol::Liveness coordinator_heard_;
  protocol::Incumbent load_heard_;
  double displacement_now_m_ = 0.0;
  double rotation_now_deg_ = 0.0;
  LoadWindow window_;
};

}  // namespace gyre::ground
