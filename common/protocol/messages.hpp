#pragma once
// What processes say to each other, as plain data. common/dds carries it; nothing here knows how. What is for people
// and their tools stands in ground_messages.hpp.
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
#include "common/protocol/ground_messages.hpp"

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

}  // namespace gyre::protocol
