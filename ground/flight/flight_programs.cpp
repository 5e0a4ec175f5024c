#include "ground/flight/flight_programs.hpp"

#include <unistd.h>

#include <filesystem>
#include <system_error>

namespace gyre::ground {

Result<std::vector<Program>> flight_programs(const std::string& directory, const std::string& mission_path,
                                             const std::vector<CarrierId>& carriers,
                                             const std::vector<std::string>& network) {
  const std::string simulator = directory + "/gyre-simulator";
  const std::string coordinator = directory + "/gyre-coordinator";
  const std::string agent = directory + "/gyre-agent";
  for (const std::string& path : {simulator, coordinator, agent}) {
    if (::access(path.c_str(), X_OK) != 0) {
      return Error{path + " is missing or cannot be run: `gyre fly` needs gyre-simulator, gyre-coordinator and " +
                   "gyre-agent beside itself; build them all (cmake --build) or install them together"};
    }
  }
  std::vector<Program> programs{{"simulator", {simulator, mission_path}},
                                {kCoordinatorName, {coordinator, mission_path, "--engage"}}};
  for (const CarrierId id : carriers) {
    programs.push_back({"agent " + std::to_string(id), {agent, "--carrier", std::to_string(id)}});
  }
  for (Program& program : programs) {
    program.command.insert(program.command.end(), network.begin(), network.end());
  }
  return programs;
}

Result<std::string> own_directory() {
  std::error_code failure;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
  if (failure) return Error{"cannot find out where this program is: " + failure.message()};
  return self.parent_path().string();
}

}  // namespace gyre::ground
