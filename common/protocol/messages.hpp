#pragma once
// What processes say to each other, as plain data. common/dds carries it; nothing here knows how.
//
// Units are in the names; _w is the world frame, _b the body frame of the load. Times are typed: SwarmTime is shared,
// LocalTime means something only to the process that stamped it.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/mechanics/carrier_slice.hpp"
#include "common/protocol/course.hpp"

namespace gyre::protocol {

/// Topic phase, coordinator to all. Complete in itself: one received is enough to know everything.
struct Beacon {
  std::uint64_t term = 0;
  std::uint64_t sequence = 0;
  SwarmTime swarm_time{};
  Course course;                   ///< what is flown
  std::optional<Course> proposal;  ///< what would be flown next, if every agent confirms it
  Duration skew_budget{};          ///< clock disagreement that the plans in force allow; 0: any
};

struct NumberedSlice {
  PlanNumber number;
  mechanics::CarrierSlice slice;
};

/// Topic carrier_N/plan, coordinator to agent N: every plan this carrier has to know now. State, not an event, so a
/// late joiner needs no history. At most kMaxPlans.
struct PlanOffer {
  CarrierId carrier = 0;
  std::uint64_t term = 0;
  std::uint64_t sequence = 0;  ///< within the term; what an older one said does not count any more
  std::vector<NumberedSlice> slices;
  std::vector<NumberedSlice> neighbour;  ///< of the carrier after it, which this agent only keeps; at most kMaxPlans
};

/// Topic carrier_N/held, agent N to coordinator: the plans it holds, at most kMaxPlans, so that a restarted coordinator
/// can learn them. It keeps a neighbour's as well: one agent may die with the coordinator, and nothing is forgotten.
struct HeldPlans {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;
  std::vector<NumberedSlice> slices;
  std::vector<NumberedSlice> neighbour;  ///< as it was offered
};

/// Topics carrier_N/time_request and time_reply: the four timestamps of a two-way exchange. Each of two agents of one
/// carrier gets its own reply, so it says which is believed: a newcomer knows whether it may fly before it knows time.
struct TimeRequest {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;
  std::uint64_t sequence = 0;
  LocalTime sent{};  ///< agent's clock
};

struct TimeReply {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;
  std::uint64_t sequence = 0;
  std::uint64_t term = 0;
  LocalTime request_sent{};      ///< echoed
  SwarmTime request_received{};  ///< coordinator's clock
  SwarmTime reply_sent{};        ///< coordinator's clock
  std::uint64_t believed = 0;    ///< the incarnation that is; 0: nobody was heard yet
  std::string rival;             ///< where the other one is that claims this carrier; empty: none is heard
};

/// What was dropped, and why; in every process that listens.
struct DropCounts {
  std::uint64_t late = 0;
  std::uint64_t duplicate = 0;
  std::uint64_t wrong_term = 0;
  std::uint64_t nonsense = 0;
};

enum class AgentState : std::uint8_t {
  kWaiting = 1,  ///< no swarm time or no plan yet: sends no setpoints
  kReady = 2,    ///< follows a course that rests
  kFlying = 3,   ///< follows one that moves
  kAlone = 4,    ///< flies on without the coordinator
};

/// Topic carrier_N/status. Carries back all the coordinator has told, so that a restarted one can learn it.
struct AgentStatus {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;  ///< differs after every start of the agent, never 0
  std::uint64_t sequence = 0;
  std::uint64_t term = 0;
  AgentState state = AgentState::kWaiting;
  SwarmTime swarm_time{};  ///< the agent's estimate when it sent this
  Duration clock_uncertainty{};
  double clock_drift_ppm = 0.0;
  Course course;                     ///< what it follows
  std::uint64_t confirmed = 0;       ///< revision of the newest proposal of this term that it can fly; 0: none
  std::vector<PlanNumber> accepted;  ///< plans it holds and can fly
  PlanNumber refused;                ///< the newest plan it cannot fly, and why
  std::string refusal;               ///< at most kMaxTextBytes
  std::uint64_t beacons_received = 0;
  std::uint64_t beacons_missed = 0;
  DropCounts dropped;
  std::string address;  ///< where this process is, for people; at most kMaxTextBytes
};

/// Topic carrier_N/setpoint, agent N to its vehicle. Place and winch are asked for ahead of where the plan has them, by
/// the lags of the vehicle and the winch (mechanics/taylor.hpp, led); the cable's direction, tension and length are the
/// plan's.
struct Setpoint {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;  ///< of the agent; a vehicle flies those of one agent at a time
  std::uint64_t sequence = 0;
  SwarmTime swarm_time{};  ///< for which it holds
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_w_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_w = Eigen::Vector3d::UnitZ();
  double tension_n = 0.0;
  double cable_length_m = 0.0;  ///< attachment to carrier, as the plan has it
  double winch_length_m = 0.0;  ///< unstretched: what the winch has to have paid out
  double winch_rate_m_s = 0.0;
  double winch_acceleration_m_s2 = 0.0;
};

/// Topic carrier_N/state, vehicle to agent N and ground.
struct CarrierState {
  CarrierId carrier = 0;
  std::uint64_t incarnation = 0;  ///< of the process that tells it
  std::uint64_t follows = 0;      ///< of the agent whose setpoints are flown; 0: none are
  std::uint64_t sequence = 0;
  LocalTime stamp{};  ///< the vehicle's clock
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
  double tension_n = 0.0;
  double cable_length_m = 0.0;  ///< attachment to carrier, stretched
  double winch_length_m = 0.0;  ///< paid out, unstretched
  double winch_rate_m_s = 0.0;
};

/// Topic load/state, simulator or motion capture to ground.
struct LoadState {
  std::uint64_t incarnation = 0;  ///< of the process that tells it
  std::uint64_t sequence = 0;
  LocalTime stamp{};
  Eigen::Vector3d position_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_w_m_s = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_w_b = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_b_rad_s = Eigen::Vector3d::Zero();
};

enum class CommandKind : std::uint8_t { kEngage = 1, kRelease = 2, kFreeze = 3, kRetune = 4, kPace = 5 };

/// Topics command and command_reply, ground to coordinator and back.
struct Command {
  std::uint64_t id = 0;  ///< chosen by the sender, echoed in the reply
  CommandKind kind = CommandKind::kEngage;
  double pace = 1.0;                ///< kPace: 0 .. 1
  std::optional<double> phase_rad;  ///< kRelease: where to stop; absent: at the next moment
  std::string mission;              ///< kRetune: the text of a mission file; at most kMaxMissionBytes
};

struct CommandReply {
  std::uint64_t id = 0;
  bool done = false;
  std::string text;
};

/// Topic coordinator/status, coordinator to ground.
struct CoordinatorStatus {
  std::uint64_t term = 0;
  SwarmTime swarm_time{};
  std::string mission;              ///< its name; at most kMaxTextBytes
  PlanNumber plan;                  ///< the plan of the mission in force
  Duration skew_budget{};           ///< clock disagreement the plans in force allow; 0: any
  Duration skew{};                  ///< the greatest disagreement the agents' uncertainties leave possible
  std::vector<CarrierId> carriers;  ///< of the mission; at most kMaxCarrierId
  std::vector<CarrierId> silent;    ///< at most kMaxCarrierId
  std::string news;                 ///< the latest of what it has to tell; at most kMaxTextBytes
};

/// Topic mission, coordinator to ground: the mission in force, so that who joins knows its load and limits.
struct MissionText {
  std::uint64_t term = 0;
  PlanNumber plan;   ///< as CoordinatorStatus names it
  std::string text;  ///< at most kMaxMissionBytes; empty: longer than that
};

/// Topic health, every process to ground and coordinator: whether it does its work, what it dropped, and why.
struct Health {
  std::string process;    ///< "agent 3"; at most kMaxTextBytes
  std::string complaint;  ///< what keeps it from its work; empty: nothing does. At most kMaxTextBytes
  DropCounts dropped;
  std::uint64_t undecodable = 0;  ///< samples that were no such message
  std::uint64_t unsendable = 0;   ///< messages the wire refused
  std::uint64_t overrun = 0;      ///< messages the main loop came too late for
  Duration late_max{};            ///< how late its main loop woke from a sleep, the worst since the last report
};

enum class DisturbanceKind : std::uint8_t { kLosePackets = 1, kShiftClock = 2, kPushLoad = 3 };

/// Topic laboratory, ground to processes that were started with --laboratory; nobody else listens (disturbance.hpp).
struct Disturbance {
  std::string process;  ///< "agent 3"; at most kMaxTextBytes
  DisturbanceKind kind = DisturbanceKind::kLosePackets;
  double share = 0.0;                                   ///< kLosePackets: of the packets, in and out alike; 0: none
  Duration shift{};                                     ///< kShiftClock: added to the process's clock
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();  ///< kPushLoad: at the centre of mass
  Duration duration{};                                  ///< kPushLoad; kLosePackets: 0: until told otherwise
};

inline constexpr std::size_t kMaxTextBytes = 255;
inline constexpr std::size_t kMaxMissionBytes = 32768;

}  // namespace gyre::protocol
