#include "common/dds/transport_stack.hpp"

#include "common/dds/lossy_transport.hpp"

namespace gyre::dds {
namespace {

std::shared_ptr<fast::TransportDescriptor> udp(const TransportLayers& layers) {
  constexpr std::uint32_t kBufferBytes = 1U << 20U;
  auto udp = std::make_shared<fast::UdpTransport>();
  udp->interfaceWhiteList.push_back(layers.interface);
  udp->maxInitialPeersRange = static_cast<std::uint32_t>(layers.peers_range);
  udp->sendBufferSize = kBufferBytes;
  udp->receiveBufferSize = kBufferBytes;
  return udp;
}

}  // namespace

void stack_transports(fast::api::TransportConfigQos& transport, const TransportLayers& layers) {
  if (transport.user_transports.empty()) {
    transport.use_builtin_transports = false;
    transport.user_transports.push_back(udp(layers));
  }
  // From the inside out.
  for (auto& stack : transport.user_transports) {
    if (layers.loss) stack = std::make_shared<LossyTransportDescriptor>(stack, layers.loss);
  }
}

}  // namespace gyre::dds
