#include "ground/replay/core/comparison.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "ground/replay/core/difference.hpp"

namespace gyre::ground {
namespace {

/// More would be read by nobody.
constexpr std::size_t kMostDifferences = 20;
constexpr std::size_t kMostNotices = 200;

std::uint64_t bits(SwarmTime time) {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

}  // namespace

MessageKey key_of(const protocol::TimeRequest& message) {
  return {message.carrier, message.incarnation, message.sequence};
}
MessageKey key_of(const protocol::Setpoint& message) {
  return {message.carrier, message.incarnation, message.sequence};
}
MessageKey key_of(const protocol::AgentStatus& message) {
  return {message.carrier, message.incarnation, message.sequence};
}
MessageKey key_of(const protocol::TimeReply& message) {
  return {message.carrier, message.incarnation, message.sequence};
}
MessageKey key_of(const protocol::PlanOffer& message) {
  return {message.carrier, message.term, message.sequence};
}
MessageKey key_of(const protocol::Beacon& message) {
  return {0, message.term, message.sequence};
}
MessageKey key_of(const protocol::CoordinatorStatus& message) {
  return {0, message.term, bits(message.swarm_time)};
}
MessageKey key_of(const protocol::MissionText& message) {
  return {message.term, message.plan.term, message.plan.revision};
}
MessageKey key_of(const protocol::CommandReply& message) {
  return {0, 0, message.id};
}

void Comparison::step(LocalTime at, std::uint8_t then, std::uint8_t now, const std::vector<std::string>& outputs) {
  if (steps_++ == 0) first_ = at;
  last_ = std::max(last_, at);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const bool was = (then >> i & 1U) != 0;
    const bool is = (now >> i & 1U) != 0;
    if (was != is)
      otherwise(at, (is ? "says " : "does not say ") + outputs[i] + (is ? ", did not then" : ", did then"));
  }
}

template <class Message>
void Comparison::said(LocalTime at, const std::string& kind, const Message& message) {
  Count& count = counts_[kind];
  ++count.said;
  const auto& recorded = std::get<std::map<MessageKey, Message>>(*recorded_);
  const auto known = recorded.find(key_of(message));
  if (known == recorded.end()) return;
  ++count.recorded;
  const auto found = ground::differences(known->second, message);
  if (found.empty()) {
    ++count.same;
    return;
  }
  std::string words = kind + ": " + told(found);
  if constexpr (std::is_same_v<Message, protocol::Setpoint>)
    apart_max_m_ = std::max(apart_max_m_, (message.position_w_m - known->second.position_w_m).norm());
  otherwise(at, std::move(words));
}

void Comparison::otherwise(LocalTime at, std::string words) {
  ++different_;
  if (differences_.size() < kMostDifferences) differences_.push_back({at, std::move(words)});
}

void Comparison::noticed(LocalTime at, const Notices& notices) {
  for (const Notice& notice : notices) {
    if (notices_.size() < kMostNotices) notices_.push_back({at, notice.text});
  }
}

template void Comparison::said(LocalTime, const std::string&, const protocol::TimeRequest&);
template void Comparison::said(LocalTime, const std::string&, const protocol::Setpoint&);
template void Comparison::said(LocalTime, const std::string&, const protocol::AgentStatus&);
template void Comparison::said(LocalTime, const std::string&, const protocol::TimeReply&);
template void Comparison::said(LocalTime, const std::string&, const protocol::PlanOffer&);
template void Comparison::said(LocalTime, const std::string&, const protocol::Beacon&);
template void Comparison::said(LocalTime, const std::string&, const protocol::CoordinatorStatus&);
template void Comparison::said(LocalTime, const std::string&, const protocol::MissionText&);
template void Comparison::said(LocalTime, const std::string&, const protocol::CommandReply&);

}  // namespace gyre::ground
