// How long a swarm takes from the first process to READY (every agent with swarm time and an accepted plan), beside its
// floor: bare Fast DDS processes that only find each other in the same star (bench_idle_star). And whether a large one
// flies steadily on this machine.
//
// Both are started alike, one process after the other, and timed by this program from before the first of them.

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "common/mission/mission.hpp"
#include "ground/flight/child_process.hpp"
#include "ground/flight/flight_directory.hpp"
#include "tests/places.hpp"
#include "tests/processes/fault_flight.hpp"
#include "tests/processes/private_network.hpp"

namespace {

using gyre::kPi;
using gyre::ground::ChildProcess;
using gyre::test::FaultFlight;
using gyre::test::FlightRecord;

constexpr int kRounds = 7;
constexpr double kLimit_s = 120.0;
constexpr int kSteady_s = 10;

/// A ring of n attachments half a metre apart, edge headings, circles of about half a metre.
gyre::mission::Mission ring(int n) {
  const double count = n;
  const double radius = std::max(1.2, 0.6 * count / (2.0 * kPi));
  gyre::mission::Mission mission;
  mission.name = "ring of " + std::to_string(n);
  auto& plan = mission.plan;
  plan.load.mass_kg = 0.075 * count;
  plan.load.inertia_b_kg_m2 = 0.5 * plan.load.mass_kg * radius * radius * Eigen::Matrix3d::Identity();
  plan.cable = {1e4, 1e3};
  plan.cycle.rate_rad_s = 0.5;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * i / count;
    const auto id = static_cast<gyre::CarrierId>(i + 1);
    const auto next = static_cast<gyre::CarrierId>((i + 1) % n + 1);
    plan.carriers.push_back(
        {id, {radius * std::cos(angle), radius * std::sin(angle), 0.25}, gyre::mechanics::LengthLaw::level(0.9)});
    // The two edges of a carrier all but cancel in a large ring: the amplitude makes up for it.
    const double heading = angle + 0.5 * kPi + kPi / count;
    plan.cycle.edges.push_back({id, next, 0.0, 0.4 / std::sin(kPi / count), heading});
  }
  return mission;
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::optional<double> swarm_start_s(const FaultFlight::Options& options) {
  const gyre::LocalTime begin = gyre::dds::now();
  const auto flight = FaultFlight::start(options);
  if (!flight) return std::nullopt;
  // There are no vehicles here, which an agent asks for where it is; it waits for them when it is READY.
  const auto ready = [](const gyre::protocol::AgentStatus& s) {
    return !s.accepted.empty() && s.clock_uncertainty < std::chrono::seconds(1);
  };
  if (!FaultFlight::seconds_until(kLimit_s, [&] { return flight.value()->every_agent(ready); })) return std::nullopt;
  return gyre::seconds(gyre::dds::now() - begin);
}

std::optional<double> bare_start_s(int n, const std::string& home) {
  const std::string program = gyre::test::program_directory() + "/bench_idle_star";
  std::vector<ChildProcess> processes;
  const gyre::LocalTime begin = gyre::dds::now();
  std::vector<std::string> unmatched;
  const auto start = [&](const std::string& role, int number) {
    unmatched.push_back(home + "/" + role + "-" + std::to_string(number) + ".txt");
    auto process = ChildProcess::start({program, role, std::to_string(number)}, unmatched.back());
    if (process) processes.push_back(std::move(process).value());
  };
  start("watch", n);
  for (int i = 1; i <= n; ++i) start("spoke", i);
  start("hub", n);
  const auto matched = [&] {
    while (!unmatched.empty() && text_of(unmatched.back()).find("matched") != std::string::npos) unmatched.pop_back();
    return unmatched.empty();
  };
  if (!FaultFlight::seconds_until(kLimit_s, matched)) return std::nullopt;
  return gyre::seconds(gyre::dds::now() - begin);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// "0.52 (0.41 .. 0.60)"
std::string described(const std::vector<double>& values) {
  if (values.empty()) return "-";
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return gyre::text("%.2f (%.2f .. %.2f)", median(values), *least, *most);
}

double cpu_s(pid_t pid) {
  const std::string stat = text_of("/proc/" + std::to_string(pid) + "/stat");
  std::istringstream fields(stat.substr(std::min(stat.rfind(')'), stat.size() - 1) + 1));
  std::string field;
  double sum = 0.0;
  // proc(5): utime and stime are fields 14 and 15; the name before them ends with ')'.
  for (int number = 3; fields >> field; ++number) {
    if (number == 14 || number == 15) sum += std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  return sum;
}

/// A large swarm without its twin: what is measured is the swarm, and its carriers may be anywhere.
int fly_steadily(const FaultFlight::Options& options, int n) {
  const auto flight = FaultFlight::start(options);
  if (!flight) return 1;
  const FaultFlight& swarm = *flight.value();
  if (!FaultFlight::seconds_until(kLimit_s, [&] { return swarm.all_flying(); })) {
    std::printf("  n = %d did not fly within %.0f s\n%s", n, kLimit_s, swarm.said("coordinator").c_str());
    return 1;
  }
  std::vector<std::string> names{"coordinator"};
  for (const auto id : swarm.carriers()) names.push_back(gyre::test::agent_name(id));
  const auto cost_s = [&](const std::string& name) { return cpu_s(swarm.pid(name)); };
  struct Beacons {
    std::uint64_t received = 0, missed = 0;
  };
  const auto beacons = [&] {
    return swarm.observer().ask([](const FlightRecord& record) {
      Beacons sum;
      for (const auto& [id, carrier] : record.carriers) {
        sum.received += carrier.statuses.back().message.beacons_received;
        sum.missed += carrier.statuses.back().message.beacons_missed;
      }
      return sum;
    });
  };
  double before = 0.0;
  for (const auto& name : names) before += cost_s(name);
  const double coordinator_before = cost_s("coordinator");
  const Beacons first = beacons();
  int flying = 0;
  for (int i = 0; i < kSteady_s * 10; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    flying += swarm.all_flying() ? 1 : 0;
  }
  const Beacons last = beacons();
  double after = 0.0;
  for (const auto& name : names) after += cost_s(name);
  const auto missed = static_cast<double>(last.missed - first.missed);
  std::printf(
      "  n = %d, %d s: all flying in %d %% of %d looks; %.2f of %ld cores, %.2f of them the coordinator; %.2f %% of "
      "the "
      "beacons missed\n",
      n, kSteady_s, flying * 100 / (kSteady_s * 10), kSteady_s * 10, (after - before) / kSteady_s,
      ::sysconf(_SC_NPROCESSORS_ONLN), (cost_s("coordinator") - coordinator_before) / kSteady_s,
      100.0 * missed / (missed + static_cast<double>(last.received - first.received)));
  return 0;
}

}  // namespace

int main() {
  const auto network = gyre::test::PrivateNetwork::enter();
  const auto directory = gyre::ground::FlightDirectory::make(std::nullopt);
  if (!network || !directory) {
    std::fprintf(stderr, "SKIPPED: %s\n", network ? directory.error().text.c_str() : network.error().text.c_str());
    return 1;
  }
  const std::string home = directory.value().path();
  const auto options = [&](int n, bool engage) {
    const std::string mission = home + "/ring.textproto";
    std::ofstream(mission) << gyre::mission::to_text(ring(n));
    return FaultFlight::Options{mission, home,  gyre::test::program_directory(), {},
                                engage,  false, gyre::test::Watch::kStatuses};
  };

  std::printf("From the first process to READY, median of %d (aim: within 1.5 times the floor):\n\n", kRounds);
  std::printf("  %6s %24s %24s %8s\n", "agents", "Gyre, s", "bare Fast DDS star, s", "ratio");
  for (const int n : {4, 16, 48}) {
    std::vector<double> swarm;
    std::vector<double> bare;
    for (int round = 0; round < kRounds; ++round) {
      if (const auto took = swarm_start_s(options(n, false))) swarm.push_back(*took);
      if (const auto took = bare_start_s(n, home)) bare.push_back(*took);
    }
    if (swarm.size() < kRounds || bare.size() < kRounds) std::printf("  a start took longer than %.0f s\n", kLimit_s);
    std::printf("  %6d %24s %24s %8.2f\n", n, described(swarm).c_str(), described(bare).c_str(),
                median(swarm) / median(bare));
    std::fflush(stdout);
  }
  std::printf("\nIn steady flight:\n\n");
  return fly_steadily(options(64, true), 64);
}
