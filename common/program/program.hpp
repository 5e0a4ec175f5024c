#pragma once
// What every program of a swarm has in common: its options, its log, its seat, and what it answers to the shell.
//
// Every option has an environment variable of the same name, GYRE_...: containers and service units configure by those.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "common/base/result.hpp"
#include "common/dds/clock_options.hpp"
#include "common/dds/network_options.hpp"

namespace gyre::program {

enum ExitCode { kGood = 0, kFailed = 1, kBadUsage = 2 };

struct Options {
  std::string log_level = "info";
  dds::NetworkOptions network;
  dds::ClockOptions clock;
};

/// --log-level, the network's and the laboratory's. `options` has to live until `app` has parsed.
void add_options(CLI::App& app, Options& options);

/// The mission file, as the first word or GYRE_MISSION; required.
CLI::Option* add_mission(CLI::App& app, std::string& path);

/// Absent: go on. Otherwise what to exit with: help was asked for, or the words are wrong, and that was said.
[[nodiscard]] std::optional<ExitCode> parse(CLI::App& app, int argc, char** argv);

/// Starts the log under `name` and makes the clock as wrong as the laboratory wants it: before anything reads either.
[[nodiscard]] std::optional<ExitCode> start(const std::string& name, const Options& options);

/// The program's place in the swarm. When there is none the log says why, and the error is what to exit with.
[[nodiscard]] Result<std::unique_ptr<dds::Node>, ExitCode> open_node(const dds::NetworkOptions& network,
                                                                     const dds::Seat& seat);

}  // namespace gyre::program
