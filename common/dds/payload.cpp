#include "common/dds/payload.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>

#include "common/dds/codec.hpp"
#include "common/dds/strict_type.hpp"

namespace gyre::dds {

// A type's support works out the largest message there is when it is made, which takes longer than to write one; so
// each thread keeps its own.

template <class Message>
std::optional<Message> decode_payload(const std::vector<std::uint8_t>& payload) {
  if (payload.empty() || payload.size() > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  fast::rtps::SerializedPayload_t wire(static_cast<std::uint32_t>(payload.size()));
  wire.length = static_cast<std::uint32_t>(payload.size());
  std::copy(payload.begin(), payload.end(), wire.data);
  thread_local StrictType<typename Wire<Message>::Support> type(std::make_shared<std::atomic<std::uint64_t>>(0));
  typename Wire<Message>::Type sample;
  if (!type.deserialize(fast::passed(wire), &sample)) return std::nullopt;
  return decode(sample);
}

template <class Message>
std::optional<std::vector<std::uint8_t>> encode_payload(const Message& message) {
  auto sample = encode(message);
  if (!sample) return std::nullopt;
  thread_local typename Wire<Message>::Support support;
  fast::rtps::SerializedPayload_t wire(fast::wire_size(support, *sample));
  if (!fast::serialize(support, *sample, fast::passed(wire))) return std::nullopt;
  return std::vector<std::uint8_t>(wire.data, wire.data + wire.length);
}

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): only a macro can spell explicit instantiations once
#define GYRE_PAYLOAD(Message)                                                                \
  template std::optional<Message> decode_payload<Message>(const std::vector<std::uint8_t>&); \
  template std::optional<std::vector<std::uint8_t>> encode_payload<Message>(const Message&);

GYRE_PAYLOAD(protocol::Beacon)
GYRE_PAYLOAD(protocol::PlanOffer)
GYRE_PAYLOAD(protocol::HeldPlans)
GYRE_PAYLOAD(protocol::TimeRequest)
GYRE_PAYLOAD(protocol::TimeReply)
GYRE_PAYLOAD(protocol::AgentStatus)
GYRE_PAYLOAD(protocol::Setpoint)
GYRE_PAYLOAD(protocol::CarrierState)
GYRE_PAYLOAD(protocol::LoadState)
GYRE_PAYLOAD(protocol::Command)
GYRE_PAYLOAD(protocol::CommandReply)
GYRE_PAYLOAD(protocol::CoordinatorStatus)
GYRE_PAYLOAD(protocol::MissionText)
GYRE_PAYLOAD(protocol::Health)
GYRE_PAYLOAD(protocol::Disturbance)
GYRE_PAYLOAD(protocol::JournalPiece)
#undef GYRE_PAYLOAD

}  // namespace gyre::dds
