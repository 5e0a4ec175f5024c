// What a recorder costs beside 48 carriers at 100 Hz, and whether it loses anything.
//
// The swarm is spoken_swarm's. The floor beside the recorder has the same readers as it. What is left is decoded for
// the scene, packed and written; of that, packing alone is measured again afterwards.
//
//   bench_recording             the table
//   bench_recording listen D    the floor, on domain D

#include <zstd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
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
#include "tests/bench/spoken_swarm.hpp"
#include "tests/places.hpp"

namespace {

using namespace gyre;
using bench::cpu_s;
using ground::ChildProcess;
using namespace std::chrono_literals;

constexpr double kSettle_s = 6.0;
constexpr double kMeasure_s = 20.0;

int listen(int domain) {
  const auto node = std::move(dds::Node::open({{}, domain, "127.0.0.1", {}})).value();
  const auto forget = [](const dds::RecordedSample&) {};
  node->record(forget);
  for (CarrierId id = 1; id <= bench::kSpokenCarriers; ++id) node->record(forget, id);
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
  const int domain = bench::free_domain();
  const auto folder = std::move(ground::FlightDirectory::make(std::nullopt)).value();
  const std::string path = folder.path() + "/recording.mcap";
  bench::SpokenSwarm swarm(domain);
  auto floor = std::move(ChildProcess::start({bench::own_program(), "listen", std::to_string(domain)},
                                             folder.path() + "/floor.txt"))
                   .value();
  auto recorder = std::move(ChildProcess::start({gyre::test::program_directory() + "/gyre", "record", "-o", path,
                                                 "--domain", std::to_string(domain)},
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
              bench::kSpokenCarriers, duration_s, static_cast<unsigned long long>(all.messages),
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
