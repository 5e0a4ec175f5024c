#include "common/dds/network_options.hpp"

#include "common/dds/interface.hpp"

namespace gyre::dds {
namespace {

Error no_address(const std::string& value) {
  return Error{"--peer (or GYRE_PEER) is \"" + value + "\": give an IPv4 address such as 192.168.1.7"};
}

}  // namespace

void add_network_options(CLI::App& app, NetworkOptions& options) {
  const char* const group = "Network";
  app.add_option("--domain", options.domain, "DDS domain, 0 to 100 (else ROS_DOMAIN_ID, else 0)")
      ->envname("GYRE_DOMAIN")
      ->group(group);
  app.add_option("--interface", options.interface, "network interface to use, by its name or IPv4 address")
      ->envname("GYRE_INTERFACE")
      ->capture_default_str()
      ->group(group);
  app.add_option("--peer", options.peers, "IPv4 address of another machine to look for the swarm at; may be repeated")
      ->envname("GYRE_PEER")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->group(group);
}

Result<NodeOptions> node_options(const NetworkOptions& options, Seat seat) {
  const Result<int> domain = choose_domain(options.domain);
  if (!domain) return domain.error();
  for (const std::string& peer : options.peers) {
    if (!is_ipv4(peer)) return no_address(peer);
  }
  return NodeOptions{seat, domain.value(), options.interface, options.peers};
}

}  // namespace gyre::dds
