#include "ground/recording/record.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "common/base/interrupts.hpp"
#include "common/base/log.hpp"
#include "common/dds/clock.hpp"
#include "common/program/mission_argument.hpp"
#include "common/program/program.hpp"
#include "ground/recording/recorder.hpp"

namespace gyre::ground {
namespace {

constexpr Duration kBeat = std::chrono::milliseconds(50);

struct RecordOptions {
  std::optional<std::string> output;
  std::optional<double> duration_s;
  std::optional<std::string> mission;
  bool force = false;
  bool without_journals = false;
  program::Options common;
};

RecordingBegin begin_now() {
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  const auto wall_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count();
  return {static_cast<std::uint64_t>(wall_ns), dds::now()};
}

/// UTC, as `strftime` words it.
std::string utc(std::uint64_t wall_ns, const char* format) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  const auto seconds_since_1970 = static_cast<std::time_t>(wall_ns / kSecond);
  std::tm parts{};
  ::gmtime_r(&seconds_since_1970, &parts);
  std::array<char, 32> words{};
  return {words.data(), std::strftime(words.data(), words.size(), format, &parts)};
}

class Attendance {
 public:
  Attendance(dds::Node& node, Recorder& recorder, bool journals)
      : node_(node), record_([&recorder](dds::RecordedSample sample) { recorder.push(std::move(sample)); }) {
    node_.record(record_, std::nullopt, journals);
  }
  /// Listens to those that it does not listen to yet.
  void attend(const std::set<CarrierId>& carriers) {
    for (const CarrierId carrier : carriers) {
      if (carrier >= 1 && carrier <= kMaxCarrierId && attended_.insert(carrier).second) node_.record(record_, carrier);
    }
  }

 private:
  dds::Node& node_;
  std::function<void(dds::RecordedSample)> record_;
  std::set<CarrierId> attended_;
};

int record(const RecordOptions& options) {
  block_interrupts();
  // A file that may not grow is an error of writing, to be told like a full disk; its signal would end the process.
  std::signal(SIGXFSZ, SIG_IGN);
  if (const auto answer = program::start("gyre record", options.common)) return *answer;
  std::optional<mission::Mission> mission;
  std::set<CarrierId> carriers;
  if (options.mission) {
    auto read = program::read_mission(*options.mission);
    if (!read) return read.error();
    mission = std::move(read).value();
    for (const mechanics::Carrier& carrier : mission->plan.carriers) carriers.insert(carrier.id);
  }
  auto opened = program::open_node(options.common.network, {});
  if (!opened) return opened.error();
  std::unique_ptr<dds::Node> node = std::move(opened).value();
  const RecordingBegin begin = begin_now();
  const std::string path = options.output.value_or(utc(begin.wall_ns, "gyre-%Y%m%d-%H%M%S.mcap"));
  using Existing = RecordingFile::Existing;
  auto file = RecordingFile::create(path, options.force ? Existing::kReplace : Existing::kRefuse);
  if (!file) {
    log_error(file.error().text);
    return program::kBadUsage;
  }
  const FilePlace place(path);
  // Handlers push until the node is gone, which is before the recording is finished.
  Recorder recorder(std::move(file).value(), begin,
                    {{"domain", std::to_string(node->domain())}, {"begin", utc(begin.wall_ns, "%Y-%m-%dT%H:%M:%SZ")}},
                    std::move(mission));
  Attendance attendance(*node, recorder, !options.without_journals);
  attendance.attend(carriers);
  log_info("recording to " + path);

  const LocalTime end = options.duration_s ? begin.local + from_seconds(*options.duration_s) : LocalTime::max();
  std::optional<std::string> loss;
  while (take_interrupts().total() == 0 && dds::now() < end) {
    attendance.attend(recorder.carriers());
    if (!loss && (loss = place.loss())) log_warning(*loss);
    std::this_thread::sleep_for(kBeat);
  }
  node.reset();
  const Recorder::End told = recorder.finish();
  std::printf("%s", told.table.c_str());
  const bool good = told.complete && !place.loss();
  log(good ? Notice::Level::kInfo : Notice::Level::kWarning, path + ": " + told.line);
  if (const auto lost = place.loss(); lost && lost != loss) log_warning(*lost);
  return good ? program::kGood : program::kFailed;
}

}  // namespace

program::Command record_command() {
  const auto options = std::make_shared<RecordOptions>();
  return {
      "record", "Record everything that a swarm says: an MCAP file for Foxglove, PlotJuggler and ROS 2's tools.",
      program::with_common(
          {{"-o,--output", &options->output, "the file (else gyre-YYYYMMDD-HHMMSS.mcap, in UTC, here)"},
           {"--duration", &options->duration_s, "seconds to record (else until ctrl-c)", program::Bounds{0.001, 1e9}},
           {"--mission", &options->mission,
            "the mission that will be flown: its carriers are heard from the first word on"},
           {"--without-journals", &options->without_journals,
            "leave out what processes were told, nearly half of all: for thin links; gyre replay cannot step them "
            "then"},
           {"--force", &options->force, "replace a file of this name"}},
          options->common),
      [options] { return record(*options); }};
}

}  // namespace gyre::ground
