#include "simulator/core/age_judge.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "simulator/core/extrapolation.hpp"

namespace gyre::simulator {

Duration AgeJudge::age(SwarmTime stamp, LocalTime arrived) {
  const Duration delay = arrived.time_since_epoch() - stamp.time_since_epoch();
  while (!heard_.empty() && arrived - heard_.front().arrived >= kAgeWindow) heard_.pop_front();
  heard_.push_back({arrived, delay});

  std::array<Duration, kLying + 1> least{};  // in order
  least.fill(Duration::max());
  for (const Heard& heard : heard_) {
    Duration greater = heard.delay;
    for (Duration& kept : least) std::tie(kept, greater) = std::minmax({kept, greater});
  }
  const Duration usual = least[std::min(heard_.size() - 1, kLying)];
  return std::clamp(delay - usual, Duration{}, from_seconds(kExtrapolationHorizon_s));
}

}  // namespace gyre::simulator
