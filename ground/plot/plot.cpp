#include "ground/plot/plot.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "common/base/result.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/program/mission_argument.hpp"
#include "ground/bounded_motion.hpp"
#include "ground/plot/core/plot_svg.hpp"

namespace gyre::ground {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::string mission, picture;
};

bool written(const fs::path& file, const std::string& content) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << content;
  out.close();
  return out.good();
}

/// Whole or not at all: whoever reads the file meanwhile reads the old picture or the new one. What is there and no
/// file (/dev/stdout, a pipe) is written as it is.
std::optional<Error> write_picture(const std::string& path, const std::string& picture) {
  const Error failed{path + ": cannot be written; name a file in a folder that is there and yours to write"};
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (fs::is_directory(there)) return Error{path + ": is a directory; name a file in it"};
  if (fs::exists(there) && !fs::is_regular_file(there))
    return written(path, picture) ? std::nullopt : std::optional(failed);
  const fs::path target = fs::exists(there) ? fs::canonical(path, problem) : fs::path(path);
  const fs::path aside = target.string() + "." + std::to_string(::getpid()) + ".new";
  if (written(aside, picture)) {
    fs::rename(aside, target, problem);
  } else {
    problem = std::make_error_code(std::errc::io_error);
  }
  if (!problem) return std::nullopt;
  std::error_code ignored;
  fs::remove(aside, ignored);
  return failed;
}

int plot(const PlotOptions& options) {
  const auto mission = program::read_mission(options.mission);
  if (!mission) return mission.error();
  std::error_code differ;
  if (fs::equivalent(options.mission, options.picture, differ)) {
    std::fprintf(stderr, "%s: is the mission itself; name another file for the picture\n", options.picture.c_str());
    return program::kBadUsage;
  }
  const mechanics::Plan& plan = mission.value().plan;
  const mechanics::Certificate certificate = mechanics::certify(plan);
  if (!has_bounded_motion(certificate)) {
    std::fputs(unbounded_text(options.mission, certificate).c_str(), stderr);
    return program::kFailed;
  }
  const auto problem = write_picture(options.picture, plot_svg(mission.value().name, plan, certificate));
  if (!problem) return program::kGood;
  std::fprintf(stderr, "%s\n", problem->text.c_str());
  return program::kBadUsage;
}

}  // namespace

program::Command plot_command() {
  const auto options = std::make_shared<PlotOptions>();
  return {
      "plot",
      "Draw a mission as an SVG: orbits, cables, load, closest approaches; figures under their limits.",
      {program::own({program::mission_argument(options->mission),
                     {"-o,--output", &options->picture, "the picture's file", std::nullopt, program::Take::kByHand}})},
      [options] { return plot(*options); }};
}

}  // namespace gyre::ground
