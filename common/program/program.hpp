#pragma once
// What every program of a swarm has in common: its options, its log, its seat.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/notice.hpp"
#include "common/base/result.hpp"
#include "common/dds/node.hpp"
#include "common/program/command_line.hpp"

namespace gyre::program {

/// How a program finds the others.
struct NetworkOptions {
  std::optional<int> domain;
  std::string interface = "127.0.0.1";  ///< or a name, such as eth0
  std::vector<std::string> peers;
};

/// Makes a process's clock wrong, so that tests can show that it does not matter.
struct ClockOptions {
  double offset_s = 0.0;
  double drift_ppm = 0.0;
};

struct Options {
  std::string log_level = "info";
  NetworkOptions network;
  ClockOptions clock;
  bool laboratory = false;  ///< whether it listens to disturbances (laboratory.hpp)
};

/// --domain. `otherwise` is what it is when neither it nor ROS_DOMAIN_ID is given.
[[nodiscard]] Option domain_option(std::optional<int>& domain, const std::string& otherwise = "0");
/// --domain, --interface, --peer.
[[nodiscard]] OptionGroup network_options(NetworkOptions& options, const std::string& otherwise = "0");
/// --clock-offset-s, --clock-drift-ppm.
[[nodiscard]] OptionGroup laboratory_options(ClockOptions& options);
/// `own_options` first, then --log-level, the network's and the laboratory's.
[[nodiscard]] std::vector<OptionGroup> with_common(std::vector<Option> own_options, Options& options);
/// The same of a process that flies, which can be disturbed: and --laboratory.
[[nodiscard]] std::vector<OptionGroup> with_common_in_flight(std::vector<Option> own_options, Options& options);

/// Makes the process's clock wrong as told, and says so; silent when there is nothing to do. Call before a node opens
/// and before anything reads the clock.
[[nodiscard]] Notices apply(const ClockOptions& options);

/// Starts the log under `name` and makes the clock as wrong as the laboratory wants it: before anything reads either.
/// Absent: go on. Otherwise what to exit with, and why was said.
[[nodiscard]] std::optional<ExitCode> start(const std::string& name, const Options& options);

/// The domain by precedence: --domain, GYRE_DOMAIN, ROS_DOMAIN_ID, 0. Errors name the option and what it takes.
[[nodiscard]] Result<dds::NodeOptions> node_options(const NetworkOptions& options, const dds::Seat& seat);

/// The program's place in the swarm. When there is none the log says why, and the error is what to exit with: kFailed
/// when it may work later (the seat is taken, the interface has no address yet), kBadUsage when it will not.
[[nodiscard]] Result<std::unique_ptr<dds::Node>, ExitCode> open_node(const NetworkOptions& network,
                                                                     const dds::Seat& seat, bool laboratory = false);

}  // namespace gyre::program
