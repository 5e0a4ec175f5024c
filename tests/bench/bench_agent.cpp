// What an agent costs in steady flight, beside its floor: a bare Fast DDS process with the same traffic
// (bench_idle_node). Both run at once, so that they share the machine's mood; aim: at most 1.3 times.

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "common/dds/node.hpp"
#include "ground/flight/child_process.hpp"
#include "ground/flight/flight_directory.hpp"

namespace {

using gyre::ground::ChildProcess;

constexpr int kSettle_s = 5;
constexpr int kMeasure_s = 20;

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

struct Cost {
  double cpu_s = 0.0;
  double rss_kib = 0.0;
  double pss_kib = 0.0;
};

Cost cost_of(pid_t pid) {
  const std::filesystem::path process = "/proc/" + std::to_string(pid);
  Cost cost;
  // proc(5): utime and stime are fields 14 and 15; the name before them may hold anything, but ends with ')'.
  const std::string stat = text_of(process / "stat");
  std::istringstream fields(stat.substr(std::min(stat.rfind(')'), stat.size() - 1) + 1));
  std::string field;
  for (int number = 3; fields >> field; ++number) {
    if (number == 14 || number == 15) cost.cpu_s += std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  std::istringstream memory(text_of(process / "smaps_rollup"));
  for (std::string line; std::getline(memory, line);) {
    if (line.rfind("Rss:", 0) == 0) cost.rss_kib = std::stod(line.substr(4));
    if (line.rfind("Pss:", 0) == 0) cost.pss_kib = std::stod(line.substr(4));
  }
  return cost;
}

/// The agent of carrier 1 among the processes whose parent is `parent`.
std::optional<pid_t> agent_of(pid_t parent) {
  const std::string children = "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children";
  std::istringstream pids(text_of(children));
  for (pid_t pid = 0; pids >> pid;) {
    const std::string command = text_of("/proc/" + std::to_string(pid) + "/cmdline");
    if (command.find(std::string("--carrier\0001\000", 12)) != std::string::npos) return pid;
  }
  return std::nullopt;
}

bool flying_within(const std::string& log, int limit_s) {
  for (int i = 0; i < limit_s * 10; ++i) {
    if (text_of(log).find("flying") != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

int free_domain() {
  for (int domain = gyre::dds::kMaxDomain; domain > 0; --domain) {
    bool taken = false;
    for (const auto hub : {gyre::dds::Hub::kCoordinator, gyre::dds::Hub::kSimulator, gyre::dds::Hub::kGround}) {
      taken = taken || gyre::dds::seat_holder({hub, std::nullopt}, domain).taken;
    }
    if (!taken) return domain;
  }
  return gyre::dds::kMaxDomain;
}

void row(const char* name, const Cost& cost) {
  std::printf("  %-22s %8.2f %12.1f %12.1f\n", name, 100.0 * cost.cpu_s / kMeasure_s, cost.rss_kib / 1024.0,
              cost.pss_kib / 1024.0);
}

int fail(const std::string& what, const std::string& log) {
  std::fprintf(stderr, "%s; it said:\n%s", what.c_str(), text_of(log).c_str());
  return 1;
}

}  // namespace

int main() {
  const auto made = gyre::ground::FlightDirectory::make(std::nullopt);
  if (!made) return fail(made.error().text, "");
  const std::string home = made.value().path();
  const std::string bin = GYRE_BIN_DIR;
  const std::string mission = std::string(GYRE_SOURCE_DIR) + "/deploy/missions/paper.textproto";
  const std::string floor_domain = std::to_string(free_domain());
  const std::string seconds = std::to_string(kSettle_s + kMeasure_s + 60);

  const auto flight = ChildProcess::start({bin + "/gyre", "fly", mission, "--duration", "600"}, home + "/flight.txt");
  const auto world = ChildProcess::start({bin + "/bench_idle_node", "world", seconds, floor_domain}, home + "/w.txt");
  const auto floor = ChildProcess::start({bin + "/bench_idle_node", "agent", seconds, floor_domain}, home + "/f.txt");
  if (!flight) return fail(flight.error().text, "");
  if (!world || !floor) return fail((world ? floor : world).error().text, "");
  if (!flying_within(home + "/flight.txt", 60)) return fail("the flight did not begin", home + "/flight.txt");
  const auto agent = agent_of(flight.value().pid());
  if (!agent) return fail("the flight has no agent for carrier 1", home + "/flight.txt");

  std::this_thread::sleep_for(std::chrono::seconds(kSettle_s));
  const auto measure = [](pid_t pid, const Cost& before) {
    Cost cost = cost_of(pid);
    cost.cpu_s -= before.cpu_s;
    return cost;
  };
  const Cost agent_before = cost_of(*agent);
  const Cost floor_before = cost_of(floor.value().pid());
  std::this_thread::sleep_for(std::chrono::seconds(kMeasure_s));
  const Cost agent_cost = measure(*agent, agent_before);
  const Cost floor_cost = measure(floor.value().pid(), floor_before);
  if (agent_cost.rss_kib == 0.0) return fail("the agent ended early", home + "/flight.txt");
  if (floor_cost.rss_kib == 0.0) return fail("the bare process ended early", home + "/f.txt");

  std::printf("An agent in steady flight (100 Hz), over %d s:\n\n", kMeasure_s);
  std::printf("  %-22s %8s %12s %12s\n", "", "CPU %", "RSS MiB", "PSS MiB");
  row("gyre-agent", agent_cost);
  row("bare Fast DDS process", floor_cost);
  std::printf("  %-22s %8.2f %12.2f %12.2f   (aim 1.30)\n", "ratio", agent_cost.cpu_s / floor_cost.cpu_s,
              agent_cost.rss_kib / floor_cost.rss_kib, agent_cost.pss_kib / floor_cost.pss_kib);
  return 0;
}
