// What an agent costs in steady flight, beside its floor: a bare Fast DDS process with the same traffic in the same
// company (bench_idle_node). All run at once, so that they share the machine's mood, and four of each are measured, so
// that no single one's luck counts; aim: at most 1.2 times.

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "common/dds/node.hpp"
#include "ground/flight/child_process.hpp"
#include "ground/flight/flight_directory.hpp"
#include "tests/places.hpp"

namespace {

using gyre::ground::ChildProcess;

constexpr std::size_t kAgents = 4;  // of the mission, and of bench_idle_node
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
  // The times in `stat` count in hundredths of a second, of which there are only thirty; these, in nanoseconds.
  std::error_code gone;
  for (const auto& task : std::filesystem::directory_iterator(process / "task", gone)) {
    double cpu_ns = 0.0;
    std::istringstream(text_of(task.path() / "schedstat")) >> cpu_ns;
    cost.cpu_s += 1e-9 * cpu_ns;
  }
  std::istringstream memory(text_of(process / "smaps_rollup"));
  for (std::string line; std::getline(memory, line);) {
    if (line.rfind("Rss:", 0) == 0) cost.rss_kib = std::stod(line.substr(4));
    if (line.rfind("Pss:", 0) == 0) cost.pss_kib = std::stod(line.substr(4));
  }
  return cost;
}

/// The mean of them; absent when one of them has ended.
std::optional<Cost> mean_cost_of(const std::vector<pid_t>& processes) {
  Cost mean;
  const auto count = static_cast<double>(processes.size());
  for (const pid_t pid : processes) {
    const Cost cost = cost_of(pid);
    if (cost.rss_kib == 0.0) return std::nullopt;
    mean.cpu_s += cost.cpu_s / count;
    mean.rss_kib += cost.rss_kib / count;
    mean.pss_kib += cost.pss_kib / count;
  }
  return mean;
}

/// The agents among the processes whose parent is `parent`.
std::vector<pid_t> agents_of(pid_t parent) {
  const std::string children = "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children";
  std::istringstream pids(text_of(children));
  std::vector<pid_t> agents;
  for (pid_t pid = 0; pids >> pid;) {
    const std::string command = text_of("/proc/" + std::to_string(pid) + "/cmdline");
    if (command.find("--carrier") != std::string::npos) agents.push_back(pid);
  }
  return agents;
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
  const std::string bin = gyre::test::program_directory();
  const std::string mission = gyre::test::source_directory() + "/deploy/missions/paper.textproto";
  const std::string floor_domain = std::to_string(free_domain());
  const std::string seconds = std::to_string(kSettle_s + kMeasure_s + 60);

  const auto flight = ChildProcess::start({bin + "/gyre", "fly", mission, "--duration", "600"}, home + "/flight.txt");
  if (!flight) return fail(flight.error().text, "");
  std::vector<ChildProcess> bare;
  std::vector<pid_t> bare_agents;
  const auto start_bare = [&](const std::string& role, const std::vector<std::string>& carrier = {}) {
    std::vector<std::string> command{bin + "/bench_idle_node", role, seconds, floor_domain};
    command.insert(command.end(), carrier.begin(), carrier.end());
    auto process = ChildProcess::start(command, home + "/bare.txt");
    if (!process) return;
    if (!carrier.empty()) bare_agents.push_back(process.value().pid());
    bare.push_back(std::move(process).value());
  };
  for (const char* const hub : {"ground", "coordinator", "simulator"}) start_bare(hub);
  for (std::size_t id = 1; id <= kAgents; ++id) start_bare("agent", {std::to_string(id)});
  if (bare.size() != 3 + kAgents) return fail("the bare processes cannot be started", home + "/bare.txt");
  if (!flying_within(home + "/flight.txt", 60)) return fail("the flight did not begin", home + "/flight.txt");
  const std::vector<pid_t> agents = agents_of(flight.value().pid());
  if (agents.size() != kAgents) return fail("the flight has not its agents", home + "/flight.txt");

  std::this_thread::sleep_for(std::chrono::seconds(kSettle_s));
  const auto agents_before = mean_cost_of(agents);
  const auto bare_before = mean_cost_of(bare_agents);
  std::this_thread::sleep_for(std::chrono::seconds(kMeasure_s));
  auto agent_cost = mean_cost_of(agents);
  auto bare_cost = mean_cost_of(bare_agents);
  if (!agents_before || !agent_cost) return fail("an agent ended early", home + "/flight.txt");
  if (!bare_before || !bare_cost) return fail("a bare process ended early", home + "/bare.txt");
  agent_cost->cpu_s -= agents_before->cpu_s;
  bare_cost->cpu_s -= bare_before->cpu_s;

  std::printf("An agent in steady flight (100 Hz), mean of %zu, over %d s:\n\n", kAgents, kMeasure_s);
  std::printf("  %-22s %8s %12s %12s\n", "", "CPU %", "RSS MiB", "PSS MiB");
  row("gyre-agent", *agent_cost);
  row("bare Fast DDS process", *bare_cost);
  std::printf("  %-22s %8.2f %12.2f %12.2f   (aim 1.20)\n", "ratio", agent_cost->cpu_s / bare_cost->cpu_s,
              agent_cost->rss_kib / bare_cost->rss_kib, agent_cost->pss_kib / bare_cost->pss_kib);
  return 0;
}
