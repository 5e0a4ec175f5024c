#include "ground/sample.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/mission/mission.hpp"
#include "common/program/program.hpp"
#include "ground/command.hpp"
#include "ground/motion_csv.hpp"

namespace gyre::ground {
namespace {

struct SampleOptions {
  std::string mission;
  int count = 100;
};

/// A refused motion can be looked at, as far as there is one.
bool has_motion(const mechanics::Certificate& certificate) {
  for (const mechanics::CarrierFigures& carrier : certificate.carriers) {
    if (!std::isfinite(carrier.length_m.max) || !std::isfinite(carrier.speed_m_s.max)) return false;
  }
  return true;
}

int sample(const SampleOptions& options) {
  const Result<mission::Mission> mission = mission::read_mission_file(options.mission);
  if (!mission) {
    std::fprintf(stderr, "%s\n", mission.error().text.c_str());
    return kExitBadUsage;
  }
  const mechanics::Plan& plan = mission.value().plan;
  mechanics::CertifyOptions quick;
  quick.separation = false;
  quick.stiffness = false;
  const mechanics::Certificate certificate = mechanics::certify(plan, quick);
  if (!certificate.admissible()) {
    std::fprintf(stderr, "note: %s is refused; `gyre check` says why\n", options.mission.c_str());
  }
  if (!has_motion(certificate)) {
    std::fprintf(stderr, "%s: there is no bounded motion to sample:\n", options.mission.c_str());
    for (const mechanics::Reason& reason : certificate.reasons) {
      std::fprintf(stderr, "  %s: %s\n", mechanics::name(reason.rule), reason.text.c_str());
    }
    return kExitRefused;
  }
  const bool written = std::fputs(motion_csv(plan, options.count).c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  return written ? kExitOk : kExitRefused;
}

}  // namespace

void add_sample(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<SampleOptions>();
  CLI::App* command = app.add_subcommand("sample", "Print the motion over one period as CSV.");
  program::add_mission(*command, options->mission);
  command->add_option("--count", options->count, "rows per carrier, both ends of the period included")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = sample(*options); });
}

}  // namespace gyre::ground
