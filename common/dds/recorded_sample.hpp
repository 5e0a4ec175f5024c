#pragma once
// A sample as it crossed the wire, for who keeps it: its bytes, and what RTPS says of them.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/time.hpp"
#include "common/dds/topics.hpp"

namespace gyre::dds {

struct RecordedTopic {
  std::string name;  ///< "rt/gyre/carrier_3/setpoint"
  std::string type;  ///< "gyre_msgs::msg::dds_::CarrierSetpoint_"
  Delivery delivery = Delivery::kNewest;
};

struct RecordedSample {
  std::shared_ptr<const RecordedTopic> topic;
  std::array<std::uint8_t, 16> writer{};  ///< its RTPS GUID: one per writer and life of its process
  std::uint64_t sequence = 0;             ///< the writer's, from 1 on without a gap: what is missing did not arrive
  std::int64_t source_ns = 0;             ///< when it was written, since 1970, by the writer's wall clock
  LocalTime arrived{};
  std::vector<std::uint8_t> payload;  ///< CDR, with the four bytes that say which
};

/// Room in a recorder's reader. Samples are taken as they come, so this is for what arrives together, of many writers
/// on one topic; memory is set aside only when it is needed.
inline constexpr int kRecordingDepth = 256;

}  // namespace gyre::dds
