#include "common/protocol/timekeeper.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/ensure.hpp"

namespace gyre::protocol {
namespace {

double nanoseconds(Duration d) {
  return static_cast<double>(d.count());
}
Duration rounded(double ns) {
  return Duration(std::llround(ns));
}

}  // namespace

Duration Timekeeper::least_delay() const {
  const std::size_t count = std::min(delay_count_, delays_.size());
  return count == 0 ? Duration::zero() : *std::min_element(delays_.begin(), delays_.begin() + count);
}

Timekeeper::Verdict Timekeeper::observe(const Exchange& e) {
  const Duration away = e.reply_received - e.request_sent;
  const Duration inside = e.reply_sent - e.request_received;
  const Duration delay = away - inside;
  if (inside < Duration::zero() || delay < Duration::zero() || away > options_.delay_max) return Verdict::kNonsense;
  if (running_ && e.reply_received < filtered_at_) return Verdict::kNonsense;

  // offset = ((T2 − T1) + (T3 − T4)) / 2, halves taken before they can overflow
  const Duration there = e.request_received.time_since_epoch() - e.request_sent.time_since_epoch();
  const Duration back = e.reply_sent.time_since_epoch() - e.reply_received.time_since_epoch();
  const Duration offset = back + (there - back) / 2;
  if (!running_) origin_ = offset;
  const double measured_ns = nanoseconds(offset - origin_);

  delays_[delay_count_++ % delays_.size()] = delay;
  // The excess over the least delay is time spent on one of the two ways, nobody knows which.
  const double sigma_ns = nanoseconds(options_.noise) + 0.5 * nanoseconds(delay - least_delay());

  if (!running_) {
    start(e.reply_received, measured_ns, 0.5 * nanoseconds(delay) + sigma_ns);
    anchor_local_ = e.reply_received;
    anchor_swarm_ = SwarmTime(e.reply_received.time_since_epoch() + offset);
    running_ = true;
    taken_ = 1;
    return Verdict::kTaken;
  }

  predict(e.reply_received);
  auto& p = covariance_;
  const double innovation_ns = measured_ns - offset_ns_;
  const double variance = p[0][0] + sigma_ns * sigma_ns;
  // The true offset lies within half the delay of the measured one, whatever the network did: more is a contradiction.
  if (std::abs(innovation_ns) > 5.0 * std::sqrt(variance) + 0.5 * nanoseconds(delay)) {
    const bool agree = contradictions_ > 0 && std::abs(measured_ns - contradiction_ns_) < nanoseconds(delay) + 5e6;
    contradictions_ = agree ? contradictions_ + 1 : 1;
    contradiction_ns_ = measured_ns;
    if (contradictions_ < options_.contradictions_to_restart) return Verdict::kContradiction;
    start(e.reply_received, measured_ns, 0.5 * nanoseconds(delay) + sigma_ns);
  } else {
    const double gain_offset = p[0][0] / variance;
    const double gain_drift = p[1][0] / variance;
    offset_ns_ += gain_offset * innovation_ns;
    drift_ = std::clamp(drift_ + gain_drift * innovation_ns, -options_.drift_max, options_.drift_max);
    p[1][1] -= gain_drift * p[0][1];
    p[0][1] -= gain_offset * p[0][1];
    p[1][0] = p[0][1];
    p[0][0] -= gain_offset * p[0][0];
    contradictions_ = 0;
  }
  ++taken_;
  steer(e.reply_received);
  return Verdict::kTaken;
}

void Timekeeper::doubt(Duration error) {
  covariance_[0][0] += nanoseconds(error) * nanoseconds(error);
}

void Timekeeper::start(LocalTime local, double offset_ns, double sigma_ns) {
  filtered_at_ = local;
  offset_ns_ = offset_ns;
  drift_ = 0.0;
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
  const SwarmTime shown = at(local);
  const double target_ns = nanoseconds(local.time_since_epoch() + origin_ - shown.time_since_epoch()) + offset_ns_;
  anchor_local_ = local;
  anchor_swarm_ = shown;
  if (!synchronised()) {  // nobody flies by it yet: take the estimate as it is, but never backwards
    anchor_swarm_ += rounded(std::max(0.0, target_ns));
  }
  const double left_ns = target_ns - nanoseconds(anchor_swarm_ - shown);
  rate_ = drift_ + std::clamp(left_ns / nanoseconds(options_.slew_time), -options_.slew_max, options_.slew_max);
}

SwarmTime Timekeeper::at(LocalTime local) const {
  GYRE_ENSURE(running_, "swarm time is asked for before any exchange");
  // An error is walked off over slew_time; after that the clock runs on at the filtered drift.
  const Duration elapsed = std::max(Duration::zero(), local - anchor_local_);
  const Duration slewing = std::min(elapsed, options_.slew_time);
  return anchor_swarm_ + elapsed + rounded(rate_ * nanoseconds(slewing) + drift_ * nanoseconds(elapsed - slewing));
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
  return rounded(3.0 * std::sqrt(variance) + 0.5 * nanoseconds(least_delay()) + std::abs(estimate_ns - shown_ns));
}

}  // namespace gyre::protocol
