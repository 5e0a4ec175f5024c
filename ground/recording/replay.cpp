#include "ground/recording/replay.hpp"

#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "common/base/interrupts.hpp"
#include "common/base/text.hpp"
#include "common/dds/clock.hpp"
#include "common/program/program.hpp"
#include "ground/page/page.hpp"
#include "ground/recording/recording_file.hpp"
#include "ground/recording/swarm_stream.hpp"

namespace gyre::ground {
namespace {

struct ReplayOptions {
  std::string file;
  double from_s = 0.0;
  double speed = 1.0;
  bool page = false;
  PageOptions page_options;
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
void play(SwarmStream& swarm, const Heard& first, const ReplayOptions& options, SwarmView& view, Page& page) {
  const Schedule schedule(first.arrived, options);
  std::optional<Heard> next = first;
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

int replay(const ReplayOptions& options) {
  const auto say = [](int code, const std::string& words) {
    std::fprintf(stderr, "%s\n", words.c_str());
    return code;
  };
  if (!options.page) return say(program::kBadUsage, "say how to replay it: --page shows it in a browser");
  block_interrupts();
  const auto source = open_recording(options.file);
  if (!source) return say(program::kBadUsage, source.error().text);
  auto opened = SwarmStream::open(*source.value());
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

}  // namespace

program::Command replay_command() {
  const auto options = std::make_shared<ReplayOptions>();
  return {
      "replay",
      "Show a recording as if it were flown now.",
      {program::own({{"FILE", &options->file, "what gyre record wrote", {}, program::Take::kRequired},
                     {"--page", &options->page, "at a page, in a browser"},
                     {"--from", &options->from_s, "seconds of the recording to pass over", program::Bounds{0.0, 1e9}},
                     {"--speed", &options->speed, "how fast: 1 as it was", program::Bounds{0.01, 100.0}}}),
       {"The page", page_options(options->page_options)}},
      [options] { return replay(*options); }};
}

}  // namespace gyre::ground
