#include "common/dds/clock.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/base/ensure.hpp"

namespace gyre::dds {
namespace {

ClockError& process_clock_error() {
  static ClockError error;
  return error;
}

// Read by every thread, written by one. Whoever reads the shift first and what was shown after it never sees a shift
// back without where the clock stands.
std::atomic<Duration::rep> shift_ns{0};
std::atomic<Duration::rep> shown_ns{LocalTime::min().time_since_epoch().count()};

LocalTime shown_at(ClockError::Steady s) {
  const Duration shift(shift_ns.load());
  return std::max(process_clock_error().shown_at(s) + shift, LocalTime(Duration(shown_ns.load())));
}

}  // namespace

ClockError::ClockError(Duration offset, double drift_ppm, Steady since)
    : offset_(offset), drift_(1e-6 * drift_ppm), since_(since) {
  GYRE_ENSURE(std::abs(seconds(offset)) <= kMaxClockOffset_s, "a clock error has a bounded offset");
  GYRE_ENSURE(std::abs(drift_ppm) <= kMaxClockDrift_ppm, "a clock error has a bounded drift");
}

// Only the small part passes through a double, so that nanoseconds survive any uptime.
Duration ClockError::drifted(Duration elapsed) const {
  return Duration(std::llround(drift_ * static_cast<double>(elapsed.count())));
}

LocalTime ClockError::shown_at(Steady s) const {
  const Duration elapsed = s - since_;
  return LocalTime(s.time_since_epoch() + offset_ + drifted(elapsed));
}

ClockError::Steady ClockError::moment_of(LocalTime t) const {
  const Duration shown = t.time_since_epoch() - offset_ - since_.time_since_epoch();
  const double correction_ns = static_cast<double>(shown.count()) * drift_ / (1.0 + drift_);
  Steady s = since_ + shown - Duration(std::llround(correction_ns));
  // Rounding may have missed the moment by a few nanoseconds, either way.
  while (shown_at(s) < t) s += Duration(1);
  while (shown_at(s - Duration(1)) >= t) s -= Duration(1);
  return s;
}

void set_clock_error(Duration offset, double drift_ppm) {
  shift_ns.store(0);
  shown_ns.store(LocalTime::min().time_since_epoch().count());
  process_clock_error() = ClockError(offset, drift_ppm, std::chrono::steady_clock::now());
}

void shift_clock(Duration by) {
  const Duration sum = Duration(shift_ns.load()) + by;
  GYRE_ENSURE(std::abs(seconds(sum)) <= kMaxClockOffset_s, "the shifts of a clock are bounded");
  shown_ns.store(now().time_since_epoch().count());
  shift_ns.store(sum.count());
}

LocalTime now() {
  return shown_at(std::chrono::steady_clock::now());
}

std::chrono::steady_clock::time_point steady_time(LocalTime deadline) {
  const ClockError::Steady moment = process_clock_error().moment_of(deadline - Duration(shift_ns.load()));
  // A clock that stands still shows what it would otherwise show later.
  if (deadline <= LocalTime(Duration(shown_ns.load()))) return std::min(moment, std::chrono::steady_clock::now());
  return moment;
}

}  // namespace gyre::dds
