#include "ground/page/core/hurt_gauge.hpp"

#include <algorithm>

namespace gyre::ground {

void HurtGauge::hurt(LocalTime now, const std::string& text) {
  HurtOutcome next;
  next.number = outcome_ ? outcome_->number + 1 : 1;
  next.text = text;
  for (const Moment& moment : lately_) next.before_m = std::max(next.before_m, moment.displacement_m);
  outcome_ = next;
  begun_ = now;
}

void HurtGauge::see(LocalTime now, const LoadWindow& load, bool calm) {
  lately_.push_back({now, load.displacement_max_m});
  while (now - lately_.front().at > kBefore) lately_.pop_front();
  if (!outcome_) return;
  outcome_->moved_max_m = std::max(outcome_->moved_max_m, load.displacement_max_m);
  const Duration since = now - begun_;
  if (!calm) {
    outcome_->calm_after.reset();
  } else if (!outcome_->calm_after && since >= kSettling) {
    outcome_->calm_after = since;
  }
}

std::optional<HurtOutcome> HurtGauge::outcome(LocalTime now) const {
  if (!outcome_) return std::nullopt;
  HurtOutcome outcome = *outcome_;
  outcome.since = now - begun_;
  return outcome;
}

}  // namespace gyre::ground
