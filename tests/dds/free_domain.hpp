#pragma once
// A domain where nobody sits, so that tests beside each other and beside a flight do not meet.

#include <gtest/gtest.h>

#include <memory>

#include "common/dds/node.hpp"

namespace gyre::tests {

/// The coordinator's seat on the first domain from 60 up where it is free and nobody is faster.
[[nodiscard]] inline std::unique_ptr<dds::Node> open_coordinator(dds::NodeOptions& options) {
  options.seat = {dds::Hub::kCoordinator, std::nullopt};
  for (options.domain = 60; options.domain <= dds::kMaxDomain; ++options.domain) {
    if (dds::seat_holder(options.seat, options.domain).taken) continue;
    auto node = dds::Node::open(options);
    if (node) return std::move(node).value();
  }
  ADD_FAILURE() << "no free domain from 60 to " << dds::kMaxDomain;
  return nullptr;
}

[[nodiscard]] inline std::unique_ptr<dds::Node> open(dds::NodeOptions options, dds::Seat seat) {
  options.seat = seat;
  auto node = dds::Node::open(options);
  if (node) return std::move(node).value();
  ADD_FAILURE() << node.error().text;
  return nullptr;
}

}  // namespace gyre::tests
