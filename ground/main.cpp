// `gyre`: what a person on the ground types. One file per command; this one only dispatches.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "ground/check.hpp"
#include "ground/command.hpp"
#include "ground/fly.hpp"
#include "ground/health.hpp"
#include "ground/sample.hpp"
#include "ground/swarm_command.hpp"
#include "ground/swarm_status.hpp"
#include "ground/watch/watch.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Gyre: a load that hangs still while the vehicles that carry it never stop.", "gyre"};
  app.require_subcommand(0, 1);  // none is answered below: CLI11 would not say which word it did not know
  app.footer("Exit codes: 0 good, 1 refused or failed, 2 bad usage or bad file.");

  int exit_code = gyre::ground::kExitOk;
  gyre::ground::add_check(app, exit_code);
  gyre::ground::add_sample(app, exit_code);
  gyre::ground::add_fly(app, exit_code);
  gyre::ground::add_swarm_commands(app, exit_code);
  gyre::ground::add_status(app, exit_code);
  gyre::ground::add_watch(app, exit_code);
  gyre::ground::add_health(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help
    std::fprintf(stderr, "gyre: %s\nSee `gyre --help` and `gyre COMMAND --help`.\n", problem.what());
    return gyre::ground::kExitBadUsage;
  }
  if (app.get_subcommands().empty()) {
    std::fputs(app.help().c_str(), stderr);
    return gyre::ground::kExitBadUsage;
  }
  return exit_code;
}
