#pragma once
// Where a flight takes place: a DDS domain that nobody else uses, held from the first moment on.
//
// Fast DDS would join whatever runs on a domain already. So the ground's own seat is taken first, which only one
// process can, and then every other seat and port of the flight has to be free: two flights that start together never
// meet.

#include <memory>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/result.hpp"
#include "common/dds/node.hpp"
#include "common/program/program.hpp"

namespace gyre::ground {

struct FlightNetwork {
  std::unique_ptr<dds::Node> node;  ///< at the ground's seat
  int domain = 0;
  std::string interface;
  std::vector<std::string> peers;

  /// What a process of this flight is told on its command line.
  [[nodiscard]] std::vector<std::string> arguments() const;
};

struct FlightNetworkError {
  std::string text;
  bool bad_usage = false;  ///< the options are wrong, whatever else runs
};

/// On the domain the user told (--domain, GYRE_DOMAIN, ROS_DOMAIN_ID), else on the first free one.
[[nodiscard]] Result<FlightNetwork, FlightNetworkError> open_flight_network(const program::NetworkOptions& options,
                                                                            const std::vector<CarrierId>& carriers);

}  // namespace gyre::ground
