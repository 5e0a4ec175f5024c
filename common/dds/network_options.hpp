#pragma once
// The options by which every program finds the others: --domain, --interface, --peer, and their environment variables.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/dds/node.hpp"

namespace gyre::dds {

struct NetworkOptions {
  std::optional<int> domain;
  std::string interface = "127.0.0.1";  ///< or a name, such as eth0
  std::vector<std::string> peers;
};

/// `options` has to live until `app` has parsed.
void add_network_options(CLI::App& app, NetworkOptions& options);

/// The domain by precedence: --domain, GYRE_DOMAIN, ROS_DOMAIN_ID, 0. Errors name the option and what it takes.
[[nodiscard]] Result<NodeOptions> node_options(const NetworkOptions& options, Seat seat);

}  // namespace gyre::dds
