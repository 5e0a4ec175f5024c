#include "common/protocol/timekeeper.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/ensure.hpp"

namespace gyre::protocol {
namespace {

double nanoseconds(Duration d) {
  return static_cast<double>(d.count());
}
Duration rounded(double ns) {
  const double longest = nanoseconds(kLongest);
  return Duration(std::llround(std::clamp(ns, -longest, longest)));
}

/// Contradictions that are no further apart than this tell of the same other clock.
constexpr double kAgreement_ns = 5e6;
/// How lucky the least of a few delays is allowed to have been.
constexpr double kLuck = 3.0;

}  // namespace

double Timekeeper::excess_ns(double delay_ns) const {
  const std::size_t count = std::min(delay_count_, delays_.size());
  if (count == 0) return delay_ns;
  const auto end = delays_.begin() + static_cast<std::ptrdiff_t>(count);
  const double least_ns = *std::min_element(delays_.begin(), end);
  const double mean_ns = std::accumulate(delays_.begin(), end, 0.0) / static_cast<double>(count);
  // The least of few delays says little: of k that are random it is still about mean / k above the best there can be.
  return std::max(0.0, delay_ns - least_ns) + kLuck * std::max(mean_ns, delay_ns) / static_cast<double>(count);
}

Timekeeper::Verdict Timekeeper::observe(const Exchange& e, LocalTime now) {
  GYRE_ENSURE(now >= e.reply_received, "a reply is told of after it was received");
  if (!usable(e.request_sent) || !usable(e.request_received) || !usable(e.reply_sent) || !usable(e.reply_received)) {
    return Verdict::kNonsense;
  }
  const Duration away = e.reply_received - e.request_sent;
  const Duration inside = e.reply_sent - e.request_received;
  const Duration delay = away - inside;
  if (inside < Duration::zero() || delay < Duration::zero() || away > options_.delay_max) return Verdict::kNonsense;
  if (running_ && e.reply_received < filtered_at_) return Verdict::kNonsense;

  // offset = ((T2 − T1) + (T3 − T4)) / 2 = T3 − T4 + delay / 2, which cannot overflow
  const Duration offset = e.reply_sent.time_since_epoch() - e.reply_received.time_since_epoch() + delay / 2;
  if (!running_) {
    running_ = true;
    origin_ = offset;
    start(e.reply_received, 0.0, nanoseconds(delay));
  } else if (!follow(e.reply_received, nanoseconds(offset - origin_), nanoseconds(delay))) {
    return Verdict::kContradiction;
  }
  delays_[delay_count_++ % delays_.size()] = nanoseconds(delay);
  steer(now);
  ++taken_;
  return Verdict::kTaken;
}

bool Timekeeper::follow(LocalTime local, double measured_ns, double delay_ns) {
  predict(local);
  // The excess over the least delay is time spent on one of the two ways, nobody knows which.
  const double sigma_ns = nanoseconds(options_.noise) + 0.5 * excess_ns(delay_ns);
  auto& p = covariance_;
  const double innovation_ns = measured_ns - offset_ns_;
  const double variance = p[0][0] + sigma_ns * sigma_ns;
  // Both offsets may be off by half a delay, whatever the network did: more is a contradiction.
  if (std::abs(innovation_ns) > 5.0 * std::sqrt(variance) + 0.5 * delay_ns + asymmetry_ns_) {
    const bool agree = contradictions_ > 0 && std::abs(measured_ns - contradiction_ns_) < delay_ns + kAgreement_ns;
    contradictions_ = agree ? contradictions_ + 1 : 1;
    contradiction_ns_ = measured_ns;
    if (contradictions_ < options_.contradictions_to_restart) return false;
    start(local, measured_ns, delay_ns);
    return true;
  }
  const double gain_offset = p[0][0] / variance;
  const double gain_drift = p[1][0] / variance;
  offset_ns_ += gain_offset * innovation_ns;
  drift_ = std::clamp(drift_ + gain_drift * innovation_ns, -options_.drift_max, options_.drift_max);
  asymmetry_ns_ += gain_offset * (0.5 * delay_ns - asymmetry_ns_);
  p[1][1] -= gain_drift * p[0][1];
  p[0][1] -= gain_offset * p[0][1];
  p[1][0] = p[0][1];
  p[0][0] -= gain_offset * p[0][0];
  contradictions_ = 0;
  return true;
}

void Timekeeper::doubt(Duration error) {
  covariance_[0][0] += nanoseconds(error) * nanoseconds(error);
  // Another coordinator may run on another machine, whose quartz drifts otherwise.
  const double drift_sigma = options_.drift_max / 3.0;
  covariance_[1][1] += drift_sigma * drift_sigma;
}

void Timekeeper::start(LocalTime local, double offset_ns, double delay_ns) {
  filtered_at_ = local;
  offset_ns_ = offset_ns;
  drift_ = 0.0;
  asymmetry_ns_ = 0.5 * delay_ns;
  // All of its delay may be excess: what was learned of delays before a restart may have been a lie.
  const double sigma_ns = nanoseconds(options_.noise) + 0.5 * delay_ns;
  const double drift_sigma = options_.drift_max / 3.0;
  covariance_ = {{{sigma_ns * sigma_ns, 0.0}, {0.0, drift_sigma * drift_sigma}}};
  contradictions_ = 0;
}

void Timekeeper::predict(LocalTime local) {
  const double dt = nanoseconds(local - filtered_at_);
  const double dt_s = 1e-9 * dt;
  auto& p = covariance_;
  const double wander = options_.drift_wander_per_sqrt_s * options_.drift_wander_per_sqrt_s * dt_s;
  offset_ns_ += drift_ * dt;
  p[0][0] += 2.0 * dt * p[0][1] + dt * dt * (p[1][1] + wander / 3.0);
  p[0][1] += dt * (p[1][1] + wander / 2.0);
  p[1][0] = p[0][1];
  p[1][1] += wander;
  filtered_at_ = local;
}

void Timekeeper::steer(LocalTime local) {
  const double ahead_ns = nanoseconds(local - filtered_at_);
  const SwarmTime target(local.time_since_epoch() + origin_ + rounded(offset_ns_ + drift_ * ahead_ns));
  // Until there is enough to fly by nobody does, and the estimate is taken as it is.
  const SwarmTime shown = synchronised() ? at(local) : target;
  anchor_local_ = local;
  anchor_swarm_ = shown;
  const double pace = nanoseconds(target - shown) / nanoseconds(options_.slew_time);
  steady_rate_ = drift_;
  slewing_rate_ = drift_ + std::clamp(pace, -options_.slew_max, options_.slew_max);
}

SwarmTime Timekeeper::at(LocalTime local) const {
  GYRE_ENSURE(running_, "swarm time is asked for before any exchange");
  // An error is walked off over slew_time; after that the clock runs on at the drift known then.
  const Duration elapsed = std::max(Duration::zero(), local - anchor_local_);
  const Duration slewing = std::min(elapsed, options_.slew_time);
  return anchor_swarm_ + elapsed +
         rounded(slewing_rate_ * nanoseconds(slewing) + steady_rate_ * nanoseconds(elapsed - slewing));
}

Duration Timekeeper::uncertainty(LocalTime local) const {
  if (!running_) return Duration::max();
  const double dt = nanoseconds(std::max(Duration::zero(), local - filtered_at_));
  const double dt_s = 1e-9 * dt;
  const auto& p = covariance_;
  const double wander = options_.drift_wander_per_sqrt_s * options_.drift_wander_per_sqrt_s * dt_s;
  const double variance = p[0][0] + 2.0 * dt * p[0][1] + dt * dt * (p[1][1] + wander / 3.0);
  const double estimate_ns = offset_ns_ + drift_ * dt;
  const double shown_ns = nanoseconds(at(local).time_since_epoch() - local.time_since_epoch() - origin_);
  return rounded(3.0 * std::sqrt(variance) + asymmetry_ns_ + std::abs(estimate_ns - shown_ns));
}

}  // namespace gyre::protocol
