#include "ground/report/core/time_axis.hpp"

#include <algorithm>

namespace gyre::ground {
namespace {

/// Clocks drift by some hundred ppm, and a beacon may be late by a tenth of a second; nothing gains so much between
/// two.
constexpr Duration kLeap = std::chrono::seconds(1);

}  // namespace

void TimeAxis::begin(LocalTime log) {
  if (!first_) first_ = log;
}

void TimeAxis::see(LocalTime log, SwarmTime swarm) {
  begin(log);
  const Duration ahead = swarm.time_since_epoch() - log.time_since_epoch();
  if (swarm_ahead_) {
    const Duration gain = ahead - *swarm_ahead_;
    if (gain > kLeap || gain < -kLeap) {
      ++leaps_;
    } else {
      gained_ += gain;
    }
  }
  swarm_ahead_ = ahead;
}

double TimeAxis::at(LocalTime log) {
  begin(log);
  last_s_ = std::max(last_s_, seconds(log - *first_ + gained_));
  return last_s_;
}

}  // namespace gyre::ground
