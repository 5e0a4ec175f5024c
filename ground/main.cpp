// `gyre`: what a person on the ground types. One file per command; this one only dispatches.

#include <CLI/CLI.hpp>

#include "ground/check.hpp"
#include "ground/command.hpp"
#include "ground/sample.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Gyre: a load that hangs still while the vehicles that carry it never stop.", "gyre"};
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::help);
  app.footer("Exit codes: 0 good, 1 refused or failed, 2 bad usage or bad file.");

  int exit_code = gyre::ground::kExitOk;
  gyre::ground::add_check(app, exit_code);
  gyre::ground::add_sample(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? gyre::ground::kExitOk : gyre::ground::kExitBadUsage;
  }
  return exit_code;
}
