#pragma once
// Between what processes mean (protocol/messages.hpp) and what travels (idl/gyre_msgs.idl), field by field.
//
// encode() keeps every bit of every number, so decode(encode(m)) == m. It gives nothing when a list or a mission text
// is over its bound: half a plan must not travel. Texts for people (refusal, reply, news) are cut instead, between two
// characters.
//
// decode() gives nothing for what is no such message: an enumerator that does not exist, a list over its bound.
// Whether the numbers make sense (NaN, another carrier, an old term) is for the protocol's cores to judge.

#include <optional>
#include <string>

#include "common/dds/fastdds_version.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::dds {

/// The generated type of a message and its generated type support.
template <class Message>
struct Wire;

// clang-format off
template <> struct Wire<protocol::Beacon>       { using Type = fast::idl::Beacon;          using Support = fast::idl::BeaconPubSubType; };
template <> struct Wire<protocol::PlanOffer>    { using Type = fast::idl::PlanOffer;       using Support = fast::idl::PlanOfferPubSubType; };
template <> struct Wire<protocol::HeldPlans>    { using Type = fast::idl::HeldPlans;       using Support = fast::idl::HeldPlansPubSubType; };
template <> struct Wire<protocol::TimeRequest>  { using Type = fast::idl::TimeRequest;     using Support = fast::idl::TimeRequestPubSubType; };
template <> struct Wire<protocol::TimeReply>    { using Type = fast::idl::TimeReply;       using Support = fast::idl::TimeReplyPubSubType; };
template <> struct Wire<protocol::AgentStatus>  { using Type = fast::idl::AgentStatus;     using Support = fast::idl::AgentStatusPubSubType; };
template <> struct Wire<protocol::Setpoint>     { using Type = fast::idl::CarrierSetpoint; using Support = fast::idl::CarrierSetpointPubSubType; };
template <> struct Wire<protocol::CarrierState> { using Type = fast::idl::CarrierState;    using Support = fast::idl::CarrierStatePubSubType; };
template <> struct Wire<protocol::LoadState>    { using Type = fast::idl::LoadState;       using Support = fast::idl::LoadStatePubSubType; };
template <> struct Wire<protocol::Command>      { using Type = fast::idl::Command;         using Support = fast::idl::CommandPubSubType; };
template <> struct Wire<protocol::CommandReply> { using Type = fast::idl::CommandReply;    using Support = fast::idl::CommandReplyPubSubType; };
template <> struct Wire<protocol::CoordinatorStatus> { using Type = fast::idl::CoordinatorStatus; using Support = fast::idl::CoordinatorStatusPubSubType; };
template <> struct Wire<protocol::MissionText>  { using Type = fast::idl::MissionText;     using Support = fast::idl::MissionTextPubSubType; };
template <> struct Wire<protocol::Health>       { using Type = fast::idl::Health;          using Support = fast::idl::HealthPubSubType; };
template <> struct Wire<protocol::Disturbance>  { using Type = fast::idl::Disturbance;     using Support = fast::idl::DisturbancePubSubType; };
template <> struct Wire<protocol::JournalPiece> { using Type = fast::idl::JournalPiece;    using Support = fast::idl::JournalPiecePubSubType; };
// clang-format on

[[nodiscard]] std::optional<fast::idl::Beacon> encode(const protocol::Beacon& message);
[[nodiscard]] std::optional<fast::idl::PlanOffer> encode(const protocol::PlanOffer& message);
[[nodiscard]] std::optional<fast::idl::HeldPlans> encode(const protocol::HeldPlans& message);
[[nodiscard]] std::optional<fast::idl::TimeRequest> encode(const protocol::TimeRequest& message);
[[nodiscard]] std::optional<fast::idl::TimeReply> encode(const protocol::TimeReply& message);
[[nodiscard]] std::optional<fast::idl::AgentStatus> encode(const protocol::AgentStatus& message);
[[nodiscard]] std::optional<fast::idl::CarrierSetpoint> encode(const protocol::Setpoint& message);
[[nodiscard]] std::optional<fast::idl::CarrierState> encode(const protocol::CarrierState& message);
[[nodiscard]] std::optional<fast::idl::LoadState> encode(const protocol::LoadState& message);
[[nodiscard]] std::optional<fast::idl::Command> encode(const protocol::Command& message);
[[nodiscard]] std::optional<fast::idl::CommandReply> encode(const protocol::CommandReply& message);
[[nodiscard]] std::optional<fast::idl::CoordinatorStatus> encode(const protocol::CoordinatorStatus& message);
[[nodiscard]] std::optional<fast::idl::MissionText> encode(const protocol::MissionText& message);
[[nodiscard]] std::optional<fast::idl::Health> encode(const protocol::Health& message);
[[nodiscard]] std::optional<fast::idl::Disturbance> encode(const protocol::Disturbance& message);
[[nodiscard]] std::optional<fast::idl::JournalPiece> encode(const protocol::JournalPiece& message);

[[nodiscard]] std::optional<protocol::Beacon> decode(const fast::idl::Beacon& wire);
[[nodiscard]] std::optional<protocol::PlanOffer> decode(const fast::idl::PlanOffer& wire);
[[nodiscard]] std::optional<protocol::HeldPlans> decode(const fast::idl::HeldPlans& wire);
[[nodiscard]] std::optional<protocol::TimeRequest> decode(const fast::idl::TimeRequest& wire);
[[nodiscard]] std::optional<protocol::TimeReply> decode(const fast::idl::TimeReply& wire);
[[nodiscard]] std::optional<protocol::AgentStatus> decode(const fast::idl::AgentStatus& wire);
[[nodiscard]] std::optional<protocol::Setpoint> decode(const fast::idl::CarrierSetpoint& wire);
[[nodiscard]] std::optional<protocol::CarrierState> decode(const fast::idl::CarrierState& wire);
[[nodiscard]] std::optional<protocol::LoadState> decode(const fast::idl::LoadState& wire);
[[nodiscard]] std::optional<protocol::Command> decode(const fast::idl::Command& wire);
[[nodiscard]] std::optional<protocol::CommandReply> decode(const fast::idl::CommandReply& wire);
[[nodiscard]] std::optional<protocol::CoordinatorStatus> decode(const fast::idl::CoordinatorStatus& wire);
[[nodiscard]] std::optional<protocol::MissionText> decode(const fast::idl::MissionText& wire);
[[nodiscard]] std::optional<protocol::Health> decode(const fast::idl::Health& wire);
[[nodiscard]] std::optional<protocol::Disturbance> decode(const fast::idl::Disturbance& wire);
[[nodiscard]] std::optional<protocol::JournalPiece> decode(const fast::idl::JournalPiece& wire);

/// The longest beginning of a UTF-8 text that fits into `bytes`, holds no NUL and cuts no character in two.
[[nodiscard]] std::string fitting_text(const std::string& text, std::size_t bytes);

}  // namespace gyre::dds
