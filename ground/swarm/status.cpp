#include "ground/swarm/status.hpp"

#include <cstdio>
#include <memory>

#include "common/program/program.hpp"
#include "ground/swarm/core/swarm_picture.hpp"
#include "ground/swarm/listening.hpp"

namespace gyre::ground {
namespace {

constexpr Duration kPatience = std::chrono::seconds(5);
/// Health comes once a second: the last thing to wait for.
constexpr Duration kAfterwards = std::chrono::milliseconds(1100);

int show(const program::NetworkOptions& options) {
  const auto opened = program::open_node(options, {});
  if (!opened) return opened.error();
  dds::Node& node = *opened.value();
  Listening listening(node, Interest::kAgents);
  SwarmView view;
  LocalTime deadline = dds::now() + kPatience;
  bool whole = false;
  while (dds::now() < deadline) {
    for (const Heard& heard : listening.wait_until(deadline)) view.step(heard.arrived, heard.message);
    listening.attend(view.carrier_ids());
    if (!whole && complete(view)) {
      whole = true;
      deadline = dds::now() + kAfterwards;
    }
  }
  if (!view.coordinator()) {
    std::fprintf(stderr, "No coordinator was heard on domain %d within %.0f s; choose another domain with --domain.\n",
                 node.domain(), seconds(kPatience));
    return program::kFailed;
  }
  std::fputs(table(view, dds::now()).c_str(), stdout);
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
