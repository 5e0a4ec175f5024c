#pragma once
// The star's recipe written against Fast DDS itself, so that nothing of common/dds but its names is in a floor: one
// participant on the loopback, without multicast and shared memory, that looks for the hubs.

#include <cstdint>
#include <memory>

#include "common/dds/fastdds_version.hpp"

namespace gyre::bench {

inline dds::fast::api::DomainParticipant* open_bare_participant(int domain, int participant) {
  auto* factory = dds::fast::api::DomainParticipantFactory::get_instance();
  dds::fast::api::DomainParticipantQos qos = factory->get_default_participant_qos();
  auto udp = std::make_shared<dds::fast::UdpTransport>();
  udp->interfaceWhiteList.push_back("127.0.0.1");
  udp->maxInitialPeersRange = 4;
  udp->sendBufferSize = udp->receiveBufferSize = 1U << 20U;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  const auto loopback = dds::fast::udp_locator("127.0.0.1", 0);
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(loopback);
  builtin.initialPeersList.push_back(loopback);
  builtin.discovery_config.leaseDuration = {20, 0};
  builtin.discovery_config.leaseDuration_announcementperiod = {0, 500'000'000};
  builtin.discovery_config.initial_announcements.count = 20;
  qos.wire_protocol().participant_id = participant;
  return factory->create_participant(static_cast<std::uint32_t>(domain), qos, nullptr,
                                     dds::fast::api::StatusMask::none());
}

}  // namespace gyre::bench
