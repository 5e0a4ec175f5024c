#include "common/dds/participant.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "common/dds/clock.hpp"
#include "common/dds/interface.hpp"
#include "common/dds/transport_stack.hpp"

namespace gyre::dds {
namespace {

constexpr int kHubs = 4;
constexpr int kFirstVisitor = kHubs + static_cast<int>(kMaxCarrierId);
constexpr int kLastParticipant = 119;  // RTPS: the next one's ports belong to the next domain

std::string describe(const Seat& seat) {
  if (seat.carrier) return "the agent of carrier " + std::to_string(*seat.carrier);
  if (!seat.hub) return "a visitor";
  switch (*seat.hub) {
    case Hub::kCoordinator:
      return "the coordinator";
    case Hub::kStandby:
      return "the standby coordinator";
    case Hub::kSimulator:
      return "the simulator";
    case Hub::kGround:
      return "the ground station";
  }
  return "a hub";
}

// The participant ids a seat may have, first to last.
struct IdRange {
  int first;
  int last;
};

Result<IdRange> ids_of(const Seat& seat) {
  if (seat.hub && seat.carrier) return Error{"a seat is a hub's or an agent's, not both"};
  if (seat.hub) return IdRange{static_cast<int>(*seat.hub), static_cast<int>(*seat.hub)};
  if (!seat.carrier) return IdRange{kFirstVisitor, kLastParticipant};
  if (*seat.carrier < 1 || *seat.carrier > kMaxCarrierId) {
    return Error{"carrier " + std::to_string(*seat.carrier) + " does not exist: carriers are numbered 1 to " +
                 std::to_string(kMaxCarrierId)};
  }
  const int id = kHubs - 1 + static_cast<int>(*seat.carrier);
  return IdRange{id, id};
}

struct TakenSeat {
  SeatLock lock;
  int participant;
};

Result<TakenSeat> take_seat(const Seat& seat, int domain) {
  const Result<IdRange> ids = ids_of(seat);
  if (!ids) return ids.error();
  std::string owner;
  for (int id = ids.value().first; id <= ids.value().last; ++id) {
    Result<SeatLock> lock = SeatLock::take(domain, id);
    if (lock) return TakenSeat{std::move(lock).value(), id};
    owner = lock.error().text;
  }
  const std::string cure = "; end it, or choose another domain with --domain";
  return Error{describe(seat) + " of domain " + std::to_string(domain) + " is running already: " + owner + cure};
}

// Where at a host somebody may sit whom this participant has to find: port 0 stands for the ids that the transport
// tries. A visitor finds everybody on its own machine by trying all ids there; agents on other machines have to find
// it, so they look at the first seats of the gallery, too.
void look_at(fast::LocatorList& peers, const std::string& host, int domain) {
  constexpr int kGallery = 4;
  peers.push_back(fast::udp_locator(host, 0));
  for (int id = kFirstVisitor; id < kFirstVisitor + kGallery; ++id) {
    peers.push_back(fast::udp_locator(host, discovery_port(domain, id)));
  }
}

// What a user's XML profile sets, stays; what it leaves open becomes the star.
fast::api::DomainParticipantQos star(const NodeOptions& options, int participant,
                                     const std::shared_ptr<PacketLoss>& loss) {
  fast::api::DomainParticipantQos qos = fast::profiled_participant_qos();
  const bool visitor = participant >= kFirstVisitor;
  // How many participant ids are tried at every peer: the hubs; a visitor has to find the agents as well.
  stack_transports(qos.transport(), {options.interface, visitor ? kFirstVisitor : kHubs, loss});
  auto& builtin = qos.wire_protocol().builtin;
  // With a unicast locator of our own no multicast socket is opened.
  if (builtin.metatrafficUnicastLocatorList.empty()) {
    builtin.metatrafficUnicastLocatorList.push_back(fast::udp_locator(options.interface, 0));
  }
  if (builtin.initialPeersList.empty()) {
    look_at(builtin.initialPeersList, options.interface, options.domain);
    for (const std::string& peer : options.peers) look_at(builtin.initialPeersList, peer, options.domain);
  }
  // Silence is judged in the cores; a lease that runs out only unmatches, and matching anew is slow where packets are
  // lost. So it outlasts forty lost announcements, and a radio that is out for less costs nothing when it is back.
  builtin.discovery_config.leaseDuration = fast::Time(20, 0);
  builtin.discovery_config.leaseDuration_announcementperiod = fast::Time(0, 500'000'000);
  builtin.discovery_config.initial_announcements.count = 20;
  qos.wire_protocol().participant_id = participant;
  qos.name("gyre");
  return qos;
}

Result<int> check_domain(int domain, const std::string& source) {
  if (domain >= 0 && domain <= kMaxDomain) return domain;
  return Error{source + " is " + std::to_string(domain) + ": a domain is a number from 0 to " +
               std::to_string(kMaxDomain)};
}

}  // namespace

Result<int> choose_domain(std::optional<int> option) {
  if (option) return check_domain(*option, "the domain (--domain or GYRE_DOMAIN)");
  const char* const ros = std::getenv("ROS_DOMAIN_ID");
  if (!ros || *ros == '\0') return 0;
  int domain = 0;
  const char* const end = ros + std::strlen(ros);
  const auto parsed = std::from_chars(ros, end, domain);
  if (parsed.ec != std::errc() || parsed.ptr != end) {
    return Error{"ROS_DOMAIN_ID is \"" + std::string(ros) + "\": a domain is a number from 0 to " +
                 std::to_string(kMaxDomain)};
  }
  return check_domain(domain, "ROS_DOMAIN_ID");
}

SeatHolder seat_holder(const Seat& seat, int domain) {
  const Result<IdRange> ids = ids_of(seat);
  GYRE_ENSURE(ids.ok(), "the seat exists");
  SeatHolder holder;
  for (int id = ids.value().first; id <= ids.value().last; ++id) {
    const std::optional<std::string> owner = seat_owner(domain, id);
    if (!owner) return {};
    holder = {true, *owner};
  }
  return holder;
}

std::vector<SeatCall> ask_all_seats(int domain, Duration patience) {
  const LocalTime until = now() + patience;
  std::vector<SeatCall> calls;
  for (int id = 0; id < kFirstVisitor; ++id) {
    const Duration left = std::max(Duration::zero(), until - now());
    if (auto call = ask_seat(domain, id, left)) calls.push_back(std::move(*call));
  }
  return calls;
}

Participant::Participant(SeatLock seat, std::string address, std::shared_ptr<PacketLoss> loss,
                         fast::api::DomainParticipant* participant)
    : seat_(std::move(seat)),
      address_(std::move(address)),
      loss_(std::move(loss)),
      participant_(participant),
      publisher_(participant->create_publisher(fast::api::PUBLISHER_QOS_DEFAULT)),
      subscriber_(participant->create_subscriber(fast::api::SUBSCRIBER_QOS_DEFAULT)) {}

Participant::Participant(Participant&& other) noexcept
    : seat_(std::move(other.seat_)),
      address_(std::move(other.address_)),
      loss_(std::move(other.loss_)),
      participant_(std::exchange(other.participant_, nullptr)),
      publisher_(other.publisher_),
      subscriber_(other.subscriber_) {}

Result<Participant> Participant::open(const NodeOptions& asked) {
  NodeOptions options = asked;
  const Result<int> domain = check_domain(options.domain, "the domain");
  if (!domain) return domain.error();
  for (const std::string& peer : options.peers) {
    if (!is_ipv4(peer)) return Error{"the peer \"" + peer + "\" is no IPv4 address such as 192.168.1.7"};
  }
  // Looked up at the last moment: at a machine's start a radio may still be waiting for its address.
  Result<std::string> interface = interface_address(options.interface);
  if (!interface) return Error{"the interface (--interface or GYRE_INTERFACE) " + interface.error().text};
  options.interface = std::move(interface).value();
  Result<TakenSeat> seat = take_seat(options.seat, options.domain);
  if (!seat) return seat.error();
  TakenSeat taken = std::move(seat).value();
  const Result<int> port = check_ports_free(options.interface, options.domain, taken.participant);
  if (!port) return port.error();

  std::shared_ptr<PacketLoss> loss;
  if (options.laboratory) loss = std::make_shared<PacketLoss>(static_cast<std::uint64_t>(taken.participant));
  // Without the empty mask a participant listener would swallow the readers' callbacks.
  auto* participant = fast::api::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(options.domain), star(options, taken.participant, loss), nullptr,
      fast::api::StatusMask::none());
  if (!participant) {
    return Error{"Fast DDS gives no participant at " + options.interface + ", domain " +
                 std::to_string(options.domain) + "; if XML profiles are in use, look there first"};
  }
  return Participant(std::move(taken.lock), address_of_this_process(options.interface), std::move(loss), participant);
}

void Participant::close() {
  if (!participant_) return;
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  fast::api::DomainParticipantFactory::get_instance()->delete_participant(std::exchange(participant_, nullptr));
}

}  // namespace gyre::dds
