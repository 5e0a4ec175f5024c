#include "ground/swarm/status.hpp"

#include <cstdio>
#include <memory>
#include <set>
#include <variant>

#include "common/dds/inbox.hpp"
#include "common/program/program.hpp"
#include "ground/swarm/core/swarm_picture.hpp"

namespace gyre::ground {
namespace {

constexpr Duration kPatience = std::chrono::seconds(5);
/// Health comes once a second: the last thing to wait for.
constexpr Duration kAfterwards = std::chrono::milliseconds(1100);

using Heard = std::variant<protocol::CoordinatorStatus, protocol::Beacon, protocol::AgentStatus, protocol::LoadState,
                           protocol::Health>;

int show(const program::NetworkOptions& options) {
  dds::Inbox<Heard> inbox;  // outlives the node, whose handlers fill it
  const auto opened = program::open_node(options, {});
  if (!opened) return opened.error();
  dds::Node& node = *opened.value();
  const auto keep = [&inbox](auto message, LocalTime) { inbox.push(std::move(message)); };
  node.read<protocol::CoordinatorStatus>(keep);
  node.read<protocol::Beacon>(keep);
  node.read<protocol::LoadState>(keep);
  node.read<protocol::Health>(keep);

  SwarmPicture picture;
  std::set<CarrierId> read;
  LocalTime deadline = dds::now() + kPatience;
  bool complete = false;
  while (dds::now() < deadline) {
    for (const Heard& heard : inbox.wait_until(deadline)) {
      std::visit([&picture](const auto& message) { picture.see(message); }, heard);
    }
    if (!picture.coordinator()) continue;
    for (const CarrierId id : picture.coordinator()->carriers) {
      if (read.insert(id).second) node.read<protocol::AgentStatus>(keep, id);
    }
    if (!complete && picture.complete()) {
      complete = true;
      deadline = dds::now() + kAfterwards;
    }
  }
  if (!picture.coordinator()) {
    std::fprintf(stderr, "No coordinator was heard on domain %d within %.0f s; choose another domain with --domain.\n",
                 node.domain(), seconds(kPatience));
    return program::kFailed;
  }
  std::fputs(picture.table().c_str(), stdout);
  return program::kGood;
}

}  // namespace

program::Command status_command() {
  const auto options = std::make_shared<program::NetworkOptions>();
  return {"status",
          "Show how a swarm that flies is: carriers, load, clocks, losses.",
          {program::network_options(*options)},
          [options] { return show(*options); }};
}

}  // namespace gyre::ground
