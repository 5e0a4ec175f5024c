#include "common/program/mission_argument.hpp"

#include <cstdio>
#include <utility>

namespace gyre::program {

Option mission_argument(std::string& path, Take take) {
  return {"MISSION", &path, "mission file, Protobuf text format (idl/mission.proto)", std::nullopt, take};
}

Result<mission::Mission, ExitCode> read_mission(const std::string& path) {
  auto read = mission::read_mission_file(path);
  if (read) return std::move(read).value();
  std::fprintf(stderr, "%s\n", read.error().text.c_str());
  return kBadUsage;
}

}  // namespace gyre::program
