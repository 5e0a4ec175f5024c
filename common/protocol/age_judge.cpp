#include "common/protocol/age_judge.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace gyre::protocol {
namespace {

constexpr std::size_t kMost = 256;  // a window of the fastest senders has no more: what a flood costs is bounded

}  // namespace

Duration AgeJudge::age(Duration stamp, LocalTime arrived) {
  const Duration usual = usual_delay(stamp, arrived);
  return std::max(arrived.time_since_epoch() - stamp - usual, Duration{});
}

Duration AgeJudge::usual_delay(Duration stamp, LocalTime arrived) {
  const Duration delay = arrived.time_since_epoch() - stamp;
  while (!heard_.empty() && (arrived - heard_.front().arrived >= kAgeWindow || heard_.size() == kMost)) {
    heard_.pop_front();
  }
  heard_.push_back({arrived, delay});
  return usual_delay();
}

std::optional<Duration> AgeJudge::age_by_the_past(Duration stamp, LocalTime arrived) const {
  if (heard_.empty()) return std::nullopt;
  return arrived.time_since_epoch() - stamp - usual_delay();
}

void AgeJudge::keep(LocalTime now) {
  if (heard_.empty()) return;
  const Duration gap = now - heard_.back().arrived;
  for (Heard& heard : heard_) heard.arrived += gap;
}

Duration AgeJudge::usual_delay() const {
  std::array<Duration, kLying + 1> least{};  // in order
  least.fill(Duration::max());
  for (const Heard& heard : heard_) {
    Duration greater = heard.delay;
    for (Duration& kept : least) std::tie(kept, greater) = std::minmax({kept, greater});
  }
  return least[std::min(heard_.size() - 1, kLying)];
}

}  // namespace gyre::protocol
