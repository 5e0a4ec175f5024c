#pragma once
// The physical twin as a machine without clock or wire: told what arrived and what time it is, it says what to publish.
//
// Intuition: the world is simulated after the fact. A setpoint waits with the time it arrived until the simulated time
// gets there and takes effect at the first tick not before it, extrapolated from the moment it held for
// (held_time.hpp); so how often step() is called changes nothing of the motion, and a main loop may
// sleep from one publication to the next.
//
//   step(arrived, setpoint)    judged (setpoint_judge.hpp), then kept until its time
//   step(arrived, status)      taken at once, and the plans that are held
//   step(arrived, pushed)      judged, then kept until its time
//   step(now, Advance{})       integrates to the last tick not after now, at most kTicksPerAdvance of them
//
// When the simulated time is behind (a stall of the process, a machine too slow), every missed tick is still
// integrated, but publications are not made up for: only the newest state goes out, no earlier than one publication
// period after the last. After a stall it goes out when the simulated time has caught up, and setpoints that may have
// waited meanwhile are not flown (stall_judge.hpp): vehicles go on by themselves, as without setpoints. More than
// kLongestCatchUp behind, the surplus is skipped: the world stood still meanwhile. Both are reported, at most once per
// second.
//
// The flight begins at rest: carriers where the plan has them at its beginning, cables paid out so that the load is in
// exact equilibrium. A carrier without setpoints stays there. When CVODE fails twice on a tick, the load is held still
// over that tick and starts afresh from there; that is reported and is the only untrue motion there is.

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/base/notice.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"
#include "common/mechanics/plan.hpp"
#include "common/protocol/messages.hpp"
#include "simulator/core/load_dynamics.hpp"
#include "simulator/core/simulation_settings.hpp"

namespace gyre::simulator {

inline constexpr Duration kPublicationPeriod = std::chrono::milliseconds(10);
inline constexpr Duration kReportPeriod = std::chrono::seconds(1);
/// A lag shorter than this is the scheduler's, not ours.
inline constexpr Duration kToleratedLag = std::chrono::milliseconds(100);
inline constexpr Duration kLongestCatchUp = std::chrono::seconds(10);
/// Bounds the time one step() takes, so that a main loop that catches up still hears a signal.
inline constexpr int kTicksPerAdvance = 100;
/// More setpoints than this never wait; the oldest goes first and counts as late.
inline constexpr std::size_t kMaxWaitingSetpoints = 4096;

struct Advance {};
/// Somebody pushes the load, at its centre of mass, from the first tick not before now (push.hpp).
struct Pushed {
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();
  Duration duration{};
};
/// Of a carrier's agent: by its status and its plans the vehicle goes on when no more setpoints come (onward.hpp).
using Event = std::variant<protocol::Setpoint, protocol::AgentStatus, protocol::HeldPlans, Pushed, Advance>;

struct LagReport {
  Duration behind{};
  Duration skipped{};  ///< of simulated time that never was; zero when all can be made up for
};

struct DropReport {
  protocol::DropCounts counts;  ///< since the start
  std::string latest;           ///< why the latest one was dropped
};

/// To be performed in this order.
struct Outputs {
  std::vector<protocol::CarrierState> carriers;  ///< in the plan's order, or none
  std::optional<protocol::LoadState> load;
  std::optional<LagReport> lag;
  std::optional<DropReport> dropped;
  std::optional<Error> failure;
  Notices notices;
};

class Simulator {
 public:
  /// Refuses a plan that cannot be simulated at rest (no cable stiffness, a cable that would stretch from nothing),
  /// and settings out of range.
  [[nodiscard]] static Result<Simulator> create(const mechanics::Plan& plan, const SimulationSettings& settings,
                                                LocalTime start);
  ~Simulator();
  Simulator(Simulator&&) noexcept;

  /// `now` of an Advance never decreases; for a setpoint it is the time it arrived, which may be before the last
  /// Advance.
  [[nodiscard]] Outputs step(LocalTime now, const Event& event);

  /// When to call step(now, Advance{}) next.
  [[nodiscard]] LocalTime next_due() const;

  [[nodiscard]] const LoadMotion& load() const;
  [[nodiscard]] Duration simulated() const;
  [[nodiscard]] protocol::DropCounts dropped() const;
  /// What keeps it from its work: simulated time that is behind, carriers that get no setpoints. Absent: nothing does.
  [[nodiscard]] std::optional<std::string> complaint(LocalTime now) const;

 private:
  struct World;
  explicit Simulator(std::unique_ptr<World> world);
  std::unique_ptr<World> world_;
};

}  // namespace gyre::simulator
