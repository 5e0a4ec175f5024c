#include "coordinator/journal.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/version.hpp"
#include "common/dds/journal_content.hpp"
#include "coordinator/judged_job.hpp"

namespace gyre::coordinator {
namespace {

using nlohmann::json;
using Told = std::pair<JournalKind, Bytes>;

Told told(const Tick& /*tick*/) {
  return {JournalKind::kTick, {}};
}
Told told(const Shutdown& /*shutdown*/) {
  return {JournalKind::kShutdown, {}};
}
Told told(const TimeRequestArrived& request) {
  return {JournalKind::kTimeRequest, dds::content_of(request.arrived, request.request)};
}
Told told(const Retune& retune) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.number(retune.command);
  const bool there = static_cast<bool>(retune.job);
  writer.number(static_cast<std::uint8_t>(there));
  writer.text(there ? retune.job.value().mission_text : retune.job.error().text);
  return {JournalKind::kRetune, std::move(bytes)};
}
Told told(const StatusArrived& status) {
  return {JournalKind::kAgentStatus, dds::content_of(status.arrived, status.status)};
}
Told told(const protocol::HeldPlans& held) {
  return {JournalKind::kHeldPlans, dds::content_of(held)};
}
Told told(const protocol::Command& command) {
  return {JournalKind::kCommand, dds::content_of(command)};
}
Told told(const protocol::Beacon& beacon) {
  return {JournalKind::kBeacon, dds::content_of(beacon)};
}
Told told(const protocol::Health& health) {
  return {JournalKind::kHealth, dds::content_of(health)};
}
Told told(const protocol::CarrierState& state) {
  return {JournalKind::kCarrierState, dds::content_of(state)};
}

std::optional<Event> retune_of(const Bytes& content) {
  ByteReader reader(content);
  const auto command = reader.number<std::uint64_t>();
  const bool there = reader.number<std::uint8_t>() != 0;
  const std::string text = reader.text();
  if (!reader.good() || reader.left() > 0) return std::nullopt;
  return Retune{command, there ? judged_job(text) : Result<Job>(Error{text})};
}

}  // namespace

std::uint8_t said(const Outputs& out) {
  unsigned bits = 0;
  if (out.time_reply) bits |= Said::kTimeReply;
  if (!out.offers.empty()) bits |= Said::kOffers;
  if (out.beacon) bits |= Said::kBeacon;
  if (out.status) bits |= Said::kStatus;
  if (out.mission) bits |= Said::kMission;
  if (!out.replies.empty()) bits |= Said::kReplies;
  if (out.finished) bits |= Said::kFinished;
  return static_cast<std::uint8_t>(bits);
}

protocol::JournalEntry beginning(LocalTime now, const Job& job, const CoordinatorOptions& options) {
  const json told = {{"gyre", version()},
                     {"mission", job.mission_text},
                     {"nonce", options.nonce},
                     {"engage", options.engage_when_ready}};
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
  if (!is_one) return Error{"the journal does not begin with the options of a coordinator"};
  JournalBeginning out;
  std::string mission;
  try {
    out.version = told.at("gyre").get<std::string>();
    mission = told.at("mission").get<std::string>();
    out.options.nonce = told.at("nonce").get<std::uint64_t>();
    out.options.engage_when_ready = told.at("engage").get<bool>();
  } catch (const json::exception& e) {
    return Error{std::string("the journal's beginning names no options of a coordinator: ") + e.what()};
  }
  auto job = judged_job(mission);
  if (!job) return Error{"the mission in the journal's beginning: " + job.error().text};
  out.job = std::move(job).value();
  return out;
}

std::optional<Event> event_of(const protocol::JournalEntry& entry) {
  switch (static_cast<JournalKind>(entry.kind)) {
    case JournalKind::kTick:
      return Tick{};
    case JournalKind::kAgentStatus:
      return dds::heard_when<Event, protocol::AgentStatus, StatusArrived>(entry.content);
    case JournalKind::kHeldPlans:
      return dds::heard<Event, protocol::HeldPlans>(entry.content);
    case JournalKind::kTimeRequest:
      return dds::heard_when<Event, protocol::TimeRequest, TimeRequestArrived>(entry.content);
    case JournalKind::kCommand:
      return dds::heard<Event, protocol::Command>(entry.content);
    case JournalKind::kRetune:
      return retune_of(entry.content);
    case JournalKind::kBeacon:
      return dds::heard<Event, protocol::Beacon>(entry.content);
    case JournalKind::kHealth:
      return dds::heard<Event, protocol::Health>(entry.content);
    case JournalKind::kCarrierState:
      return dds::heard<Event, protocol::CarrierState>(entry.content);
    case JournalKind::kShutdown:
      return Shutdown{};
    default:
      return std::nullopt;
  }
}

}  // namespace gyre::coordinator
