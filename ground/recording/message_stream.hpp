#pragma once
// A recording as what was heard: message by message, in the order in which whoever looked on was, or would have been,
// told.

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "ground/recording/core/mcap_stream.hpp"
#include "ground/recording/message_decoder.hpp"
#include "ground/swarm/core/swarm_view.hpp"

namespace gyre::ground {

/// `Variant` is of the messages that are wanted.
template <class Variant>
class MessageStream {
 public:
  struct Item {
    Variant message;
    LocalTime arrived{};
  };

  /// `source` outlives it. Errors as McapStream::open.
  [[nodiscard]] static Result<MessageStream> open(const McapSource& source) {
    auto file = McapStream::open(source);
    if (!file) return file.error();
    return MessageStream(std::move(file).value());
  }

  /// The next that is wanted, with its log time; that of an earlier one where it goes back. Absent: there are no more,
  /// and file() says how it ended.
  [[nodiscard]] std::optional<Item> next();

  [[nodiscard]] const McapStream& file() const { return file_; }
  /// Messages of a type that is wanted, whose bytes are none: another version of gyre recorded them, or somebody lies.
  [[nodiscard]] std::uint64_t undecodable() const { return undecodable_; }

 private:
  explicit MessageStream(McapStream file) : file_(std::move(file)) {}
  /// nullptr: nothing that is wanted.
  [[nodiscard]] MessageDecoder<Variant> decoder(std::uint16_t channel);

  McapStream file_;
  std::map<std::uint16_t, MessageDecoder<Variant>> decoders_;
  LocalTime latest_{};
  std::uint64_t undecodable_ = 0;
};

/// What a view of the swarm is stepped by.
using SwarmStream = MessageStream<SwarmMessage>;

template <class Variant>
std::optional<typename MessageStream<Variant>::Item> MessageStream<Variant>::next() {
  while (const auto message = file_.next()) {
    const MessageDecoder<Variant> decode = decoder(message->channel);
    if (decode == nullptr) continue;
    auto decoded = decode(message->payload);
    const bool in_time = message->log_ns <= static_cast<std::uint64_t>(kLongest.count());
    if (!decoded || !in_time) {
      ++undecodable_;
      continue;
    }
    latest_ = std::max(latest_, LocalTime(Duration(static_cast<Duration::rep>(message->log_ns))));
    return Item{std::move(*decoded), latest_};
  }
  return std::nullopt;
}

template <class Variant>
MessageDecoder<Variant> MessageStream<Variant>::decoder(std::uint16_t channel) {
  const auto known = decoders_.find(channel);
  if (known != decoders_.end()) return known->second;
  const McapDirectory& directory = file_.directory();
  const auto told = directory.channels().find(channel);
  if (told == directory.channels().end()) return nullptr;
  const auto schema = directory.schemas().find(told->second.schema);
  const bool readable = schema != directory.schemas().end() && told->second.encoding == "cdr";
  return decoders_[channel] = readable ? MessageDecoders<Variant>::find(schema->second.name) : nullptr;
}

}  // namespace gyre::ground
