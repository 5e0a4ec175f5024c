#pragma once
// What a datagram passes on its way out of a participant and into it, layer by layer: the one place where layers are
// put around UDP.

#include <memory>
#include <string>

#include "common/dds/fastdds_version.hpp"
#include "common/dds/packet_loss.hpp"

namespace gyre::dds {

struct TransportLayers {
  std::string interface;             ///< IPv4: the only one UDP uses
  int peers_range = 0;               ///< participant ids that are tried at every peer
  std::shared_ptr<PacketLoss> loss;  ///< absent: no such layer
};

/// Transports that a user's XML profile has set stay, in place of UDP; layers go around each of them.
void stack_transports(fast::api::TransportConfigQos& transport, const TransportLayers& layers);

}  // namespace gyre::dds
