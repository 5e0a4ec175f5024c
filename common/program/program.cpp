#include "common/program/program.hpp"

#include <cstdio>
#include <utility>

#include "common/base/log.hpp"
#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "common/dds/interface.hpp"

namespace gyre::program {

Option domain_option(std::optional<int>& domain, const std::string& otherwise) {
  return {"--domain", &domain, "DDS domain, 0 to 100 (else ROS_DOMAIN_ID, else " + otherwise + ")"};
}

OptionGroup network_options(NetworkOptions& options, const std::string& otherwise) {
  return {"Network",
          {domain_option(options.domain, otherwise),
           {"--interface", &options.interface, "network interface to use, by its name or IPv4 address"},
           {"--peer", &options.peers, "IPv4 address of another machine to look for the swarm at; may be repeated"}}};
}

OptionGroup laboratory_options(ClockOptions& options) {
  return {"Laboratory",
          {{"--clock-offset-s", &options.offset_s, "make this process's clock wrong by so many seconds",
            Bounds{-dds::kMaxClockOffset_s, dds::kMaxClockOffset_s}},
           {"--clock-drift-ppm", &options.drift_ppm, "make this process's clock run too fast by so many ppm",
            Bounds{-dds::kMaxClockDrift_ppm, dds::kMaxClockDrift_ppm}}}};
}

std::vector<OptionGroup> with_common(std::vector<Option> own_options, Options& options) {
  own_options.push_back({"--log-level", &options.log_level, "trace, debug, info, warning, error or off"});
  return {own(std::move(own_options)), network_options(options.network), laboratory_options(options.clock)};
}

std::vector<OptionGroup> with_common_in_flight(std::vector<Option> own_options, Options& options) {
  std::vector<OptionGroup> groups = with_common(std::move(own_options), options);
  groups.back().options.push_back(
      {"--laboratory", &options.laboratory,
       "let anybody on the domain disturb this process: lose its packets, shift its clock (forwards it leaps, back it "
       "stands still), push the simulator's load; never in a real flight"});
  return groups;
}

Notices apply(const ClockOptions& options) {
  if (options.offset_s == 0.0 && options.drift_ppm == 0.0) return {};
  dds::set_clock_error(from_seconds(options.offset_s), options.drift_ppm);
  return {{Notice::Level::kWarning, text("laboratory: this process's clock is made wrong by %+g s and %+g ppm",
                                         options.offset_s, options.drift_ppm)}};
}

std::optional<ExitCode> start(const std::string& name, const Options& options) {
  if (const auto started = start_log(name, options.log_level); !started) {
    std::fprintf(stderr, "%s\n", started.error().text.c_str());
    return kBadUsage;
  }
  log(apply(options.clock));
  return std::nullopt;
}

Result<dds::NodeOptions> node_options(const NetworkOptions& options, const dds::Seat& seat) {
  const Result<int> domain = dds::choose_domain(options.domain);
  if (!domain) return domain.error();
  for (const std::string& peer : options.peers) {
    if (!dds::is_ipv4(peer)) {
      return Error{"--peer (or GYRE_PEER) is \"" + peer + "\": give an IPv4 address such as 192.168.1.7"};
    }
  }
  return dds::NodeOptions{seat, domain.value(), options.interface, options.peers};
}

Result<std::unique_ptr<dds::Node>, ExitCode> open_node(const NetworkOptions& network, const dds::Seat& seat,
                                                       bool laboratory) {
  const auto chosen = node_options(network, seat);
  if (!chosen) {
    log_error(chosen.error().text);
    return kBadUsage;
  }
  dds::NodeOptions options = chosen.value();
  options.laboratory = laboratory;
  auto node = dds::Node::open(options);
  if (!node) {
    log_error(node.error().text);
    return kFailed;
  }
  return std::move(node).value();
}

}  // namespace gyre::program
