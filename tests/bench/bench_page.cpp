// What the page's server costs beside 48 carriers at 100 Hz, with nobody, one, ten and a hundred who watch.
//
// The swarm is spoken_swarm's. The floor beside the server has the readers of a page.
//
//   bench_page             the table
//   bench_page listen D    the floor, on domain D

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
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
#include "tests/bench/spoken_swarm.hpp"
#include "tests/page/connection.hpp"
#include "tests/places.hpp"

namespace {

using namespace gyre;
using bench::cpu_s;
using ground::ChildProcess;
using namespace std::chrono_literals;

constexpr double kSettle_s = 5.0;
constexpr double kMeasure_s = 10.0;

double resident_mb(pid_t pid) {
  std::ifstream lines("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024.0;
  }
  return -1.0;
}

int listen(int domain) {
  const auto node = std::move(dds::Node::open({{}, domain, "127.0.0.1", {}})).value();
  ground::Listening listening(*node, ground::Interest::kCarriers);
  std::vector<CarrierId> ids;
  for (CarrierId id = 1; id <= bench::kSpokenCarriers; ++id) ids.push_back(id);
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
  const int domain = bench::free_domain();
  const auto folder = std::move(ground::FlightDirectory::make(std::nullopt)).value();
  const std::string log = folder.path() + "/server.txt";
  bench::SpokenSwarm swarm(domain);
  auto floor = std::move(ChildProcess::start({bench::own_program(), "listen", std::to_string(domain)},
                                             folder.path() + "/floor.txt"))
                   .value();
  auto server = std::move(ChildProcess::start({gyre::test::program_directory() + "/gyre", "serve", "--port", "0",
                                               "--domain", std::to_string(domain)},
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
  std::printf("%u carriers at 100 Hz, %.0f s each\n\n", bench::kSpokenCarriers, kMeasure_s);
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
