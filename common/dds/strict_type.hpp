#pragma once
// A generated type support that takes nothing but samples that really have the type.
//
// DDS matches by name, never by layout: a sample of another layout decodes into nonsense, silently. And the generated
// code lets most of Fast CDR's exceptions escape into the receive thread. So: whatever does not decode, or decodes to a
// size other than it came in, is counted and refused.

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <utility>

#include "common/dds/fastdds_version.hpp"

namespace gyre::dds {

template <class Support>
class StrictType final : public Support {
 public:
  explicit StrictType(std::shared_ptr<std::atomic<std::uint64_t>> refused) : refused_(std::move(refused)) {}

  bool deserialize(fast::Payload payload, void* sample) override {
    const bool good = decodes(payload, sample);
    if (!good) ++*refused_;
    return good;
  }

 private:
  bool decodes(fast::Payload payload, void* sample) {
    try {
      if (!Support::deserialize(payload, sample)) return false;
    } catch (const std::exception&) {
      return false;
    }
    // RTPS pads a payload to a multiple of four, and not every vendor says by how much.
    constexpr std::uint32_t kMaxPadding = 3;
    const std::uint32_t expected = fast::wire_size(*this, *static_cast<const typename Support::type*>(sample));
    const std::uint32_t length = fast::payload_length(payload);
    return length >= expected && length <= expected + kMaxPadding;
  }

  std::shared_ptr<std::atomic<std::uint64_t>> refused_;
};

}  // namespace gyre::dds
