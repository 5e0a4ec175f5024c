#pragma once
// What a swarm has said so far, as one picture: told each message and the time it came, then read.
//
// Intuition: whatever shows a swarm, a table, a page, a figure for a monitoring system, asks the same questions: who
// leads, what is flown, where everybody is and where he should be, who is silent, what is wrong. They are answered here
// once, so that no two of them disagree. Who only looks does not judge whom to believe either: of two simulators, two
// agents of one carrier, two coordinators while one takes over, the view keeps to the one that the swarm keeps to.
//
//   step(arrived, message) -> whether it was believed       everything else reads
//
// What no honest process can have said (protocol/sanity.hpp), and what a rival says, changes nothing and is counted.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "common/mechanics/reference.hpp"
#include "common/protocol/incumbent.hpp"
#include "common/protocol/liveness.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

/// What is heard of a swarm by who looks on.
using SwarmMessage = std::variant<protocol::Beacon, protocol::CoordinatorStatus, protocol::AgentStatus,
                                  protocol::HeldPlans, protocol::CarrierState, protocol::LoadState, protocol::Health,
                                  protocol::MissionText, protocol::Command, protocol::CommandReply>;

struct Heard {
  SwarmMessage message;
  LocalTime arrived{};
};

/// Of beacons and states, fifty and a hundred a second: at 60 % loss the odds against such a gap are 1e5 to one.
inline constexpr Duration kStreamSilence = std::chrono::milliseconds(500);
/// Of words that come twice a second and are delivered again where they are lost, or once a second and are not.
inline constexpr Duration kWordSilence = std::chrono::milliseconds(3500);

/// One carrier: its agent's word, its vehicle's.
struct CarrierView {
  std::optional<protocol::AgentStatus> agent;  ///< of the agent that is believed
  std::optional<LocalTime> agent_heard;
  std::optional<protocol::CarrierState> vehicle;
  std::optional<LocalTime> vehicle_heard;
  protocol::Incumbent agents{kStreamSilence};
  protocol::Incumbent vehicles{kStreamSilence};
  std::map<protocol::PlanNumber, mechanics::CarrierSlice> slices;  ///< that it holds
};

/// What a process says of itself, once a second.
struct ProcessView {
  protocol::Health word;
  protocol::Liveness heard{kWordSilence};
};

class SwarmView {
 public:
  /// `arrived` never decreases by more than messages overtake each other.
  bool step(LocalTime arrived, const SwarmMessage& message);

  // ---- who leads, and what is flown
  [[nodiscard]] const std::optional<protocol::Beacon>& beacon() const { return beacon_; }
  [[nodiscard]] const std::optional<protocol::CoordinatorStatus>& coordinator() const { return coordinator_; }
  [[nodiscard]] const std::optional<protocol::MissionText>& mission() const { return mission_; }
  [[nodiscard]] const protocol::Liveness& beacon_heard() const { return beacon_heard_; }
  [[nodiscard]] const protocol::Liveness& coordinator_heard() const { return coordinator_heard_; }
  /// The coordinator's, carried on since its last beacon by the clock here. Absent: none was heard.
  [[nodiscard]] std::optional<SwarmTime> swarm_time(LocalTime now) const;
  /// Whether the coordinator says that it hears nothing of this carrier.
  [[nodiscard]] bool named_silent(CarrierId carrier) const;

  // ---- carriers and load
  [[nodiscard]] const std::map<CarrierId, CarrierView>& carriers() const { return carriers_; }
  /// Of the mission, as the coordinator tells; before that, who was heard.
  [[nodiscard]] std::vector<CarrierId> carrier_ids() const;
  /// What the carrier has to do by the course at this moment. Absent: no beacon, or nobody told the plan.
  [[nodiscard]] std::optional<mechanics::Reference> planned(CarrierId carrier, SwarmTime at) const;
  /// How far the vehicle was from there when it last told where it is. Along its path a hundredth of a second is not
  /// counted: that is how long its word may have been on its way. Absent as above, or it never told.
  [[nodiscard]] std::optional<double> deviation_m(CarrierId carrier) const;
  [[nodiscard]] const std::optional<protocol::LoadState>& load() const { return load_; }
  [[nodiscard]] const protocol::Incumbent& load_heard() const { return loads_; }

  // ---- processes
  [[nodiscard]] const std::map<std::string, ProcessView>& processes() const { return processes_; }
  /// Process and complaint; of those that are heard: a complaint is not older than who makes it.
  [[nodiscard]] std::map<std::string, std::string> complaints(LocalTime now) const;

  /// Messages that were nonsense, or a rival's.
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  bool on(LocalTime arrived, const protocol::Beacon& beacon);
  bool on(LocalTime arrived, const protocol::CoordinatorStatus& status);
  bool on(LocalTime arrived, const protocol::AgentStatus& status);
  bool on(LocalTime arrived, const protocol::HeldPlans& held);
  bool on(LocalTime arrived, const protocol::CarrierState& state);
  bool on(LocalTime arrived, const protocol::LoadState& load);
  bool on(LocalTime arrived, const protocol::Health& health);
  bool on(LocalTime arrived, const protocol::MissionText& mission);
  bool on(LocalTime arrived, const protocol::Command& command);
  bool on(LocalTime arrived, const protocol::CommandReply& reply);

  std::optional<protocol::Beacon> beacon_;
  LocalTime beacon_arrived_{};
  protocol::Liveness beacon_heard_{kStreamSilence};
  std::optional<protocol::CoordinatorStatus> coordinator_;
  protocol::Liveness coordinator_heard_{kWordSilence};
  std::optional<protocol::MissionText> mission_;
  std::optional<protocol::MissionText> outdated_mission_;  ///< the last of a term that is over, or is still to come
  std::map<CarrierId, CarrierView> carriers_;
  std::optional<protocol::LoadState> load_;
  protocol::Incumbent loads_{kStreamSilence};
  std::map<std::string, ProcessView> processes_;
  std::uint64_t refused_ = 0;
};

}  // namespace gyre::ground
