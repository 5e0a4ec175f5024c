#include "ground/check/sample.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/program/mission_argument.hpp"
#include "ground/check/motion_csv.hpp"

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
  const auto mission = program::read_mission(options.mission);
  if (!mission) return mission.error();
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
    return program::kFailed;
  }
  const bool written = std::fputs(motion_csv(plan, options.count).c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  return written ? program::kGood : program::kFailed;
}

}  // namespace

program::Command sample_command() {
  const auto options = std::make_shared<SampleOptions>();
  return {"sample",
          "Print the motion over one period as CSV.",
          {program::own({program::mission_argument(options->mission),
                         {"--count", &options->count, "rows per carrier, both ends of the period included",
                          program::Bounds{2, 100000}}})},
          [options] { return sample(*options); }};
}

}  // namespace gyre::ground
