#include "ground/plot/plot.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "common/mechanics/certificate.hpp"
#include "common/program/mission_argument.hpp"
#include "ground/bounded_motion.hpp"
#include "ground/plot/core/plot_svg.hpp"
#include "ground/whole_file.hpp"

namespace gyre::ground {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::string mission, picture;
};

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
  const auto problem = write_whole(options.picture, plot_svg(mission.value().name, plan, certificate));
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
