// What a recorder costs beside 48 carriers at 100 Hz, and whether it loses anything.
//
// The swarm is one process that says what 49 would: per carrier setpoint and state at 100 Hz, status at 10 Hz, plans
// once; beacons at 50 Hz, the load at 100 Hz, the coordinator's word at 2 Hz. Beside the recorder, at the same time,
// its floor: a process that has the same readers and throws away what they bring. What is left is decoded for the
// scene, packed and written; of that, packing alone is measured again afterwards.
//
//   bench_recording             the table
//   bench_recording listen D    the floor, on domain D

#include <zstd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/dds/clock.hpp"
#include "common/dds/node.hpp"
#include "ground/flight/child_process.hpp"
#include "ground/flight/flight_directory.hpp"
#include "ground/recording/core/mcap_index.hpp"
#include "ground/recording/core/mcap_records.hpp"
#include "ground/recording/recording_file.hpp"

namespace {

using namespace gyre;
using ground::ChildProcess;
using namespace std::chrono_literals;

constexpr CarrierId kCarriers = 48;
constexpr double kSettle_s = 6.0;
constexpr double kMeasure_s = 20.0;

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

/// Says what a swarm says, for so long.
class Swarm {
 public:
  explicit Swarm(int domain)
      : node_(std::move(dds::Node::open({{dds::Hub::kCoordinator, std::nullopt}, domain, "127.0.0.1", {}})).value()),
        beacons_(node_->writer<protocol::Beacon>()),
        loads_(node_->writer<protocol::LoadState>()),
        words_(node_->writer<protocol::CoordinatorStatus>()) {
    for (CarrierId id = 1; id <= kCarriers; ++id) {
      setpoints_.push_back(node_->writer<protocol::Setpoint>(id));
      states_.push_back(node_->writer<protocol::CarrierState>(id));
      statuses_.push_back(node_->writer<protocol::AgentStatus>(id));
      plans_.push_back(node_->writer<protocol::HeldPlans>(id));
      word_.carriers.push_back(id);
      plans_.back().write(held(id));
    }
    words_.write(word_);
  }

  void say(double duration_s) {
    const LocalTime end = dds::now() + from_seconds(duration_s);
    for (LocalTime next = dds::now(); next < end; next += 10ms) {
      std::this_thread::sleep_until(std::chrono::steady_clock::time_point(next.time_since_epoch()));
      tick(seconds(next.time_since_epoch()));
    }
  }

 private:
  static protocol::HeldPlans held(CarrierId id) {
    mechanics::CarrierSlice slice;
    slice.id = id;
    slice.particular_force_w_n = {0.1, 0.2, 5.0};
    slice.incoming = {{1, 0, 0}, 0, 1, 0};
    slice.outgoing = {{0, 1, 0}, 0, 1, 1.5};
    slice.rate_rad_s = 0.5;
    slice.law = mechanics::LengthLaw::fixed(3.0);
    return {id, 1, {{{1, 1}, slice}}, {}};
  }

  void tick(double t_s) {
    ++ticks_;
    for (CarrierId id = 1; id <= kCarriers; ++id) {
      const double angle = 0.5 * t_s + id;
      protocol::Setpoint setpoint;
      setpoint.carrier = id;
      setpoint.incarnation = 1;
      setpoint.sequence = ticks_;
      setpoint.position_w_m = {3 * std::cos(angle), 3 * std::sin(angle), 5 + 0.1 * std::sin(2 * angle)};
      setpoint.velocity_w_m_s = {-1.5 * std::sin(angle), 1.5 * std::cos(angle), 0.1 * std::cos(2 * angle)};
      setpoint.acceleration_w_m_s2 = -0.25 * setpoint.position_w_m;
      setpoint.direction_w = setpoint.position_w_m.normalized();
      setpoint.tension_n = 5 + std::sin(angle);
      setpoints_[id - 1].write(setpoint);
      protocol::CarrierState state;
      state.carrier = id;
      state.incarnation = 1;
      state.sequence = ticks_;
      state.position_w_m = 1.0001 * setpoint.position_w_m;
      state.velocity_w_m_s = setpoint.velocity_w_m_s;
      state.tension_n = setpoint.tension_n;
      state.cable_length_m = setpoint.position_w_m.norm();
      states_[id - 1].write(state);
      if (ticks_ % 10 == id % 10) statuses_[id - 1].write(status(id, t_s));
    }
    protocol::LoadState load;
    load.incarnation = 1;
    load.sequence = ticks_;
    load.position_w_m.x() = 1e-6 * std::sin(t_s);
    loads_.write(load);
    if (ticks_ % 2 == 0) beacons_.write(beacon());
    if (ticks_ % 50 == 0) words_.write(word_);
  }

  [[nodiscard]] protocol::Beacon beacon() const {
    protocol::Beacon beacon;
    beacon.term = 1;
    beacon.sequence = ticks_;
    beacon.course.term = 1;
    return beacon;
  }
  [[nodiscard]] protocol::AgentStatus status(CarrierId id, double t_s) const {
    protocol::AgentStatus status;
    status.carrier = id;
    status.incarnation = 1;
    status.sequence = ticks_;
    status.clock_drift_ppm = std::sin(t_s);
    status.address = "127.0.0.1 (vehicle, pid 1)";
    return status;
  }

