#include "ground/swarm/listening.hpp"

#include <utility>

namespace gyre::ground {

template <class Message>
void Listening::read(std::optional<CarrierId> carrier) {
  node_.read<Message>(
      [inbox = inbox_](Message message, LocalTime arrived) {
        inbox->push({std::move(message), arrived});
      },
      carrier);
}

Listening::Listening(dds::Node& node, Interest interest, std::size_t capacity)
    : node_(node), interest_(interest), inbox_(std::make_shared<dds::Inbox<Heard>>(capacity)) {
  read<protocol::Beacon>();
  read<protocol::CoordinatorStatus>();
  read<protocol::LoadState>();
  read<protocol::Health>();
  if (interest_ != Interest::kCarriers) return;
  read<protocol::MissionText>();
  read<protocol::Command>();
  read<protocol::CommandReply>();
}

void Listening::attend(const std::vector<CarrierId>& carriers) {
  if (interest_ == Interest::kSwarm) return;
  for (const CarrierId id : carriers) {
    if (id < 1 || id > kMaxCarrierId || !attended_.insert(id).second) continue;
    read<protocol::AgentStatus>(id);
    if (interest_ != Interest::kCarriers) continue;
    read<protocol::HeldPlans>(id);
    read<protocol::CarrierState>(id);
  }
}

}  // namespace gyre::ground
