// What the page's server costs beside 48 carriers at 100 Hz, with nobody, one, ten and a hundred who watch.
//
// The swarm is one process that says what 49 would and the page hears: per carrier state at 100 Hz, status at 10 Hz,
// plans once; beacons at 50 Hz, the load at 100 Hz, the coordinator's word at 2 Hz, the mission once. Beside the
// server, at the same time, its floor: a process with the same readers that throws away what they bring.
//
//   bench_page             the table
//   bench_page listen D    the floor, on domain D

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/dds/clock.hpp"
#include "ground/flight/child_process.hpp"
#include "ground/flight/flight_directory.hpp"
#include "ground/swarm/listening.hpp"
#include "tests/ground/heard_swarm.hpp"
#include "tests/page/connection.hpp"

namespace {

using namespace gyre;
using ground::ChildProcess;
using namespace std::chrono_literals;

constexpr std::size_t kCarriers = 48;
constexpr double kSettle_s = 5.0;
constexpr double kMeasure_s = 10.0;

double cpu_s(pid_t pid) {
  double sum_s = 0.0;
  std::error_code gone;
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", gone)) {
    double cpu_ns = 0.0;
    std::ifstream(task.path() / "schedstat") >> cpu_ns;
    sum_s += 1e-9 * cpu_ns;
  }
  return sum_s;
}

double resident_mb(pid_t pid) {
  std::ifstream lines("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024.0;
  }
  return -1.0;
}

/// Says what a swarm says, for so long.
class Swarm {
 public:
  explicit Swarm(int domain)
      : node_(std::move(dds::Node::open({{dds::Hub::kCoordinator, std::nullopt}, domain, "127.0.0.1", {}})).value()),
        beacons_(node_->writer<protocol::Beacon>()),
        loads_(node_->writer<protocol::LoadState>()),
        words_(node_->writer<protocol::CoordinatorStatus>()),
        missions_(node_->writer<protocol::MissionText>()) {
    for (const auto& [id, held] : swarm_.held) {
      states_.push_back(node_->writer<protocol::CarrierState>(id));
      statuses_.push_back(node_->writer<protocol::AgentStatus>(id));
      plans_.push_back(node_->writer<protocol::HeldPlans>(id));
      plans_.back().write(held);
    }
    missions_.write(swarm_.text);
  }

  void say(double duration_s) {
    const LocalTime end = dds::now() + from_seconds(duration_s);
    for (LocalTime next = dds::now(); next < end; next += 10ms) {
      std::this_thread::sleep_until(std::chrono::steady_clock::time_point(next.time_since_epoch()));
      tick();
    }
  }

 private:
  void tick() {
    ++ticks_;
    swarm_.pass(10ms);
    for (auto& [id, state] : swarm_.vehicles) {
      state.sequence = ticks_;
      states_[id - 1].write(state);
      if (ticks_ % 10 == id % 10) statuses_[id - 1].write(swarm_.agents.at(id));
    }
    swarm_.load.sequence = ticks_;
    loads_.write(swarm_.load);
    if (ticks_ % 2 == 0) beacons_.write(swarm_.beacon);
    if (ticks_ % 50 == 0) words_.write(swarm_.status);
  }

  ground::test::HeardSwarm swarm_{kCarriers};
  std::unique_ptr<dds::Node> node_;
  dds::Writer<protocol::Beacon> beacons_;
  dds::Writer<protocol::LoadState> loads_;
  dds::Writer<protocol::CoordinatorStatus> words_;
  dds::Writer<protocol::MissionText> missions_;
  std::vector<dds::Writer<protocol::CarrierState>> states_;
  std::vector<dds::Writer<protocol::AgentStatus>> statuses_;
  std::vector<dds::Writer<protocol::HeldPlans>> plans_;
  std::uint64_t ticks_ = 0;
};

int listen(int domain) {
  const auto node = std::move(dds::Node::open({{}, domain, "127.0.0.1", {}})).value();
  ground::Listening listening(*node, ground::Interest::kCarriers);
  std::vector<CarrierId> ids;
  for (CarrierId id = 1; id <= kCarriers; ++id) ids.push_back(id);
  listening.attend(ids);
  for (;;) (void)listening.sleep_until(dds::now() + 40ms);  // until it is killed
}

/// Browsers that take what comes, in a thread of their own.
class Watchers {
 public:
  Watchers(int port, int count) {
    for (int i = 0; i < count; ++i) {
      connections_.emplace_back(port);
      connections_.back().send("GET /api/events HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n");
    }
    thread_ = std::thread([this] { take(); });
  }
  ~Watchers() {
    over_ = true;
    thread_.join();
  }
  Watchers(const Watchers&) = delete;
  Watchers& operator=(const Watchers&) = delete;

  [[nodiscard]] double megabytes() const { return 1e-6 * static_cast<double>(bytes_); }

 private:
  void take() {
    while (!over_) {
      for (test::Connection& connection : connections_) {
        if (connection.news(0ms)) bytes_ += connection.drains();
      }
      std::this_thread::sleep_for(20ms);
    }
  }

  std::vector<test::Connection> connections_;
  std::atomic<bool> over_{false};
  std::atomic<std::size_t> bytes_{0};
  std::thread thread_;
};

int measure() {
  int domain = 70;
  while (dds::seat_holder({dds::Hub::kCoordinator, std::nullopt}, domain).taken) ++domain;
  const auto folder = std::move(ground::FlightDirectory::make(std::nullopt)).value();
  const std::string own = std::filesystem::read_symlink("/proc/self/exe");
  const std::string log = folder.path() + "/server.txt";
  Swarm swarm(domain);
  auto floor =
      std::move(ChildProcess::start({own, "listen", std::to_string(domain)}, folder.path() + "/floor.txt")).value();
  auto server = std::move(ChildProcess::start({std::string(GYRE_BIN_DIR) + "/gyre", "serve", "--port", "0", "--domain",
                                               std::to_string(domain)},
                                              log))
                    .value();
  swarm.say(kSettle_s);
  std::ostringstream said;
  said << std::ifstream(log).rdbuf();
  const std::size_t at = said.str().find("http://127.0.0.1:");
  if (at == std::string::npos) {
    std::fprintf(stderr, "no page is served:\n%s", said.str().c_str());
    return EXIT_FAILURE;
  }
  const int port = std::stoi(said.str().substr(at + 17));
  std::printf("%zu carriers at 100 Hz, %.0f s each\n\n", kCarriers, kMeasure_s);
  std::printf("%9s  %14s  %14s  %10s  %12s\n", "watchers", "server, cores", "floor, cores", "MB", "MB/s in all");
  for (const int count : {0, 1, 10, 100}) {
    const Watchers watchers(port, count);
    swarm.say(2.0);
    const double before_mb = watchers.megabytes(), server_s = cpu_s(server.pid()), floor_s = cpu_s(floor.pid());
    swarm.say(kMeasure_s);
    std::printf("%9d  %14.3f  %14.3f  %10.1f  %12.2f\n", count, (cpu_s(server.pid()) - server_s) / kMeasure_s,
                (cpu_s(floor.pid()) - floor_s) / kMeasure_s, resident_mb(server.pid()),
                (watchers.megabytes() - before_mb) / kMeasure_s);
  }
  server.send(SIGTERM);
  for (int i = 0; i < 200 && !server.ended(); ++i) std::this_thread::sleep_for(20ms);
  floor.send(SIGKILL);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "listen") return listen(std::atoi(argv[2]));
  return measure();
}
