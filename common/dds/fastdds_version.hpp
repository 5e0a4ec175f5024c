#pragma once
// Every name that Fast DDS 2.9 (Debian 12) and 3.1 (Debian 13) spell differently, once. A third release changes this
// header, the generator's options in idl/CMakeLists.txt, and nothing else.
//
// What travels is the same on both: plain CDR (XCDR1, both releases' default for writers and readers), the same topic
// and type names, no type information in discovery. So processes built on one fly with processes built on the other.

#if __has_include(<fastdds/LibrarySettings.hpp>)
#define GYRE_FASTDDS_3
#include <fastdds/rtps/attributes/RTPSParticipantAttributes.hpp>
#include <fastdds/rtps/common/SerializedPayload.hpp>
#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/SenderResource.hpp>
#include <fastdds/rtps/transport/TransportReceiverInterface.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#include <gyre_idl/gyre_msgs.hpp>
#include <gyre_idl/gyre_msgsPubSubTypes.hpp>
#else
#include <fastdds/rtps/attributes/RTPSParticipantAttributes.h>
#include <fastdds/rtps/common/SerializedPayload.h>
#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <gyre_idl/gyre_msgs.h>
#include <gyre_idl/gyre_msgsPubSubTypes.h>
#endif

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
#include <string>
#include <utility>
#include <vector>

namespace gyre::dds::fast {

namespace api = eprosima::fastdds::dds;
namespace idl = gyre_msgs::msg;
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;

// ---- 3.1: one namespace, payloads by reference, return codes everywhere, the representation named in every call
#ifdef GYRE_FASTDDS_3

namespace rtps = eprosima::fastdds::rtps;

using Payload = rtps::SerializedPayload_t&;
using Time = api::Duration_t;
/// What a transport is given to send: the buffers that make up one datagram.
using Datagram = const std::vector<rtps::NetworkBuffer>&;

inline constexpr api::ReturnCode_t kOk = api::RETCODE_OK;
inline constexpr api::DataRepresentationId_t kXcdr1 = api::DataRepresentationId_t::XCDR_DATA_REPRESENTATION;

[[nodiscard]] inline Payload passed(rtps::SerializedPayload_t& payload) {
  return payload;
}
[[nodiscard]] inline std::uint32_t payload_length(Payload payload) {
  return payload.length;
}
[[nodiscard]] inline const std::uint8_t* payload_bytes(Payload payload) {
  return payload.data;
}

/// Bytes of the sample on the wire, encapsulation header included, without the padding that may follow.
template <class Support>
[[nodiscard]] std::uint32_t wire_size(Support& support, const typename Support::type& sample) {
  return support.calculate_serialized_size(&sample, kXcdr1);
}

template <class Support>
[[nodiscard]] bool serialize(Support& support, typename Support::type& sample, Payload payload) {
  return support.serialize(&sample, payload, kXcdr1);
}

[[nodiscard]] inline bool write(api::DataWriter& writer, void* sample) {
  return writer.write(sample) == kOk;
}

[[nodiscard]] inline Time& heartbeat_period(api::DataWriterQos& qos) {
  return qos.reliable_writer_qos().times.heartbeat_period;
}

/// What a transport sends through, in the hands of whoever wants to see what is sent.
class Sender final : public rtps::SenderResource {
 public:
  template <class Send>
  explicit Sender(Send send) : SenderResource(LOCATOR_KIND_UDPv4) {
    send_buffers_lambda_ = std::move(send);
  }
};

// ---- 2.9: two namespaces, payloads by pointer, and a write() that answers true where 3.1 answers 0
#else

namespace rtps = eprosima::fastrtps::rtps;

using Payload = rtps::SerializedPayload_t*;
using Time = eprosima::fastrtps::Duration_t;
/// What a transport is given to send: the bytes of one datagram.
using Datagram = const rtps::octet*;

inline constexpr auto kOk = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;

[[nodiscard]] inline Payload passed(rtps::SerializedPayload_t& payload) {
  return &payload;
}
[[nodiscard]] inline std::uint32_t payload_length(Payload payload) {
  return payload->length;
}
[[nodiscard]] inline const std::uint8_t* payload_bytes(Payload payload) {
  return payload->data;
}

/// Bytes of the sample on the wire, encapsulation header included, without the padding that may follow.
template <class Support>
[[nodiscard]] std::uint32_t wire_size(Support& /*support*/, const typename Support::type& sample) {
  constexpr std::uint32_t kEncapsulationBytes = 4;
  return kEncapsulationBytes + static_cast<std::uint32_t>(Support::type::getCdrSerializedSize(sample));
}

template <class Support>
[[nodiscard]] bool serialize(Support& support, typename Support::type& sample, Payload payload) {
  return support.serialize(&sample, payload);
}

[[nodiscard]] inline bool write(api::DataWriter& writer, void* sample) {
  return writer.write(sample);
}

[[nodiscard]] inline Time& heartbeat_period(api::DataWriterQos& qos) {
  return qos.reliable_writer_qos().times.heartbeatPeriod;
}

/// What a transport sends through, in the hands of whoever wants to see what is sent.
class Sender final : public rtps::SenderResource {
 public:
  template <class Send>
  explicit Sender(Send send) : SenderResource(LOCATOR_KIND_UDPv4) {
    send_lambda_ = std::move(send);
  }
};

#endif
// ---- the same on both

using LocatorList = rtps::LocatorList_t;
using Locators = eprosima::fastdds::rtps::Locators;
using LocatorsIterator = eprosima::fastdds::rtps::LocatorsIterator;
using Transport = eprosima::fastdds::rtps::TransportInterface;
using TransportDescriptor = eprosima::fastdds::rtps::TransportDescriptorInterface;
using TransportReceiver = eprosima::fastdds::rtps::TransportReceiverInterface;
using ChainingTransport = eprosima::fastdds::rtps::ChainingTransport;
using ChainingDescriptor = eprosima::fastdds::rtps::ChainingTransportDescriptor;

[[nodiscard]] inline bool take(api::DataReader& reader, void* sample, api::SampleInfo& info) {
  return reader.take_next_sample(sample, &info) == kOk;
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
