#include "ground/swarm_status.hpp"

#include <cstdio>
#include <memory>
#include <set>
#include <variant>

#include "common/dds/inbox.hpp"
#include "common/dds/network_options.hpp"
#include "ground/command.hpp"
#include "ground/swarm_picture.hpp"

namespace gyre::ground {
namespace {

constexpr Duration kPatience = std::chrono::seconds(5);
/// Health comes once a second: the last thing to wait for.
constexpr Duration kAfterwards = std::chrono::milliseconds(1100);

using Heard = std::variant<protocol::CoordinatorStatus, protocol::Beacon, protocol::AgentStatus, protocol::LoadState,
                           protocol::Health>;

int show(const dds::NetworkOptions& options) {
  const Result<dds::NodeOptions> chosen = dds::node_options(options, {});
  if (!chosen) {
    std::fprintf(stderr, "%s\n", chosen.error().text.c_str());
    return kExitBadUsage;
  }
  dds::Inbox<Heard> inbox;  // outlives the node, whose handlers fill it
  const Result<std::unique_ptr<dds::Node>> opened = dds::Node::open(chosen.value());
  if (!opened) {
    std::fprintf(stderr, "%s\n", opened.error().text.c_str());
    return kExitRefused;
  }
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
                 chosen.value().domain, seconds(kPatience));
    return kExitRefused;
  }
  std::fputs(picture.table().c_str(), stdout);
  return kExitOk;
}

}  // namespace

void add_status(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<dds::NetworkOptions>();
  CLI::App* command = app.add_subcommand("status", "Show how a swarm that flies is: carriers, load, clocks, losses.");
  dds::add_network_options(*command, *options);
  command->callback([options, &exit_code] { exit_code = show(*options); });
}

}  // namespace gyre::ground
