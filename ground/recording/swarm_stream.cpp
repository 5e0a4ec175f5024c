#include "ground/recording/swarm_stream.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "common/dds/payload.hpp"
#include "common/dds/topics.hpp"
#include "ground/recording/core/schemas.hpp"

namespace gyre::ground {
namespace {

template <class Known>
std::optional<SwarmMessage> decode(const std::vector<std::uint8_t>& payload) {
  auto message = dds::decode_payload<Known>(payload);
  return message ? std::optional<SwarmMessage>(std::move(*message)) : std::nullopt;
}

using Decoder = std::optional<SwarmMessage> (*)(const std::vector<std::uint8_t>&);

template <class... Messages>
Decoder decoder_of(const std::string& type, const std::variant<Messages...>* /*every message*/) {
  Decoder found = nullptr;
  ((type_of_wire_name(dds::kTopic<Messages>.type) == type ? void(found = &decode<Messages>) : void()), ...);
  return found;
}

std::optional<LocalTime> log_time(const Message& message) {
  const auto most = static_cast<std::uint64_t>(kLongest.count());
  if (message.log_ns > most) return std::nullopt;
  return LocalTime(Duration(static_cast<Duration::rep>(message.log_ns)));
}

}  // namespace

Result<SwarmStream> SwarmStream::open(const McapSource& source) {
  auto file = McapStream::open(source);
  if (!file) return file.error();
  return SwarmStream(std::move(file).value());
}

SwarmStream::Decode SwarmStream::decoder(std::uint16_t channel) {
  const auto known = decoders_.find(channel);
  if (known != decoders_.end()) return known->second;
  const McapDirectory& directory = file_.directory();
  const auto told = directory.channels().find(channel);
  if (told == directory.channels().end()) return nullptr;
  const auto schema = directory.schemas().find(told->second.schema);
  const bool readable = schema != directory.schemas().end() && told->second.encoding == "cdr";
  const SwarmMessage* const any = nullptr;
  return decoders_[channel] = readable ? decoder_of(schema->second.name, any) : nullptr;
}

std::optional<Heard> SwarmStream::next() {
  while (const auto message = file_.next()) {
    const Decode decode_it = decoder(message->channel);
    if (decode_it == nullptr) continue;
    auto decoded = decode_it(message->payload);
    const auto time = log_time(*message);
    if (!decoded || !time) {
      ++undecodable_;
      continue;
    }
    latest_ = std::max(latest_, *time);
    return Heard{std::move(*decoded), latest_};
  }
  return std::nullopt;
}

std::optional<protocol::MissionText> SwarmStream::next_mission() {
  while (const auto message = file_.next()) {
    if (decoder(message->channel) != &decode<protocol::MissionText>) continue;
    if (auto text = dds::decode_payload<protocol::MissionText>(message->payload)) return text;
  }
  return std::nullopt;
}

}  // namespace gyre::ground
