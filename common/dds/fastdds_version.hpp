#pragma once
// The names that differ between Fast DDS releases, in one place: a port to 3.x changes this header, the generator's
// options in idl/CMakeLists.txt, and nothing outside common/dds.
//
// This is 2.9 (Debian 12). In 3.x the headers end in .hpp, eprosima::fastrtps::rtps is eprosima::fastdds::rtps,
// payloads are passed by reference, profiles are called differently, and write() answers a return code instead of a
// bool.

#include <fastdds/rtps/attributes/RTPSParticipantAttributes.h>
#include <fastdds/rtps/common/SerializedPayload.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <gyre_idl/gyre_msgs.h>
#include <gyre_idl/gyre_msgsPubSubTypes.h>

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

namespace gyre::dds::fast {

namespace api = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
namespace idl = gyre_msgs::msg;

using Payload = rtps::SerializedPayload_t*;  // 3.x: a reference
using Time = eprosima::fastrtps::Duration_t;
using LocatorList = rtps::LocatorList_t;
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;

[[nodiscard]] inline std::uint32_t payload_length(Payload payload) {
  return payload->length;
}

/// Bytes of the sample on the wire, encapsulation header included, without the padding that may follow.
template <class Type>
[[nodiscard]] std::uint32_t wire_size(const Type& sample) {
  constexpr std::uint32_t kEncapsulationBytes = 4;
  return kEncapsulationBytes + static_cast<std::uint32_t>(Type::getCdrSerializedSize(sample));
}

[[nodiscard]] inline bool write(api::DataWriter& writer, void* sample) {
  return writer.write(sample);
}

[[nodiscard]] inline bool take(api::DataReader& reader, void* sample, api::SampleInfo& info) {
  return reader.take_next_sample(sample, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
}

/// Port 0: Fast DDS derives the ports from the domain and the participant ids it tries.
[[nodiscard]] inline rtps::Locator_t udp_locator(const std::string& ipv4, int port) {
  rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = static_cast<std::uint32_t>(port);
  rtps::IPLocator::setIPv4(locator, ipv4);
  return locator;
}

/// The defaults with the user's XML profiles applied. Copying PARTICIPANT_QOS_DEFAULT would ignore the profiles.
[[nodiscard]] inline api::DomainParticipantQos profiled_participant_qos() {
  auto* factory = api::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  return factory->get_default_participant_qos();
}

}  // namespace gyre::dds::fast
