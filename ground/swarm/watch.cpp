#include "ground/swarm/watch.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "common/base/interrupts.hpp"
#include "common/base/log.hpp"
#include "common/dds/health_reporter.hpp"
#include "common/program/mission_argument.hpp"
#include "common/program/program.hpp"
#include "ground/swarm/account_text.hpp"
#include "ground/swarm/core/swarm_watch.hpp"
#include "ground/swarm/ground_seat.hpp"
#include "ground/swarm/listening.hpp"

namespace gyre::ground {
namespace {

constexpr Duration kBeat = std::chrono::milliseconds(100);

struct WatchOptions {
  std::string mission;
  std::optional<double> period_s;
  bool json = false;
  program::Options common;
};

/// What is worth a line of its own when it changes; the figures are not.
struct Headline {
  bool calm = false;
  std::string course;
  std::vector<CarrierId> silent;

  explicit Headline(const Account& account)
      : calm(account.calm()), course(account.course.substr(0, account.course.find(" ("))), silent(account.silent) {}
  [[nodiscard]] bool operator!=(const Headline& other) const {
    return calm != other.calm || course != other.course || silent != other.silent;
  }
};

/// One window out of two that follow each other: its peaks, whatever was wrong in it, and the state at its end.
void merge(Account& account, const Account& next) {
  const LoadWindow before = account.load;
  const std::string complaint = account.complaint;
  const std::map<std::string, Duration> late_max = std::move(account.late_max);
  account = next;
  for (const auto& [process, late] : late_max) account.late_max[process] = std::max(account.late_max[process], late);
  if (!complaint.empty()) account.complaint = complaint;
  account.load = before;
  account.load.include(next.load);
}

int watch(const WatchOptions& options) {
  block_interrupts();
  if (const auto answer = program::start("gyre watch", options.common)) return *answer;
  const auto mission = program::read_mission(options.mission);
  if (!mission) return mission.error();
  const auto opened = program::open_node(options.common.network, ground_seat(options.common.network));
  if (!opened) return opened.error();
  dds::Node& node = *opened.value();
  dds::HealthReporter health(node, "ground");
  Listening listening(node, Interest::kSwarm);

  const Duration period = from_seconds(options.period_s.value_or(options.json ? 1.0 : 10.0));
  SwarmWatch swarm(mission.value(), dds::now());
  std::optional<Headline> told;
  Account pending;
  LocalTime next_beat = dds::now();
  LocalTime next_line = next_beat + period;
  while (take_interrupts().total() == 0) {
    next_beat += kBeat;
    if (next_beat < dds::now()) next_beat = dds::now() + kBeat;  // a stall is not made up for
    for (const Heard& heard : listening.sleep_until(next_beat)) {
      swarm.see(heard.arrived, heard.message);
    }
    const LocalTime now = dds::now();
    health.step(now, swarm.out_of_contact(now), {}, listening.dropped(), listening.late());
    merge(pending, swarm.account(now));
    const Headline headline(pending);
    const bool news = !options.json && (!told || headline != *told);
    if (!news && now < next_line) continue;
    next_line = news ? now + period : next_line + period;
    told = headline;
    if (options.json) {
      // A reader that left is no reason to stop a watch that others may ask for its health.
      std::printf("%s\n", account_json(pending).c_str());
      std::fflush(stdout);
    } else {
      log(pending.calm() ? Notice::Level::kInfo : Notice::Level::kWarning, account_line(pending));
    }
    pending = {};
  }
  return program::kGood;
}

}  // namespace

program::Command watch_command() {
  const auto options = std::make_shared<WatchOptions>();
  return {"watch", "Watch a swarm that flies: is it calm, and how far did the load move?",
          program::with_common({program::mission_argument(options->mission),
                                {"--period", &options->period_s, "seconds between lines (else 10, with --json 1)",
                                 program::Bounds{0.1, 3600.0}},
                                {"--json", &options->json, "one JSON object per period, for programs"}},
                               options->common),
          [options] { return watch(*options); }};
}

}  // namespace gyre::ground
