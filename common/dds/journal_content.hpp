#pragma once
// Messages as the content of a journal's entries: as they cross the wire, so exactly what a node decodes.

#include <optional>
#include <utility>

#include "common/base/bytes.hpp"
#include "common/base/time.hpp"
#include "common/dds/payload.hpp"

namespace gyre::dds {

/// What was decoded can be encoded, the bounds are the same; empty for what was not.
template <class Message>
[[nodiscard]] Bytes content_of(const Message& message) {
  return encode_payload(message).value_or(Bytes{});
}

/// Of a message whose core is told when it arrived.
template <class Message>
[[nodiscard]] Bytes content_of(LocalTime arrived, const Message& message) {
  Bytes bytes;
  ByteWriter(bytes).number(static_cast<std::uint64_t>(arrived.time_since_epoch().count()));
  const Bytes payload = content_of(message);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

/// As one of the events of a core.
template <class Event, class Message>
[[nodiscard]] std::optional<Event> heard(const Bytes& content) {
  auto message = decode_payload<Message>(content);
  return message ? std::optional<Event>(std::move(*message)) : std::nullopt;
}

/// The same of an event `Arrived{message, when}`.
template <class Event, class Message, class Arrived>
[[nodiscard]] std::optional<Event> heard_when(const Bytes& content) {
  ByteReader reader(content);
  const LocalTime arrived(Duration(static_cast<Duration::rep>(reader.number<std::uint64_t>())));
  if (!reader.good() || !usable(arrived)) return std::nullopt;
  auto message =
      decode_payload<Message>(Bytes(content.begin() + static_cast<std::ptrdiff_t>(reader.at()), content.end()));
  return message ? std::optional<Event>(Arrived{std::move(*message), arrived}) : std::nullopt;
}

}  // namespace gyre::dds
