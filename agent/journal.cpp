#include "agent/journal.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "common/base/version.hpp"
#include "common/dds/journal_content.hpp"

namespace gyre::agent {
namespace {

using nlohmann::json;

/// The options that differ between agents, each with its name; `limit(name, value)` writes or reads it.
template <class Options, class Limit>
void each_limit(Options& options, Limit limit) {
  auto& can = options.vehicle;
  limit("tension_max_n", can.tension_max_n);
  limit("length_min_m", can.length_min_m);
  limit("length_max_m", can.length_max_m);
  limit("winch_rate_max_m_s", can.winch_rate_max_m_s);
  limit("speed_min_m_s", can.speed_min_m_s);
  limit("speed_max_m_s", can.speed_max_m_s);
  limit("acceleration_max_m_s2", can.acceleration_max_m_s2);
  auto& machines = options.machines;
  limit("drum_rate_max_m_s", machines.winch.rate_max_m_s);
  limit("drum_acceleration_max_m_s2", machines.winch.acceleration_max_m_s2);
  limit("mass_kg", machines.vehicle.mass_kg);
  limit("thrust_max_n", machines.vehicle.thrust_max_n);
  limit("bank_max_rad", machines.vehicle.bank_max_rad);
}

std::pair<JournalKind, Bytes> told(const Tick& tick) {
  Bytes bytes;
  if (tick.undecodable > 0) ByteWriter(bytes).number(tick.undecodable);
  return {JournalKind::kTick, std::move(bytes)};
}
std::pair<JournalKind, Bytes> told(const TimeReplyArrived& reply) {
  return {JournalKind::kTimeReply, dds::content_of(reply.arrived, reply.reply)};
}
std::pair<JournalKind, Bytes> told(const protocol::Beacon& beacon) {
  return {JournalKind::kBeacon, dds::content_of(beacon)};
}
std::pair<JournalKind, Bytes> told(const protocol::PlanOffer& offer) {
  return {JournalKind::kPlanOffer, dds::content_of(offer)};
}
std::pair<JournalKind, Bytes> told(const protocol::CarrierState& state) {
  return {JournalKind::kCarrierState, dds::content_of(state)};
}
std::pair<JournalKind, Bytes> told(const Heard<protocol::Beacon>& beacon) {
  return {JournalKind::kBeaconArrived, dds::content_of(beacon.arrived, beacon.message)};
}
std::pair<JournalKind, Bytes> told(const Heard<protocol::CarrierState>& state) {
  return {JournalKind::kCarrierStateArrived, dds::content_of(state.arrived, state.message)};
}
std::pair<JournalKind, Bytes> told(const PlanVerdict& /*verdict*/) {
  return {JournalKind::kVerdict, {}};
}

std::optional<Event> tick_of(const Bytes& bytes) {
  if (bytes.empty()) return Tick{};
  ByteReader reader(bytes);
  const Tick tick{reader.number<std::uint64_t>()};
  return reader.good() && reader.left() == 0 ? std::optional<Event>(tick) : std::nullopt;
}

}  // namespace

std::uint8_t said(const Outputs& out) {
  unsigned bits = 0;
  if (out.time_request) bits |= Said::kTimeRequest;
  if (out.setpoint) bits |= Said::kSetpoint;
  if (out.status) bits |= Said::kStatus;
  if (out.held) bits |= Said::kHeldPlans;
  if (out.question) bits |= Said::kQuestion;
  return static_cast<std::uint8_t>(bits);
}

protocol::JournalEntry beginning(LocalTime now, const AgentOptions& options) {
  json limits = json::object();
  each_limit(options, [&](const char* name, const std::optional<double>& value) {
    if (value) limits[name] = *value;
  });
  const json told = {{"gyre", version()},
                     {"carrier", options.carrier},
                     {"incarnation", options.incarnation},
                     {"address", options.address},
                     {"limits", std::move(limits)}};
  const std::string words = told.dump(-1, ' ', false, json::error_handler_t::replace);
  return {now, static_cast<std::uint8_t>(JournalKind::kBeginning), 0, Bytes(words.begin(), words.end())};
}

protocol::JournalEntry entry_of(LocalTime now, const Event& event, const Outputs& out) {
  auto [kind, content] = std::visit([](const auto& e) { return told(e); }, event);
  return {now, static_cast<std::uint8_t>(kind), said(out), std::move(content)};
}

Result<JournalBeginning> beginning_of(const protocol::JournalEntry& entry) {
  const json told = json::parse(entry.content.begin(), entry.content.end(), nullptr, false);
  const bool is_one = entry.kind == static_cast<std::uint8_t>(JournalKind::kBeginning) && told.is_object();
  if (!is_one) return Error{"the journal does not begin with the options of an agent"};
  JournalBeginning out;
  try {
    out.version = told.at("gyre").get<std::string>();
    out.options.carrier = told.at("carrier").get<CarrierId>();
    out.options.incarnation = told.at("incarnation").get<std::uint64_t>();
    out.options.address = told.at("address").get<std::string>();
    const json& limits = told.at("limits");
    each_limit(out.options, [&](const char* name, std::optional<double>& value) {
      if (limits.contains(name)) value = limits.at(name).get<double>();
    });
  } catch (const json::exception& e) {
    return Error{std::string("the journal's beginning names no options of an agent: ") + e.what()};
  }
  return out;
}

std::optional<Event> event_of(const protocol::JournalEntry& entry) {
  switch (static_cast<JournalKind>(entry.kind)) {
    case JournalKind::kTick:
      return tick_of(entry.content);
    case JournalKind::kBeacon:
      return dds::heard<Event, protocol::Beacon>(entry.content);
    case JournalKind::kPlanOffer:
      return dds::heard<Event, protocol::PlanOffer>(entry.content);
    case JournalKind::kTimeReply:
      return dds::heard_when<Event, protocol::TimeReply, TimeReplyArrived>(entry.content);
    case JournalKind::kCarrierState:
      return dds::heard<Event, protocol::CarrierState>(entry.content);
    case JournalKind::kBeaconArrived:
      return dds::heard_when<Event, protocol::Beacon, Heard<protocol::Beacon>>(entry.content);
    case JournalKind::kCarrierStateArrived:
      return dds::heard_when<Event, protocol::CarrierState, Heard<protocol::CarrierState>>(entry.content);
    default:
      return std::nullopt;
  }
}

}  // namespace gyre::agent
