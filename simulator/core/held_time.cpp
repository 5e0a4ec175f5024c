#include "simulator/core/held_time.hpp"

#include <algorithm>

namespace gyre::simulator {

LocalTime HeldTime::of(Duration stamp, LocalTime arrived, Duration oldest) {
  const Duration usual = ages_.usual_delay(stamp, arrived);
  if (!base_ || std::chrono::abs(usual - base_->behind) >= kLeap) base_ = Base{arrived, arrived, usual};
  Base& base = *base_;
  const Duration known = arrived - base.begun - protocol::kAgeWindow;
  if (known <= Duration{}) {
    base.behind = usual;
  } else {
    const double off_s = seconds(usual - base.behind);
    const double ratio = off_s / seconds(kNear);
    const double share = seconds(arrived - base.last) / seconds(std::min(known, kSteady)) * (1.0 + ratio * ratio);
    base.behind += from_seconds(std::min(share, 1.0) * off_s);
  }
  base.last = arrived;
  const LocalTime held = LocalTime(stamp + base.behind);
  return held > arrived + kEarly ? arrived : std::max(held, arrived - oldest);
}

void HeldTime::keep(LocalTime now) {
  ages_.keep(now);
  if (base_) base_->last = std::max(base_->last, now);
}

}  // namespace gyre::simulator
