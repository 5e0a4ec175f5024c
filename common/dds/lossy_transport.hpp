#pragma once
// A layer around a transport that loses datagrams whole, in and out, as a bad radio does.
//
// What is sent to several participants at once is several datagrams, and each is lost or not by itself: that is how
// packets are lost, and one throw for all would lose a beacon for the whole swarm or for nobody.

#include <memory>

#include "common/dds/fastdds_version.hpp"
#include "common/dds/packet_loss.hpp"

namespace gyre::dds {

class LossyTransport final : public fast::ChainingTransport {
 public:
  LossyTransport(const fast::ChainingDescriptor& descriptor, std::shared_ptr<PacketLoss> loss)
      : ChainingTransport(descriptor), loss_(std::move(loss)) {}

  /// What is lost is sent, as far as the sender can tell.
  bool send(fast::rtps::SenderResource* below, fast::Datagram datagram, std::uint32_t bytes,
            fast::LocatorsIterator* begin, fast::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override;
  void receive(fast::TransportReceiver* above, const fast::rtps::octet* datagram, std::uint32_t bytes,
               const fast::rtps::Locator_t& local, const fast::rtps::Locator_t& remote) override;
  [[nodiscard]] fast::TransportDescriptor* get_configuration() override;

 private:
  std::shared_ptr<PacketLoss> loss_;
};

/// For a participant's list of transports: `below` and the loss around it.
class LossyTransportDescriptor final : public fast::ChainingDescriptor {
 public:
  LossyTransportDescriptor(std::shared_ptr<fast::TransportDescriptor> below, std::shared_ptr<PacketLoss> loss)
      : ChainingTransportDescriptor(std::move(below)), loss_(std::move(loss)) {}

  [[nodiscard]] fast::Transport* create_transport() const override { return new LossyTransport(*this, loss_); }

 private:
  std::shared_ptr<PacketLoss> loss_;
};

}  // namespace gyre::dds
