#pragma once
// A generated type support that leaves a sample's bytes as they are.
//
// Fast DDS knows one type support per type name and participant, so a node that records cannot read the same messages
// as well: who needs both decodes the bytes (payload.hpp). The generated support stays underneath, for its bound: what
// is longer than the type can be is refused before it is kept.

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/dds/fastdds_version.hpp"

namespace gyre::dds {

struct RawSample {
  std::vector<std::uint8_t> bytes;
};

template <class Support>
class RawType final : public Support {
 public:
  explicit RawType(const std::shared_ptr<std::atomic<std::uint64_t>>& /*refused*/) {}

  bool deserialize(fast::Payload payload, void* sample) override {
    const std::uint8_t* const begin = fast::payload_bytes(payload);
    static_cast<RawSample*>(sample)->bytes.assign(begin, begin + fast::payload_length(payload));
    return true;
  }
};

}  // namespace gyre::dds
