#include "common/program/program.hpp"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <utility>

#include "common/base/log.hpp"

namespace gyre::program {

void add_options(CLI::App& app, Options& options) {
  app.add_option("--log-level", options.log_level, "trace, debug, info, warning, error or off")
      ->envname("GYRE_LOG_LEVEL")
      ->capture_default_str();
  dds::add_network_options(app, options.network);
  dds::add_clock_options(app, options.clock);
}

CLI::Option* add_mission(CLI::App& app, std::string& path) {
  return app.add_option("MISSION", path, "mission file, Protobuf text format (idl/mission.proto)")
      ->required()
      ->envname("GYRE_MISSION");
}

std::optional<ExitCode> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? kGood : kBadUsage;
  }
  return std::nullopt;
}

std::optional<ExitCode> start(const std::string& name, const Options& options) {
  if (const auto started = start_log(name, options.log_level); !started) {
    std::fprintf(stderr, "%s\n", started.error().text.c_str());
    return kBadUsage;
  }
  log(dds::apply(options.clock));
  return std::nullopt;
}

Result<std::unique_ptr<dds::Node>, ExitCode> open_node(const dds::NetworkOptions& network, const dds::Seat& seat) {
  const auto options = dds::node_options(network, seat);
  if (!options) {
    spdlog::error("{}", options.error().text);
    return kBadUsage;
  }
  auto node = dds::Node::open(options.value());
  if (!node) {
    spdlog::error("{}", node.error().text);
    return kFailed;
  }
  return std::move(node).value();
}

}  // namespace gyre::program
