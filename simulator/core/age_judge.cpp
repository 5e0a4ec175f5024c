#include "simulator/core/age_judge.hpp"

#include <algorithm>

#include "simulator/core/extrapolation.hpp"

namespace gyre::simulator {

Duration AgeJudge::age(SwarmTime stamp, LocalTime arrived) {
  const Duration delay = arrived.time_since_epoch() - stamp.time_since_epoch();
  while (!heard_.empty() && arrived - heard_.front().arrived >= kAgeWindow) heard_.pop_front();
  heard_.push_back({arrived, delay});

  Duration least = Duration::max();
  Duration second_least = Duration::max();
  for (const Heard& heard : heard_) {
    second_least = std::min(second_least, std::max(least, heard.delay));
    least = std::min(least, heard.delay);
  }
  if (heard_.size() == 1) return Duration{};  // nothing to compare with
  return std::clamp(delay - second_least, Duration{}, from_seconds(kExtrapolationHorizon_s));
}

}  // namespace gyre::simulator
