#include "ground/check/check.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/program/mission_argument.hpp"
#include "ground/check/certificate_json.hpp"
#include "ground/check/certificate_table.hpp"

namespace gyre::ground {
namespace {

struct CheckOptions {
  std::string mission;
  bool json = false;
};

int check(const CheckOptions& options) {
  const auto mission = program::read_mission(options.mission);
  if (!mission) return mission.error();
  const mechanics::Plan& plan = mission.value().plan;
  const mechanics::Certificate certificate = mechanics::certify(plan);
  const protocol::Silence& silence = mission.value().silence;
  const std::string report = options.json ? certificate_json(mission.value().name, certificate, silence).dump(2) + "\n"
                                          : certificate_table(mission.value().name, plan.limits, certificate, silence);
  const bool written = std::fputs(report.c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  return written && certificate.admissible() ? program::kGood : program::kFailed;
}

}  // namespace

program::Command check_command() {
  const auto options = std::make_shared<CheckOptions>();
  return {"check",
          "Say whether a mission is admissible, with every figure and every broken rule.",
          {program::own({program::mission_argument(options->mission),
                         {"--json", &options->json, "print the certificate as JSON"}})},
          [options] { return check(*options); }};
}

}  // namespace gyre::ground
