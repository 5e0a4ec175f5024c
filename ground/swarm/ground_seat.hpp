#pragma once
// Where a process of the ground sits in the star.

#include "common/dds/node.hpp"
#include "common/program/program.hpp"

namespace gyre::ground {

/// The ground's own seat, where `gyre health` asks; who comes later is a visitor.
[[nodiscard]] inline dds::Seat ground_seat(const program::NetworkOptions& network) {
  const Result<int> domain = dds::choose_domain(network.domain);
  const dds::Seat ground{dds::Hub::kGround, std::nullopt};
  return domain && !dds::seat_holder(ground, domain.value()).taken ? ground : dds::Seat{};
}

}  // namespace gyre::ground
