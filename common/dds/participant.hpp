#pragma once
// The star's recipe: one Fast DDS participant at its seat, on one interface, without multicast and shared memory.

#include <memory>

#include "common/base/ensure.hpp"
#include "common/base/result.hpp"
#include "common/dds/fastdds_version.hpp"
#include "common/dds/node.hpp"
#include "common/dds/packet_loss.hpp"
#include "common/dds/seat_lock.hpp"

namespace gyre::dds {

class Participant {
 public:
  /// Errors as Node::open.
  [[nodiscard]] static Result<Participant> open(const NodeOptions& options);

  ~Participant() { close(); }
  Participant(Participant&& other) noexcept;
  Participant& operator=(Participant&&) = delete;
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  [[nodiscard]] fast::api::DomainParticipant* get() const { return participant_; }
  fast::api::DomainParticipant* operator->() const { return participant_; }
  [[nodiscard]] fast::api::Publisher& publisher() const { return *publisher_; }
  [[nodiscard]] fast::api::Subscriber& subscriber() const { return *subscriber_; }

  [[nodiscard]] const SeatLock& seat() const { return seat_; }
  /// Of this process, for people.
  [[nodiscard]] const std::string& address() const { return address_; }
  /// Of a laboratory's participant.
  [[nodiscard]] PacketLoss& packet_loss() const {
    GYRE_ENSURE(loss_, "packets are lost on purpose in a laboratory only");
    return *loss_;
  }

  /// Deletes every entity; waits for callbacks that are running. Listeners have to live until then.
  void close();

 private:
  Participant(SeatLock seat, std::string address, std::shared_ptr<PacketLoss> loss,
              fast::api::DomainParticipant* participant);

  SeatLock seat_;
  std::string address_;
  std::shared_ptr<PacketLoss> loss_;  // shared with the transport; absent outside a laboratory
  fast::api::DomainParticipant* participant_;
  fast::api::Publisher* publisher_;
  fast::api::Subscriber* subscriber_;
};

}  // namespace gyre::dds
