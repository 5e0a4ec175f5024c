#include "ground/design/design.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "common/base/interrupts.hpp"
#include "common/design/design.hpp"
#include "common/mission/requirements.hpp"
#include "ground/design/core/design_text.hpp"
#include "ground/whole_file.hpp"

namespace gyre::ground {
namespace {

using Clock = std::chrono::steady_clock;

struct DesignOptions {
  std::string requirements;
  std::string output;
  double seconds = 120.0;
  std::uint64_t seed = 1;
};

/// Asked at every step of a search, looks up now and then: whether the time is over, whether a person had enough.
class Watch {
 public:
  Watch(double seconds, design::Objective objective) : seconds_(seconds), objective_(objective) {}

  bool keep_going(const design::Progress& progress) {
    const Clock::time_point now = Clock::now();
    if (now - looked_ < std::chrono::milliseconds(20)) return going_;
    looked_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - begun_).count();
    if (take_interrupts().total() > 0 || elapsed_s > seconds_) going_ = false;
    if (now - said_ > std::chrono::seconds(1)) {
      said_ = now;
      std::fprintf(stderr, "%s\n", progress_line(elapsed_s, objective_, progress).c_str());
    }
    return going_;
  }

 private:
  double seconds_;
  design::Objective objective_;
  Clock::time_point begun_ = Clock::now();
  Clock::time_point said_ = begun_;
  Clock::time_point looked_ = begun_;
  bool going_ = true;
};

int design(const DesignOptions& options) {
  const Result<mission::Requirements> read = mission::read_requirements_file(options.requirements);
  if (!read) {
    std::fprintf(stderr, "%s\n", read.error().text.c_str());
    return program::kBadUsage;
  }
  std::error_code differ;
  if (std::filesystem::equivalent(options.requirements, options.output, differ)) {
    std::fprintf(stderr, "%s: are the requirements themselves; name another file for the mission\n",
                 options.output.c_str());
    return program::kBadUsage;
  }
  block_interrupts();
  const mission::Requirements& requirements = read.value();
  Watch watch(options.seconds, requirements.want.objective);
  const design::Design found =
      design::design(requirements.wanted(), options.seed,
                     [&watch](const design::Progress& progress) { return watch.keep_going(progress); });
  const std::string report = design_report(requirements, found);
  const bool to_stdout = options.output.empty();
  std::fputs(report.c_str(), to_stdout || !found.plan ? stderr : stdout);
  if (!found.plan) return program::kFailed;
  const std::string source = std::filesystem::path(options.requirements).filename().string();
  const std::string file = mission_file(requirements, found, source, options.seed);
  if (!to_stdout) {
    const auto problem = write_whole(options.output, file);
    if (problem) std::fprintf(stderr, "%s\n", problem->text.c_str());
    return problem ? program::kFailed : program::kGood;
  }
  return std::fputs(file.c_str(), stdout) >= 0 && std::fflush(stdout) == 0 ? program::kGood : program::kFailed;
}

}  // namespace

program::Command design_command() {
  const auto options = std::make_shared<DesignOptions>();
  return {"design",
          "Make a certified mission of requirements, or say which of them cannot be met together.",
          {program::own(
              {{"REQUIREMENTS", &options->requirements,
                "a mission with numbers left out and want { .. }, Protobuf text format (idl/mission.proto)",
                std::nullopt, program::Take::kByHand},
               {"-o,--output", &options->output, "where the mission goes; absent: to stdout, and the report to stderr",
                std::nullopt, program::Take::kUsually},
               {"--seconds", &options->seconds, "how long it may take; the best found by then is taken, as by ctrl-c",
                program::kPositive},
               {"--seed", &options->seed, "of what is drawn: orders of many carriers, places to begin",
                program::Bounds{0.0, 1e9}}})},
          [options] { return design(*options); }};
}

}  // namespace gyre::ground
