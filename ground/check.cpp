#include "ground/check.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "common/program/program.hpp"
#include "ground/certificate_json.hpp"
#include "ground/certificate_table.hpp"
#include "ground/command.hpp"

namespace gyre::ground {
namespace {

struct CheckOptions {
  std::string mission;
  bool json = false;
};

int check(const CheckOptions& options) {
  const Result<mission::Mission> mission = mission::read_mission_file(options.mission);
  if (!mission) {
    std::fprintf(stderr, "%s\n", mission.error().text.c_str());
    return kExitBadUsage;
  }
  const mechanics::Plan& plan = mission.value().plan;
  const mechanics::Certificate certificate = mechanics::certify(plan);
  const std::string report = options.json ? certificate_json(mission.value().name, certificate).dump(2) + "\n"
                                          : certificate_table(mission.value().name, plan.limits, certificate);
  const bool written = std::fputs(report.c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  return written && certificate.admissible() ? kExitOk : kExitRefused;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "Say whether a mission is admissible, with every figure and every broken rule.");
  program::add_mission(*command, options->mission);
  command->add_flag("--json", options->json, "print the certificate as JSON");
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace gyre::ground
