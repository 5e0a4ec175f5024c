#include "ground/replay/replay.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "common/base/interrupts.hpp"
#include "common/base/text.hpp"
#include "common/base/version.hpp"
#include "common/dds/clock.hpp"
#include "common/program/program.hpp"
#include "ground/page/page.hpp"
#include "ground/recording/message_stream.hpp"
#include "ground/recording/recording_file.hpp"
#include "ground/replay/core_replay.hpp"

namespace gyre::ground {
namespace {

struct ReplayOptions {
  std::string file;
  double from_s = 0.0;
  double speed = 1.0;
  bool page = false;
  PageOptions page_options;
  std::optional<int> agent;
  bool coordinator = false;
};

/// When what was heard then is heard again.
class Schedule {
 public:
  Schedule(LocalTime recorded_begin, const ReplayOptions& options)
      : recorded_(recorded_begin + from_seconds(options.from_s)), speed_(options.speed), begin_(dds::now()) {}

  [[nodiscard]] bool due(LocalTime recorded, LocalTime now) const {
    return seconds(recorded - recorded_) <= speed_ * seconds(now - begin_);
  }

 private:
  LocalTime recorded_;
  double speed_;
  LocalTime begin_;
};

/// What the person is told when nothing comes any more.
std::string last_words(const SwarmStream& swarm) {
  std::string words = swarm.file().whole() ? "the end of the recording" : "the recording was cut off here";
  if (swarm.undecodable() > 0) {
    words += text("; %llu messages in it are of another version", static_cast<unsigned long long>(swarm.undecodable()));
  }
  return words;
}

/// Until somebody ends it, beyond the recording's end, too: the last picture stays.
void play(SwarmStream& swarm, const SwarmStream::Item& first, const ReplayOptions& options, SwarmView& view,
          Page& page) {
  const Schedule schedule(first.arrived, options);
  std::optional<SwarmStream::Item> next = first;
  bool over = false;
  while (take_interrupts().total() == 0) {
    const LocalTime now = dds::now();
    while (next && schedule.due(next->arrived, now)) {
      if (view.step(now, next->message)) page.hear(now, next->message);
      next = swarm.next();
    }
    if (!next && !over) {
      over = true;
      page.feed().tell(now, Notice::Level::kInfo, "gyre replay", last_words(swarm));
      std::printf("%s\n", last_words(swarm).c_str());
      std::fflush(stdout);
    }
    page.step(now);
    std::this_thread::sleep_for(PageFeed::kFrame / 4);
  }
}

int say(int code, const std::string& words) {
  std::fprintf(stderr, "%s\n", words.c_str());
  return code;
}

int show(const McapSource& source, const ReplayOptions& options) {
  auto opened = SwarmStream::open(source);
  if (!opened) return say(program::kBadUsage, options.file + ": " + opened.error().text);
  SwarmStream swarm = std::move(opened).value();
  const auto first = swarm.next();
  if (!first) return say(program::kBadUsage, options.file + ": nothing of a swarm is recorded in it");

  SwarmView view;
  PageOwner owner;
  owner.takes_orders = false;
  const auto page = Page::open(options.page_options, owner, nullptr, view);
  if (!page) return say(program::kFailed, page.error().text);
  std::printf("The page of %s: %s\n", options.file.c_str(), page.value()->url().c_str());
  std::fflush(stdout);
  play(swarm, *first, options, view, *page.value());
  return program::kGood;
}

int step_again(const McapSource& source, const ReplayOptions& options) {
  std::optional<CarrierId> carrier;
  if (options.agent) carrier = static_cast<CarrierId>(*options.agent);
  const auto lives = replay_core(source, carrier);
  if (!lives) return say(program::kBadUsage, options.file + ": " + lives.error().text);
  bool same = true;
  for (const Replayed& life : lives.value()) {
    std::printf("%s%s", &life == &lives.value().front() ? "" : "\n", replay_text(life, version()).c_str());
    same = same && life.same();
  }
  return same ? program::kGood : program::kFailed;
}

int replay(const ReplayOptions& options) {
  const int ways = static_cast<int>(options.page) + static_cast<int>(options.agent.has_value()) +
                   static_cast<int>(options.coordinator);
  if (ways != 1) {
    return say(program::kBadUsage,
               "say how to replay it: --page shows it in a browser, --agent N or --coordinator steps that one again "
               "through what it was told");
  }
  if (options.page) block_interrupts();
  const auto source = open_recording(options.file);
  if (!source) return say(program::kBadUsage, source.error().text);
  return options.page ? show(*source.value(), options) : step_again(*source.value(), options);
}

}  // namespace

program::Command replay_command() {
  const auto options = std::make_shared<ReplayOptions>();
  return {
      "replay",
      "Show a recording as if it were flown now, or let a process decide again what it decided then.",
      {program::own({{"FILE", &options->file, "what gyre record wrote", {}, program::Take::kRequired},
                     {"--page", &options->page, "at a page, in a browser"},
                     {"--agent", &options->agent,
                      "step the agent of this carrier through what it was told, and say where it decides otherwise",
                      program::Bounds{1, kMaxCarrierId}},
                     {"--coordinator", &options->coordinator, "the same with the coordinator"},
                     {"--from", &options->from_s, "seconds of the recording to pass over", program::Bounds{0.0, 1e9}},
                     {"--speed", &options->speed, "how fast: 1 as it was", program::Bounds{0.01, 100.0}}}),
       {"The page", page_options(options->page_options)}},
      [options] { return replay(*options); }};
}

}  // namespace gyre::ground
