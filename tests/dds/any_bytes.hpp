#pragma once
// A type support that sends whatever bytes it is given, as a stranger would under our type's name.
//
// Nothing else derives from Fast DDS's interface by hand, so what its releases call differently is here and not in
// fastdds_version.hpp.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/dds/fastdds_version.hpp"

namespace gyre::tests {

class AnyBytes final : public dds::fast::api::TopicDataType {
 public:
  using Bytes = std::vector<unsigned char>;

  bool deserialize(dds::fast::Payload, void*) override { return false; }

  // The formatter would open every function between the directives.
  // clang-format off
#ifdef GYRE_FASTDDS_3
  using Representation = dds::fast::api::DataRepresentationId_t;

  AnyBytes() { max_serialized_type_size = kMostBytes; }
  bool serialize(const void* data, dds::fast::Payload payload, Representation) override { return put(data, payload); }
  std::uint32_t calculate_serialized_size(const void*, Representation) override { return kMostBytes; }
  void* create_data() override { return new Bytes; }
  void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
  bool compute_key(dds::fast::Payload, dds::fast::rtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void*, dds::fast::rtps::InstanceHandle_t&, bool) override { return false; }
#else
  AnyBytes() { m_typeSize = kMostBytes; }
  bool serialize(void* data, dds::fast::Payload payload) override { return put(data, *payload); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override { return [] { return kMostBytes; }; }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, dds::fast::rtps::InstanceHandle_t*, bool) override { return false; }
#endif
  // clang-format on

 private:
  static constexpr std::uint32_t kMostBytes = 1024;

  static bool put(const void* data, dds::fast::rtps::SerializedPayload_t& payload) {
    const auto& bytes = *static_cast<const Bytes*>(data);
    std::copy(bytes.begin(), bytes.end(), payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
};

}  // namespace gyre::tests
