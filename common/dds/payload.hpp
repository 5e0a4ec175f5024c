#pragma once
// Between a message and the bytes of a sample, outside of any node: for what was recorded.

#include <cstdint>
#include <optional>
#include <vector>

namespace gyre::dds {

/// Absent for bytes that are no such message, exactly as a node that reads would refuse them.
template <class Message>
[[nodiscard]] std::optional<Message> decode_payload(const std::vector<std::uint8_t>& payload);

/// Absent for a message that is over a bound of its type.
template <class Message>
[[nodiscard]] std::optional<std::vector<std::uint8_t>> encode_payload(const Message& message);

}  // namespace gyre::dds