  std::unique_ptr<dds::Node> node_;
  dds::Writer<protocol::Beacon> beacons_;
  dds::Writer<protocol::LoadState> loads_;
  dds::Writer<protocol::CoordinatorStatus> words_;
  std::vector<dds::Writer<protocol::Setpoint>> setpoints_;
  std::vector<dds::Writer<protocol::CarrierState>> states_;
  std::vector<dds::Writer<protocol::AgentStatus>> statuses_;
  std::vector<dds::Writer<protocol::HeldPlans>> plans_;
  protocol::CoordinatorStatus word_;
  std::uint64_t ticks_ = 0;
};

int listen(int domain) {
  const auto node = std::move(dds::Node::open({{}, domain, "127.0.0.1", {}})).value();
  const auto forget = [](const dds::RecordedSample&) {};
  node->record(forget);
  for (CarrierId id = 1; id <= kCarriers; ++id) node->record(forget, id);
  for (;;) std::this_thread::sleep_for(1s);  // until it is killed
}

/// Of all that is in the chunks of a recording: bytes, and the time that zstd takes for them.
std::pair<double, double> packing_cost(const ground::McapSource& source, const ground::McapIndex& index) {
  double bytes = 0.0;
  double taken_s = 0.0;
  for (const auto& chunk : index.chunks()) {
    Bytes record(static_cast<std::size_t>(chunk.length));
    if (!source.read(chunk.offset, record.size(), record.data())) continue;
    const auto packed = ground::read_chunk({record.data() + ground::kRecordHead, record.size() - ground::kRecordHead});
    const auto records = packed ? ground::unpack(*packed) : Result<Bytes>(Error{});
    if (!records) continue;
    Bytes to(::ZSTD_compressBound(records.value().size()));
    const auto begin = std::chrono::steady_clock::now();
    bytes += static_cast<double>(records.value().size());
    (void)::ZSTD_compress(to.data(), to.size(), records.value().data(), records.value().size(), 1);
    taken_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  return {bytes, taken_s};
}

int measure() {
  int domain = 70;
  while (dds::seat_holder({dds::Hub::kCoordinator, std::nullopt}, domain).taken) ++domain;
  const auto folder = std::move(ground::FlightDirectory::make(std::nullopt)).value();
  const std::string path = folder.path() + "/recording.mcap";
  const std::string own = std::filesystem::read_symlink("/proc/self/exe");
  Swarm swarm(domain);
  auto floor =
      std::move(ChildProcess::start({own, "listen", std::to_string(domain)}, folder.path() + "/floor.txt")).value();
  auto recorder = std::move(ChildProcess::start({std::string(GYRE_BIN_DIR) + "/gyre", "record", "-o", path, "--domain",
                                                 std::to_string(domain)},
                                                folder.path() + "/recorder.txt"))
                      .value();
  swarm.say(kSettle_s);
  const double recorder_before_s = cpu_s(recorder.pid());
  const double floor_before_s = cpu_s(floor.pid());
  swarm.say(kMeasure_s);
  const double recorder_cost = (cpu_s(recorder.pid()) - recorder_before_s) / kMeasure_s;
  const double floor_cost = (cpu_s(floor.pid()) - floor_before_s) / kMeasure_s;
  recorder.send(SIGTERM);
  for (int i = 0; i < 500 && !recorder.ended(); ++i) std::this_thread::sleep_for(20ms);
  floor.send(SIGKILL);

  const auto source = ground::open_recording(path);
  if (!source) return EXIT_FAILURE;
  const auto index = ground::McapIndex::open(*source.value());
  const auto word = index ? index.value().metadata("gyre_recording") : std::nullopt;
  if (!word) {
    std::ostringstream said;
    said << std::ifstream(folder.path() + "/recorder.txt").rdbuf();
    std::fprintf(stderr, "no recording was made:\n%s", said.str().c_str());
    return EXIT_FAILURE;
  }
  const ground::Statistics& all = *index.value().statistics();
  const double duration_s = static_cast<double>(all.end_ns - all.start_ns) * 1e-9;
  const auto [bytes, packing_s] = packing_cost(*source.value(), index.value());
  std::printf("%u carriers at 100 Hz, %.0f s: %llu messages, %.0f a second, %.2f MB/s, %.2f MB/s in the file\n",
              kCarriers, duration_s, static_cast<unsigned long long>(all.messages),
              static_cast<double>(all.messages) / duration_s, bytes * 1e-6 / duration_s,
              static_cast<double>(source.value()->size()) * 1e-6 / duration_s);
  std::printf("lost on the wire %s, of those for a slow disk %s; not written %s\n", word->entries.at("lost").c_str(),
              word->entries.at("lost_because_the_disk_was_slow").c_str(), word->entries.at("not_written").c_str());
  std::printf("recorder  %.3f of a core\n", recorder_cost);
  std::printf("floor     %.3f of a core: the same readers, and nothing done\n", floor_cost);
  std::printf("packing   %.3f of a core: zstd alone on the same bytes\n", packing_s / duration_s);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "listen") return listen(std::atoi(argv[2]));
  return measure();
}
