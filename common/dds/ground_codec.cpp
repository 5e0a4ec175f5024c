// The codec of what people and their tools say and are told (protocol/ground_messages.hpp).

#include "common/dds/codec.hpp"
#include "common/dds/wire_fields.hpp"

namespace gyre::dds {

namespace idl = fast::idl;

std::optional<idl::Command> encode(const protocol::Command& message) {
  // A mission cut short would be another mission.
  if (message.mission != fitting_text(message.mission, protocol::kMaxMissionBytes)) return std::nullopt;
  idl::Command wire;
  wire.id(message.id);
  wire.kind(static_cast<std::uint8_t>(message.kind));
  wire.pace(message.pace);
  wire.at_phase(message.phase_rad.has_value());
  wire.phase_rad(message.phase_rad.value_or(0.0));
  wire.mission(message.mission);
  return wire;
}

std::optional<protocol::Command> decode(const idl::Command& wire) {
  const auto kind = enumerator(wire.kind(), protocol::CommandKind::kEngage, protocol::CommandKind::kPace);
  if (!kind) return std::nullopt;
  protocol::Command message{wire.id(), *kind, wire.pace(), std::nullopt, wire.mission().to_string()};
  if (wire.at_phase()) message.phase_rad = wire.phase_rad();
  return message;
}

std::optional<idl::CommandReply> encode(const protocol::CommandReply& message) {
  idl::CommandReply wire;
  wire.id(message.id);
  wire.done(message.done);
  wire.text(fitting_text(message.text, protocol::kMaxTextBytes));
  return wire;
}

std::optional<protocol::CommandReply> decode(const idl::CommandReply& wire) {
  return protocol::CommandReply{wire.id(), wire.done(), wire.text().to_string()};
}

std::optional<idl::CoordinatorStatus> encode(const protocol::CoordinatorStatus& message) {
  if (message.carriers.size() > kMaxCarrierId || message.silent.size() > kMaxCarrierId) return std::nullopt;
  idl::CoordinatorStatus wire;
  wire.term(message.term);
  wire.swarm_time_ns(ns(message.swarm_time));
  wire.mission(fitting_text(message.mission, protocol::kMaxTextBytes));
  wire.plan(to_wire(message.plan));
  wire.skew_budget_ns(message.skew_budget.count());
  wire.skew_ns(message.skew.count());
  wire.carriers(message.carriers);
  wire.silent(message.silent);
  wire.news(fitting_text(message.news, protocol::kMaxTextBytes));
  return wire;
}

std::optional<protocol::CoordinatorStatus> decode(const idl::CoordinatorStatus& wire) {
  if (wire.carriers().size() > kMaxCarrierId || wire.silent().size() > kMaxCarrierId) return std::nullopt;
  protocol::CoordinatorStatus message;
  message.term = wire.term();
  message.swarm_time = swarm(wire.swarm_time_ns());
  message.mission = wire.mission().to_string();
  message.plan = from_wire(wire.plan());
  message.skew_budget = Duration(wire.skew_budget_ns());
  message.skew = Duration(wire.skew_ns());
  message.carriers = wire.carriers();
  message.silent = wire.silent();
  message.news = wire.news().to_string();
  return message;
}

std::optional<idl::MissionText> encode(const protocol::MissionText& message) {
  if (message.text != fitting_text(message.text, protocol::kMaxMissionBytes)) return std::nullopt;
  idl::MissionText wire;
  wire.term(message.term);
  wire.plan(to_wire(message.plan));
  wire.text(message.text);
  return wire;
}

std::optional<protocol::MissionText> decode(const idl::MissionText& wire) {
  return protocol::MissionText{wire.term(), from_wire(wire.plan()), wire.text().to_string()};
}

std::optional<idl::Health> encode(const protocol::Health& message) {
  idl::Health wire;
  wire.process(fitting_text(message.process, protocol::kMaxTextBytes));
  wire.complaint(fitting_text(message.complaint, protocol::kMaxTextBytes));
  wire.dropped(to_wire(message.dropped));
  wire.undecodable(message.undecodable);
  wire.unsendable(message.unsendable);
  wire.overrun(message.overrun);
  wire.late_max_ns(message.late_max.count());
  return wire;
}

std::optional<protocol::Health> decode(const idl::Health& wire) {
  return protocol::Health{wire.process().to_string(),  wire.complaint().to_string(),
                          from_wire(wire.dropped()),   wire.undecodable(),
                          wire.unsendable(),           wire.overrun(),
                          Duration(wire.late_max_ns())};
}

std::optional<idl::Disturbance> encode(const protocol::Disturbance& message) {
  idl::Disturbance wire;
  wire.process(fitting_text(message.process, protocol::kMaxTextBytes));
  wire.kind(static_cast<std::uint8_t>(message.kind));
  wire.share(message.share);
  wire.shift_ns(message.shift.count());
  wire.force_w_n(numbers(message.force_w_n));
  wire.duration_ns(message.duration.count());
  return wire;
}

std::optional<protocol::Disturbance> decode(const idl::Disturbance& wire) {
  using Kind = protocol::DisturbanceKind;
  const auto kind = enumerator(wire.kind(), Kind::kLosePackets, Kind::kPushLoad);
  if (!kind) return std::nullopt;
  return protocol::Disturbance{
      wire.process().to_string(),  *kind, wire.share(), Duration(wire.shift_ns()), vector(wire.force_w_n()),
      Duration(wire.duration_ns())};
}

std::optional<idl::JournalPiece> encode(const protocol::JournalPiece& message) {
  if (message.bytes.size() > protocol::kMaxJournalBytes) return std::nullopt;
  idl::JournalPiece wire;
  wire.process(fitting_text(message.process, protocol::kMaxTextBytes));
  wire.incarnation(message.incarnation);
  wire.byte_offset(message.offset);
  wire.bytes(message.bytes);
  return wire;
}

std::optional<protocol::JournalPiece> decode(const idl::JournalPiece& wire) {
  if (wire.bytes().size() > protocol::kMaxJournalBytes) return std::nullopt;
  return protocol::JournalPiece{wire.process().to_string(), wire.incarnation(), wire.byte_offset(), wire.bytes()};
}

}  // namespace gyre::dds
