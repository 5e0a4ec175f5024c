#include "common/dds/lossy_transport.hpp"

namespace gyre::dds {

bool LossyTransport::send(fast::rtps::SenderResource* below, fast::Datagram datagram, std::uint32_t bytes,
                          fast::LocatorsIterator* begin, fast::LocatorsIterator* end,
                          const std::chrono::steady_clock::time_point& timeout) {
  if (!loss_->loses_any()) return below->send(datagram, bytes, begin, end, timeout);
  fast::LocatorList kept;
  for (fast::LocatorsIterator& to = *begin; to != *end; ++to) {
    if (!loss_->loses_next()) kept.push_back(*to);
  }
  if (kept.empty()) return true;
  fast::Locators first(kept.begin());
  fast::Locators last(kept.end());
  return below->send(datagram, bytes, &first, &last, timeout);
}

void LossyTransport::receive(fast::TransportReceiver* above, const fast::rtps::octet* datagram, std::uint32_t bytes,
                             const fast::rtps::Locator_t& local, const fast::rtps::Locator_t& remote) {
  if (!loss_->loses_next()) above->OnDataReceived(datagram, bytes, local, remote);
}

fast::TransportDescriptor* LossyTransport::get_configuration() {
  return low_level_transport_->get_configuration();
}

}  // namespace gyre::dds
