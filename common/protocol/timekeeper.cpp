#include "common/protocol/timekeeper.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/ensure.hpp"
#include "common/base/text.hpp"

namespace gyre::protocol {
namespace {

double nanoseconds(Duration d) {
  return static_cast<double>(d.count());
}
Duration rounded(double ns) {
  const double longest = nanoseconds(kLongest);
  return Duration(std::llround(std::clamp(ns, -longest, longest)));
}

/// Deviations: what is further off is no accident.
constexpr double kBeyondDoubt = 5.0;
/// Deviation of a drift that nothing is known of.
constexpr double kAnyDrift = 1.0;
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

Timekeeper::Verdict Timekeeper::observe(const Exchange& e, LocalTime now, std::optional<Duration> leap) {
  GYRE_ENSURE(now >= e.reply_received, "a reply is told of after it was received");
  if (!usable(e.request_sent) || !usable(e.request_received) || !usable(e.reply_sent) || !usable(e.reply_received)) {
    return Verdict::kNonsense;
  }
  const Duration away = e.reply_received - e.request_sent;
  const Duration inside = e.reply_sent - e.request_received;
  const Duration delay = e.delay();
  if (inside < Duration::zero() || delay < Duration::zero() || away > options_.delay_max) return Verdict::kNonsense;
  // A copy of an exchange is not a second witness.
  if (running_ && (e.request_sent <= request_sent_ || e.reply_received < filter_.at)) return Verdict::kNonsense;
  request_sent_ = e.request_sent;

  // offset = ((T2 − T1) + (T3 − T4)) / 2 = T3 − T4 + delay / 2, which cannot overflow
  const Duration offset = e.reply_sent.time_since_epoch() - e.reply_received.time_since_epoch() + delay / 2;
  if (!running_) origin_ = offset;
  // The excess over the least delay is time spent on one of the two ways, nobody knows which.
  const double delay_ns = nanoseconds(delay);
  const double sigma_ns = nanoseconds(options_.noise) + 0.5 * excess_ns(delay_ns);
  const Measurement m{e.reply_received, nanoseconds(offset - origin_), delay_ns, sigma_ns};

  const bool was_read = synchronised();
  const std::optional<Filter> leapt = running_ && leap ? after_leap(m, *leap) : std::nullopt;
  bool anew = !running_;
  if (anew) {
    running_ = true;
    filter_ = begin(m);
  } else if (leapt) {
    filter_ = *leapt;
    drop_rival();
  } else if (filter_.follow(m)) {
    // A slow exchange agrees with both, and says nothing of which is right.
    if (rival_ && !rival_->follow(m)) drop_rival();
  } else if (convinces(m)) {
    filter_ = *rival_;
    drop_rival();
    anew = true;
  } else {
    return Verdict::kContradiction;
  }
  if (anew) filter_.expect_drift(options_.drift_max / 3.0);
  delays_[delay_count_++ % delays_.size()] = delay_ns;
  // Until there is enough to fly by nobody does, and the estimate is taken as it is.
  steer(now, anew || leapt || !was_read);
  ++taken_;
  if (leapt && was_read) return Verdict::kLeapt;
  return anew && was_read ? Verdict::kFoundAnew : Verdict::kTaken;
}

std::optional<Timekeeper::Filter> Timekeeper::after_leap(const Measurement& m, Duration leap) const {
  Filter f = filter_;
  f.predict(m.at);
  // A clock that leapt ahead is as much further ahead of the swarm's.
  const double innovation_ns = m.offset_ns - f.offset_ns;
  const double unlike_ns = std::abs(innovation_ns + nanoseconds(leap));
  const double seen_to_ns = std::max(nanoseconds(options_.leap_seen_to), 0.5 * std::abs(nanoseconds(leap)));
  // The asymmetry that may hide in all that is known is no excuse: others have seen that it is the clock.
  if (std::abs(innovation_ns) <= f.bound_ns(m) - f.asymmetry_ns || unlike_ns > seen_to_ns) return std::nullopt;
  f.offset_ns = m.offset_ns;
  f.asymmetry_ns = 0.5 * m.delay_ns;
  f.p00 = m.sigma_ns * m.sigma_ns;
  f.p01 = 0.0;
  return f;
}

bool Timekeeper::convinces(const Measurement& contradiction) {
  if (!rival_ || !rival_->follow(contradiction)) {
    drop_rival();
    rival_ = begin(contradiction);
    contradictions_ = 0;
    contradicted_since_ = contradiction.at;
  }
  ++contradictions_;
  if (contradictions_ < options_.contradictions_to_find_anew) return false;
  if (contradiction.at - contradicted_since_ < options_.contradictions_spread) return false;
  refused_ = !supported(*rival_);
  return !refused_;
}

void Timekeeper::drop_rival() {
  rival_.reset();
  refused_ = false;
}

bool Timekeeper::supported(const Filter& filter) const {
  // 5000 ppm slow by one clock are 5025 ppm fast by the other: whichever it is counted by.
  const double drift = std::abs(filter.drift);
  return drift / (1.0 + drift) <= options_.drift_max + kBeyondDoubt * std::sqrt(filter.p11);
}

std::optional<std::string> Timekeeper::complaint() const {
  if (!running_ || supported(believed())) return std::nullopt;
  return text("its clock runs %.0f ppm apart from the swarm's, %.0f ppm are supported",
              1e6 * std::abs(believed().drift), 1e6 * options_.drift_max);
}

void Timekeeper::doubt(Duration error) {
  filter_.p00 += nanoseconds(error) * nanoseconds(error);
  // Another coordinator may run on another machine, whose quartz drifts otherwise.
  const double drift_sigma = options_.drift_max / 3.0;
  filter_.p11 += drift_sigma * drift_sigma;
}

Timekeeper::Filter Timekeeper::begin(const Measurement& m) const {
  Filter filter;
  filter.at = m.at;
  filter.offset_ns = m.offset_ns;
  filter.asymmetry_ns = 0.5 * m.delay_ns;
  filter.p00 = m.sigma_ns * m.sigma_ns;
  filter.p11 = kAnyDrift * kAnyDrift;
  filter.wander_per_sqrt_s = options_.drift_wander_per_sqrt_s;
  return filter;
}

void Timekeeper::Filter::predict(LocalTime local) {
  const double dt = nanoseconds(local - at);
  const double wander = wander_per_sqrt_s * wander_per_sqrt_s * 1e-9 * dt;
  offset_ns += drift * dt;
  p00 += 2.0 * dt * p01 + dt * dt * (p11 + wander / 3.0);
  p01 += dt * (p11 + wander / 2.0);
  p11 += wander;
  at = local;
}

double Timekeeper::Filter::bound_ns(const Measurement& m) const {
  // A measurement may be off by half its delay, in swarm time, whatever the network did, and by no more.
  return kBeyondDoubt * std::sqrt(p00) + asymmetry_ns + 0.5 * (1.0 + std::abs(drift)) * m.delay_ns;
}

bool Timekeeper::Filter::follow(const Measurement& m) {
  predict(m.at);
  const double innovation_ns = m.offset_ns - offset_ns;
  const double variance = p00 + m.sigma_ns * m.sigma_ns;
  if (std::abs(innovation_ns) > bound_ns(m)) return false;
  const double gain_offset = p00 / variance;
  const double gain_drift = p01 / variance;
  offset_ns += gain_offset * innovation_ns;
  drift += gain_drift * innovation_ns;
  asymmetry_ns += gain_offset * (0.5 * m.delay_ns - asymmetry_ns);
  p11 -= gain_drift * p01;
  p01 -= gain_offset * p01;
  p00 -= gain_offset * p00;
  return true;
}

void Timekeeper::Filter::expect_drift(double sigma) {
  const double variance = p11 + sigma * sigma;
  const double gain_offset = p01 / variance;
  const double gain_drift = p11 / variance;
  offset_ns -= gain_offset * drift;
  drift -= gain_drift * drift;
  p00 -= gain_offset * p01;
  p01 -= gain_drift * p01;
  p11 -= gain_drift * p11;
}

void Timekeeper::steer(LocalTime local, bool jump) {
  // A noisy network may make the filter think of any drift for a while.
  const double rate = std::clamp(filter_.drift, -2.0 * options_.drift_max, 2.0 * options_.drift_max);
  const double ahead_ns = nanoseconds(local - filter_.at);
  const SwarmTime target(local.time_since_epoch() + origin_ + rounded(filter_.offset_ns + rate * ahead_ns));
  const SwarmTime shown = jump ? target : at(local);
  anchor_local_ = local;
  anchor_swarm_ = shown;
  const double pace = nanoseconds(target - shown) / nanoseconds(options_.slew_time);
  steady_rate_ = rate;
  slewing_rate_ = rate + std::clamp(pace, -options_.slew_max, options_.slew_max);
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
  Filter f = believed();
  f.predict(std::max(local, f.at));
  const double shown_ns = nanoseconds(at(local).time_since_epoch() - local.time_since_epoch() - origin_);
  return rounded(3.0 * std::sqrt(f.p00) + f.asymmetry_ns + std::abs(f.offset_ns - shown_ns));
}

}  // namespace gyre::protocol
