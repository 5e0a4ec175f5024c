#include "agent/core/clock_watch.hpp"

#include <algorithm>

namespace gyre::agent {

Ages::Seems Ages::hear(Duration age) {
  const bool strange = known() && !usual(age);
  in_a_row_ = strange ? in_a_row_ + 1 : 0;
  if (in_a_row_ > kInARow) begin_anew();
  if (strange && known()) return Seems::kStrange;
  const Seems seems = known() ? Seems::kUsual : Seems::kUnknown;
  keep(age);
  return seems;
}

void Ages::keep(Duration age) {
  ages_[count_ % kWindow] = age;
  ++count_;
  const auto end = ages_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kWindow));
  const auto [least, greatest] = std::minmax_element(ages_.begin(), end);
  least_ = *least;
  greatest_ = *greatest;
}

std::optional<Duration> Ages::lately() const {
  if (count_ < kEnough + kFew) return std::nullopt;
  const std::size_t kept = std::min(count_, kWindow);
  Duration before = Duration::max();
  Duration last = Duration::max();
  for (std::size_t back = 1; back <= kept; ++back) {
    Duration& least = back <= kFew ? last : before;
    least = std::min(least, ages_[(count_ - back) % kWindow]);
  }
  return last - before;
}

void Ages::shift(Duration by) {
  for (Duration& age : ages_) age += by;
  least_ += by;
  greatest_ += by;
  in_a_row_ = 0;
}

void ClockWatch::step(LocalTime now) {
  const bool late = stepped_at_ && now - *stepped_at_ > kLate;
  stepped_at_ = now;
  if (late_at_ && now - *late_at_ > kUnconfirmed) late_at_.reset();
  if (late && (vehicle_.known() || beacons_.known())) late_at_ = now;
  if (suspicion_ && now - suspicion_->since > kLongestSuspicion) refuted();
}

void ClockWatch::hear_vehicle(LocalTime arrived, std::uint64_t incarnation, LocalTime stamp) {
  if (incarnation != vehicle_incarnation_) vehicle_.begin_anew();  // of another clock
  vehicle_incarnation_ = incarnation;
  const Duration age = arrived.time_since_epoch() - stamp.time_since_epoch();
  const Ages::Seems seems = vehicle_.hear(age);
  if (seems == Ages::Seems::kStrange) return suspect(Witness::kVehicle, vehicle_.step(age));
  if (seems == Ages::Seems::kUsual) confirm(arrived);
}

void ClockWatch::hear_beacon(LocalTime arrived, SwarmTime stamp) {
  const Duration age = arrived.time_since_epoch() - stamp.time_since_epoch();
  const Ages::Seems seems = beacons_.hear(age);
  if (seems == Ages::Seems::kStrange && late_at_ && !suspicion_) suspect(Witness::kBeacon, beacons_.step(age));
  if (seems != Ages::Seems::kUsual) return;
  if (!suspicion_ || witness_ == Witness::kBeacon) return confirm(arrived);
  // The vehicle says that the clock has leapt; a beacon that would be strange then is as usual: it was the vehicle's.
  if (arrived >= suspicion_->since && !beacons_.usual(age - suspicion_->leap)) {
    vehicle_.begin_anew();
    confirm(arrived);
  }
}

void ClockWatch::suspect(Witness witness, Duration leap) {
  if (!suspicion_) suspicion_ = Suspicion{*stepped_at_, leap};
  suspicion_->leap = leap;
  witness_ = witness;
}

void ClockWatch::confirm(LocalTime arrived) {
  confirmed_ = std::max(confirmed_, arrived);
  suspicion_.reset();
  if (late_at_ && arrived >= *late_at_ - kLate) late_at_.reset();
}

std::optional<Duration> ClockWatch::lately() const {
  if (suspicion_) return suspicion_->leap;
  const std::optional<Duration> step = vehicle_.lately();
  if (!step || std::max(*step, -*step) <= Ages::kUnusual) return std::nullopt;
  return step;
}

void ClockWatch::leapt(Duration by) {
  vehicle_.shift(by);
  beacons_.shift(by);
  suspicion_.reset();
  late_at_.reset();
}

void ClockWatch::refuted() {
  vehicle_.begin_anew();
  beacons_.begin_anew();
  suspicion_.reset();
  late_at_.reset();
}

}  // namespace gyre::agent
