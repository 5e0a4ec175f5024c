#include "ground/replay/core_replay.hpp"

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "agent/journal.hpp"
#include "common/base/text.hpp"
#include "common/protocol/journal.hpp"
#include "coordinator/journal.hpp"
#include "ground/recording/message_stream.hpp"

namespace gyre::ground {
namespace {

using protocol::JournalEntry;

/// The journals of one process, and all that may be its words.
using ReplayMessage = std::variant<protocol::JournalPiece, protocol::TimeRequest, protocol::Setpoint,
                                   protocol::AgentStatus, protocol::TimeReply, protocol::PlanOffer, protocol::Beacon,
                                   protocol::CoordinatorStatus, protocol::MissionText, protocol::CommandReply>;

struct Life {
  protocol::JournalReader reader;
  std::vector<JournalEntry> entries;
};

struct Found {
  std::vector<std::uint64_t> order;  ///< of the lives
  std::map<std::uint64_t, Life> lives;
  std::shared_ptr<RecordedWords> words = std::make_shared<RecordedWords>();
  std::set<std::string> others;  ///< that have a journal, too
  bool whole = true;             ///< the file has its end
};

/// What an agent says names its carrier; what the coordinator says to one is not the agent's.
template <class Message>
bool wanted(const Message& message, std::optional<CarrierId> carrier) {
  constexpr bool kOfAgent = std::is_same_v<Message, protocol::TimeRequest> ||
                            std::is_same_v<Message, protocol::Setpoint> ||
                            std::is_same_v<Message, protocol::AgentStatus>;
  if constexpr (kOfAgent) return carrier == message.carrier;
  return !carrier;
}

void take(Found& found, const protocol::JournalPiece& piece, const std::string& process) {
  if (piece.process != process) {
    found.others.insert(piece.process);
    return;
  }
  const auto [life, begins] = found.lives.try_emplace(piece.incarnation);
  if (begins) found.order.push_back(piece.incarnation);
  life->second.reader.take(piece.offset, piece.bytes);
  while (auto entry = life->second.reader.next()) life->second.entries.push_back(std::move(*entry));
}

Result<Found> find(const McapSource& source, const std::string& process, std::optional<CarrierId> carrier) {
  auto opened = MessageStream<ReplayMessage>::open(source);
  if (!opened) return opened.error();
  MessageStream<ReplayMessage> stream = std::move(opened).value();
  Found found;
  while (const auto item = stream.next()) {
    std::visit(
        [&](const auto& message) {
          if constexpr (std::is_same_v<std::decay_t<decltype(message)>, protocol::JournalPiece>) {
            take(found, message, process);
          } else if (wanted(message, carrier)) {
            keep(*found.words, message);
          }
        },
        item->message);
  }
  found.whole = stream.file().whole();
  return found;
}

/// What a core says as it crosses the wire: texts for people are cut there.
template <class Message>
void said(Comparison& comparison, LocalTime at, const char* kind, const Message& message) {
  const auto payload = dds::encode_payload(message);
  if (!payload) return;
  if (const auto sent = dds::decode_payload<Message>(*payload)) comparison.said(at, kind, *sent);
}

/// The agent's core with what its process did beside it: a question is judged when the journal says so.
class SteppedAgent {
 public:
  static constexpr std::array kKinds{"",
                                     "ticks",
                                     "beacons",
                                     "plan offers",
                                     "time replies",
                                     "states of its vehicle",
                                     "verdicts on plans",
                                     "beacons",
                                     "states of its vehicle"};
  static inline const std::vector<std::string> kOutputs{"a time request", "a setpoint", "a status", "held plans",
                                                        "a question about a plan"};

  explicit SteppedAgent(const agent::JournalBeginning& beginning) : agent_(beginning.options) {}

  /// False: no entry of an agent.
  [[nodiscard]] bool step(const JournalEntry& entry, Comparison& comparison) {
    auto event = agent::event_of(entry);
    if (!event && entry.kind == static_cast<std::uint8_t>(agent::JournalKind::kVerdict)) {
      if (!asked_) {
        comparison.otherwise(entry.at, "asks no question about a plan, and was told a verdict on one then");
        return true;
      }
      event = agent::judge(*std::exchange(asked_, std::nullopt));
    }
    if (!event) return false;
    const agent::Outputs out = agent_.step(entry.at, *event);
    if (out.question) asked_ = out.question;
    comparison.step(entry.at, entry.said, agent::said(out), kOutputs);
    if (out.time_request) said(comparison, entry.at, "time requests", *out.time_request);
    if (out.setpoint) said(comparison, entry.at, "setpoints", *out.setpoint);
    if (out.status) said(comparison, entry.at, "statuses", *out.status);
    comparison.noticed(entry.at, out.notices);
    return true;
  }

