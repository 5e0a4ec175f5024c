#include "ground/report/recorded_flight.hpp"

#include <memory>
#include <utility>
#include <variant>

#include "common/dds/payload.hpp"
#include "common/dds/topics.hpp"
#include "ground/recording/core/mcap_stream.hpp"
#include "ground/recording/core/schemas.hpp"

namespace gyre::ground {
namespace {

/// What a channel carries, as far as a report is made of it.
using Decode = std::optional<SwarmMessage> (*)(const std::vector<std::uint8_t>&);

template <class Message>
std::optional<SwarmMessage> decode(const std::vector<std::uint8_t>& payload) {
  auto message = dds::decode_payload<Message>(payload);
  return message ? std::optional<SwarmMessage>(std::move(*message)) : std::nullopt;
}

template <class... Messages>
Decode decoder_of(const std::string& type, const std::variant<Messages...>* /*every message*/) {
  Decode found = nullptr;
  ((type_of_wire_name(dds::kTopic<Messages>.type) == type ? void(found = &decode<Messages>) : void()), ...);
  return found;
}

class Channels {
 public:
  /// nullptr: nothing that a report is made of.
  Decode decoder(const McapDirectory& directory, std::uint16_t id) {
    const auto known = decoders_.find(id);
    if (known != decoders_.end()) return known->second;
    const auto channel = directory.channels().find(id);
    if (channel == directory.channels().end()) return nullptr;
    const auto schema = directory.schemas().find(channel->second.schema);
    const bool readable = schema != directory.schemas().end() && channel->second.encoding == "cdr";
    const SwarmMessage* const any = nullptr;
    return decoders_[id] = readable ? decoder_of(schema->second.name, any) : nullptr;
  }

 private:
  std::map<std::uint16_t, Decode> decoders_;
};

std::optional<LocalTime> heard(const Message& message) {
  const auto most = static_cast<std::uint64_t>(kLongest.count());
  if (message.log_ns > most) return std::nullopt;
  return LocalTime(Duration(static_cast<Duration::rep>(message.log_ns)));
}

/// The first that the swarm told. The digest has to know it from the first message on, and it may come late.
std::optional<mission::Mission> told_mission(const McapSource& source) {
  auto opened = McapStream::open(source);
  if (!opened) return std::nullopt;
  McapStream stream = std::move(opened).value();
  Channels channels;
  while (const auto message = stream.next()) {
    const Decode decoder = channels.decoder(stream.directory(), message->channel);
    if (decoder != &decode<protocol::MissionText>) continue;
    const auto decoded = decoder(message->payload);
    const auto* const text = decoded ? std::get_if<protocol::MissionText>(&*decoded) : nullptr;
    if (!text || text->text.empty()) continue;
    auto mission = mission::parse_mission(text->text, "the recording's mission");
    if (mission) return std::move(mission).value();
  }
  return std::nullopt;
}

void learn_of_file(const McapStream& stream, FileFacts& file) {
  file.whole = stream.whole();
  for (const McapProblem& problem : stream.problems().first()) file.problems.push_back(told(problem));
  file.problem_count = stream.problems().count();
  for (const Metadata& metadata : stream.directory().metadata()) {
    if (metadata.name == "gyre") file.begin = metadata.entries;
    if (metadata.name == "gyre_recording") file.last_word = metadata.entries;
  }
}

}  // namespace

Result<Account> read_flight(const std::string& path, const McapSource& source,
                            const std::optional<mission::Mission>& given) {
  auto opened = McapStream::open(source);
  if (!opened) return Error{path + ": " + opened.error().text};
  McapStream stream = std::move(opened).value();
  std::optional<mission::Mission> mission = told_mission(source);
  FileFacts file;
  file.path = path;
  file.mission_given = !mission && given;
  if (!mission) mission = given;
  auto digest = std::make_unique<FlightDigest>(std::move(mission));
  Channels channels;
  LocalTime latest{};
  while (const auto message = stream.next()) {
    const Decode decoder = channels.decoder(stream.directory(), message->channel);
    if (decoder == nullptr) continue;
    const auto decoded = decoder(message->payload);
    const auto time = heard(*message);
    if (!decoded || !time) {
      ++file.undecodable;
      continue;
    }
    ++file.messages;
    latest = std::max(latest, *time);
    digest->see(latest, *decoded);
  }
  learn_of_file(stream, file);
  if (file.messages == 0) {
    return Error{path + ": nothing of a swarm is recorded in it" +
                 (file.undecodable > 0 ? ", or it was recorded by another version of gyre" : "") +
                 "; name a file that gyre record has written while a swarm flew"};
  }
  return account(std::move(file), std::move(digest));
}

}  // namespace gyre::ground
