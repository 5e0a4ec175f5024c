#include "ground/check/sample.hpp"

#include <cstdio>
#include <memory>
#include <string>

#include "common/mechanics/certificate.hpp"
#include "common/program/mission_argument.hpp"
#include "ground/bounded_motion.hpp"
#include "ground/check/motion_csv.hpp"

namespace gyre::ground {
namespace {

struct SampleOptions {
  std::string mission;
  int count = 100;
};

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
  if (!has_bounded_motion(certificate)) {
    std::fputs(unbounded_text(options.mission, certificate).c_str(), stderr);
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
