#pragma once
// Which message travels on which topic, and how: the table of idl/README.md as code.
//
// A topic is either one for the swarm ("rt/gyre/phase") or one per carrier ("rt/gyre/carrier_3/setpoint"). The "rt/"
// and the type names are ROS 2's conventions, so that its tools find the topics.

#include <optional>
#include <string>
#include <tuple>

#include "common/base/ensure.hpp"
#include "common/base/ids.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::dds {

enum class Delivery {
  kNewest,    ///< best effort, keep last 1: the next one makes up for a lost one
  kRetained,  ///< reliable, keep last 1, transient local: a late joiner gets the newest too
  kEach,      ///< reliable, volatile: every one, for whoever listens when it is sent
  kStream,    ///< reliable, volatile: every one in a stream of them, behind a link that loses most packets, too
  kFromMany,  ///< best effort, keep last 1 at each of many writers on one topic; readers have room for all of them
};

struct Topic {
  const char* name;  ///< after "rt/gyre/", or after "rt/gyre/carrier_N/"
  const char* type;
  bool per_carrier;
  Delivery delivery;
};

/// Defined for the messages of protocol/messages.hpp that travel on their own.
template <class Message>
inline constexpr Topic kTopic = Message::this_message_has_no_topic;

// clang-format off
template <> inline constexpr Topic kTopic<protocol::Beacon>       {"phase",         "gyre_msgs::msg::dds_::Beacon_",          false, Delivery::kNewest};
template <> inline constexpr Topic kTopic<protocol::PlanOffer>    {"plan",          "gyre_msgs::msg::dds_::PlanOffer_",       true,  Delivery::kRetained};
template <> inline constexpr Topic kTopic<protocol::HeldPlans>    {"held",          "gyre_msgs::msg::dds_::HeldPlans_",       true,  Delivery::kRetained};
template <> inline constexpr Topic kTopic<protocol::TimeRequest>  {"time_request",  "gyre_msgs::msg::dds_::TimeRequest_",     true,  Delivery::kNewest};
template <> inline constexpr Topic kTopic<protocol::TimeReply>    {"time_reply",    "gyre_msgs::msg::dds_::TimeReply_",       true,  Delivery::kNewest};
template <> inline constexpr Topic kTopic<protocol::AgentStatus>  {"status",        "gyre_msgs::msg::dds_::AgentStatus_",     true,  Delivery::kRetained};
template <> inline constexpr Topic kTopic<protocol::Setpoint>     {"setpoint",      "gyre_msgs::msg::dds_::CarrierSetpoint_", true,  Delivery::kNewest};
template <> inline constexpr Topic kTopic<protocol::CarrierState> {"state",         "gyre_msgs::msg::dds_::CarrierState_",    true,  Delivery::kNewest};
template <> inline constexpr Topic kTopic<protocol::LoadState>    {"load/state",    "gyre_msgs::msg::dds_::LoadState_",       false, Delivery::kNewest};
template <> inline constexpr Topic kTopic<protocol::Command>      {"command",       "gyre_msgs::msg::dds_::Command_",         false, Delivery::kEach};
template <> inline constexpr Topic kTopic<protocol::CommandReply> {"command_reply", "gyre_msgs::msg::dds_::CommandReply_",    false, Delivery::kEach};
template <> inline constexpr Topic kTopic<protocol::CoordinatorStatus> {"coordinator/status", "gyre_msgs::msg::dds_::CoordinatorStatus_", false, Delivery::kRetained};
template <> inline constexpr Topic kTopic<protocol::MissionText>  {"mission",       "gyre_msgs::msg::dds_::MissionText_",     false, Delivery::kRetained};
template <> inline constexpr Topic kTopic<protocol::Health>       {"health",        "gyre_msgs::msg::dds_::Health_",          false, Delivery::kFromMany};
template <> inline constexpr Topic kTopic<protocol::Disturbance>  {"laboratory",    "gyre_msgs::msg::dds_::Disturbance_",     false, Delivery::kEach};
template <> inline constexpr Topic kTopic<protocol::JournalPiece> {"journal",       "gyre_msgs::msg::dds_::JournalPiece_",    false, Delivery::kStream};
// clang-format on

/// All that have a topic: what is in here is recorded, too.
using EveryMessage =
    std::tuple<protocol::Beacon, protocol::PlanOffer, protocol::HeldPlans, protocol::TimeRequest, protocol::TimeReply,
               protocol::AgentStatus, protocol::Setpoint, protocol::CarrierState, protocol::LoadState,
               protocol::Command, protocol::CommandReply, protocol::CoordinatorStatus, protocol::MissionText,
               protocol::Health, protocol::Disturbance, protocol::JournalPiece>;

[[nodiscard]] constexpr bool reliable(Delivery delivery) {
  return delivery != Delivery::kNewest && delivery != Delivery::kFromMany;
}

/// How many samples a writer keeps to send again.
[[nodiscard]] constexpr int writer_depth(Delivery delivery) {
  if (delivery == Delivery::kStream) return 256;  // nine seconds of an agent's journal
  return delivery == Delivery::kEach ? 16 : 1;
}

/// Room for samples that arrive back to back, before the listener has taken the first. A reader of an unkeyed topic
/// keeps the samples of all its writers in one history.
[[nodiscard]] constexpr int reader_depth(Delivery delivery) {
  if (delivery == Delivery::kFromMany) return 128;  // every agent there can be, and the hubs
  return delivery == Delivery::kEach ? 16 : 4;
}

/// The full DDS name. `carrier` is there exactly for the topics that are per carrier; anything else is a bug.
[[nodiscard]] inline std::string topic_name(const Topic& topic, std::optional<CarrierId> carrier) {
  GYRE_ENSURE(topic.per_carrier == carrier.has_value(), "a carrier for the carrier_N topics, none for the others");
  const std::string root = "rt/gyre/";
  return carrier ? root + "carrier_" + std::to_string(*carrier) + "/" + topic.name : root + topic.name;
}

}  // namespace gyre::dds
