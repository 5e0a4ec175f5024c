#pragma once
// From the bytes of a recorded message to the message, for those of the types a reader knows.

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/dds/payload.hpp"
#include "common/dds/topics.hpp"
#include "ground/recording/core/schemas.hpp"

namespace gyre::ground {

/// Absent: bytes of another version, or of somebody who lies.
template <class Variant>
using MessageDecoder = std::optional<Variant> (*)(const std::vector<std::uint8_t>& payload);

/// The one for a type by its full name, "gyre_msgs/msg/Beacon"; nullptr: `Variant`, a std::variant of messages, has no
/// such alternative.
template <class Variant>
class MessageDecoders;

template <class... Messages>
class MessageDecoders<std::variant<Messages...>> {
 public:
  using Variant = std::variant<Messages...>;

  [[nodiscard]] static MessageDecoder<Variant> find(const std::string& type) {
    MessageDecoder<Variant> found = nullptr;
    ((type_of_wire_name(dds::kTopic<Messages>.type) == type ? void(found = &decode<Messages>) : void()), ...);
    return found;
  }

 private:
  template <class Message>
  static std::optional<Variant> decode(const std::vector<std::uint8_t>& payload) {
    auto message = dds::decode_payload<Message>(payload);
    return message ? std::optional<Variant>(std::move(*message)) : std::nullopt;
  }
};

}  // namespace gyre::ground
