#include "ground/flight/flight_network.hpp"

#include <cstdlib>
#include <optional>
#include <utility>

#include "common/dds/interface.hpp"
#include "common/dds/seat_lock.hpp"

namespace gyre::ground {
namespace {

struct NamedSeat {
  std::string name;
  int participant;
};

/// Every seat of the flight but the ground's own.
std::vector<NamedSeat> seats(const std::vector<CarrierId>& carriers) {
  std::vector<NamedSeat> seats{{"coordinator", static_cast<int>(dds::Hub::kCoordinator)},
                               {"standby coordinator", static_cast<int>(dds::Hub::kStandby)},
                               {"simulator", static_cast<int>(dds::Hub::kSimulator)}};
  for (const CarrierId id : carriers) {
    seats.push_back({"agent " + std::to_string(id), static_cast<int>(dds::Hub::kGround) + static_cast<int>(id)});
  }
  return seats;
}

/// Why the domain cannot be used, if it cannot.
std::optional<std::string> obstacle(const dds::NodeOptions& options, const std::vector<NamedSeat>& seats) {
  for (const NamedSeat& seat : seats) {
    if (const auto owner = dds::seat_owner(options.domain, seat.participant)) {
      return *owner + " is the " + seat.name + " there";
    }
    const auto port = dds::check_ports_free(options.interface, options.domain, seat.participant);
    if (!port) return port.error().text;
  }
  return std::nullopt;
}

Result<FlightNetwork> open_at(const dds::NodeOptions& options, const std::vector<NamedSeat>& seats) {
  Result<std::unique_ptr<dds::Node>> node = dds::Node::open(options);
  if (!node) return node.error();
  if (const auto reason = obstacle(options, seats)) return Error{*reason};
  return FlightNetwork{std::move(node).value(), options.domain, options.interface, options.peers};
}

}  // namespace

std::vector<std::string> FlightNetwork::arguments() const {
  std::vector<std::string> words{"--domain", std::to_string(domain), "--interface", interface};
  for (const std::string& peer : peers) words.insert(words.end(), {"--peer", peer});
  return words;
}

Result<FlightNetwork, FlightNetworkError> open_flight_network(const program::NetworkOptions& options,
                                                              const std::vector<CarrierId>& carriers) {
  const Result<dds::NodeOptions> read = program::node_options(options, {dds::Hub::kGround, std::nullopt});
  if (!read) return FlightNetworkError{read.error().text, true};
  const Result<std::string> interface = dds::interface_address(read.value().interface);
  if (!interface) return FlightNetworkError{"--interface (or GYRE_INTERFACE): " + interface.error().text, true};
  dds::NodeOptions told = read.value();
  told.interface = interface.value();
  const std::vector<NamedSeat> others = seats(carriers);
  if (options.domain || std::getenv("ROS_DOMAIN_ID") != nullptr) {
    Result<FlightNetwork> network = open_at(told, others);
    if (network) return std::move(network).value();
    return FlightNetworkError{"domain " + std::to_string(told.domain) + " cannot be used: " + network.error().text +
                              "; end that, or leave --domain (and ROS_DOMAIN_ID) out and a free one is taken"};
  }
  std::string last;
  for (int domain = 0; domain <= dds::kMaxDomain; ++domain) {
    dds::NodeOptions candidate = told;
    candidate.domain = domain;
    // Looking first: opening a participant takes milliseconds, a taken seat is seen at once.
    const bool taken = dds::seat_holder(candidate.seat, domain).taken || obstacle(candidate, others).has_value();
    if (taken && domain < dds::kMaxDomain) continue;
    Result<FlightNetwork> network = open_at(candidate, others);
    if (network) return std::move(network).value();
    last = network.error().text;
  }
  return FlightNetworkError{"no domain from 0 to " + std::to_string(dds::kMaxDomain) +
                            " is free; of the last: " + last};
}

}  // namespace gyre::ground