 private:
  agent::Agent agent_;
  std::optional<agent::PlanQuestion> asked_;
};

class SteppedCoordinator {
 public:
  static constexpr std::array kKinds{"",          "ticks",          "statuses", "held plans",      "time requests",
                                     "commands",  "judged retunes", "beacons",  "words of health", "states of vehicles",
                                     "interrupts"};
  static inline const std::vector<std::string> kOutputs{
      "a time reply", "plan offers", "a beacon", "a status", "the mission", "an answer", "that it has finished"};

  explicit SteppedCoordinator(const coordinator::JournalBeginning& beginning)
      : coordinator_(beginning.job, beginning.options) {}

  [[nodiscard]] bool step(const JournalEntry& entry, Comparison& comparison) {
    const auto event = coordinator::event_of(entry);
    if (!event) return false;
    const coordinator::Outputs out = coordinator_.step(entry.at, *event);
    comparison.step(entry.at, entry.said, coordinator::said(out), kOutputs);
    if (out.time_reply) said(comparison, entry.at, "time replies", *out.time_reply);
    for (const protocol::PlanOffer& offer : out.offers) said(comparison, entry.at, "plan offers", offer);
    if (out.beacon) said(comparison, entry.at, "beacons", *out.beacon);
    if (out.status) said(comparison, entry.at, "statuses", *out.status);
    if (out.mission) said(comparison, entry.at, "missions", *out.mission);
    for (const protocol::CommandReply& reply : out.replies) said(comparison, entry.at, "answers", reply);
    comparison.noticed(entry.at, out.notices);
    return true;
  }

 private:
  coordinator::Coordinator coordinator_;
};

std::string cut_of(const Life& life, bool whole) {
  if (life.reader.gap()) return "a piece of it was not recorded";
  if (life.reader.broken()) return "what follows is no journal";
  return whole ? "" : "the recording was cut off";
}

template <class Stepped, class Beginning>
Result<Replayed> replay_life(const Life& life, const Found& found, const std::string& process,
                             Result<Beginning> (*beginning_of)(const JournalEntry&)) {
  const auto beginning = beginning_of(life.entries.front());
  if (!beginning) return beginning.error();
  Replayed out{process, beginning.value().version, {}, Comparison(found.words), cut_of(life, found.whole)};
  Stepped core(beginning.value());
  for (auto entry = life.entries.begin() + 1; entry != life.entries.end(); ++entry) {
    if (!core.step(*entry, out.comparison)) {
      out.cut = text("entry %td is none of this version", entry - life.entries.begin());
      break;
    }
    ++out.heard[Stepped::kKinds[entry->kind]];
  }
  return out;
}

Error none_of(const Found& found, const std::string& process) {
  if (!found.lives.empty()) {
    return Error{"the journal of " + process +
                 " does not begin with its process: begin to record before it starts, or within half a minute"};
  }
  if (found.others.empty()) {
    return Error{
        "no journal is recorded in it: begin to record before the processes start, or within half a minute, and do not "
        "leave the journals out"};
  }
  std::string others;
  for (const std::string& other : found.others) others += (others.empty() ? "" : ", ") + other;
  return Error{"no journal of " + process + " is recorded in it, but of " + others};
}

}  // namespace

Result<std::vector<Replayed>> replay_core(const McapSource& source, std::optional<CarrierId> carrier) {
  const std::string process = carrier ? "agent " + std::to_string(*carrier) : "coordinator";
  const auto found = find(source, process, carrier);
  if (!found) return found.error();
  std::vector<Replayed> out;
  for (const std::uint64_t incarnation : found.value().order) {
    const Life& life = found.value().lives.at(incarnation);
    if (life.entries.empty()) continue;
    auto replayed = carrier ? replay_life<SteppedAgent>(life, found.value(), process, &agent::beginning_of)
                            : replay_life<SteppedCoordinator>(life, found.value(), process, &coordinator::beginning_of);
    if (!replayed) return replayed.error();
    out.push_back(std::move(replayed).value());
  }
  if (out.empty()) return none_of(found.value(), process);
  return out;
}

}  // namespace gyre::ground
