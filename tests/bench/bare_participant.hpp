#pragma once
// The star's recipe written against Fast DDS itself, so that nothing of common/dds is in a floor: one participant on
// the loopback, without multicast and shared memory, that looks for the hubs.

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <memory>

namespace gyre::bench {

inline eprosima::fastdds::dds::DomainParticipant* open_bare_participant(int domain, int participant) {
  auto* factory = eprosima::fastdds::dds::DomainParticipantFactory::get_instance();
  eprosima::fastdds::dds::DomainParticipantQos qos = factory->get_default_participant_qos();
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.push_back("127.0.0.1");
  udp->maxInitialPeersRange = 4;
  udp->sendBufferSize = udp->receiveBufferSize = 1U << 20U;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  eprosima::fastrtps::rtps::Locator_t loopback;
  loopback.kind = LOCATOR_KIND_UDPv4;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(loopback, "127.0.0.1");
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(loopback);
  builtin.initialPeersList.push_back(loopback);
  builtin.discovery_config.leaseDuration = {20, 0};
  builtin.discovery_config.leaseDuration_announcementperiod = {0, 500'000'000};
  builtin.discovery_config.initial_announcements.count = 20;
  qos.wire_protocol().participant_id = participant;
  return factory->create_participant(static_cast<std::uint32_t>(domain), qos, nullptr,
                                     eprosima::fastdds::dds::StatusMask::none());
}

}  // namespace gyre::bench
