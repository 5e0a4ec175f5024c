#include "coordinator/core/path_judge.hpp"

#include <algorithm>

namespace gyre::coordinator {

void PathJudge::take(LocalTime now, const protocol::CarrierState& state,
                     const mechanics::TaylorVector<double>& planned) {
  Track& track = tracks_[state.carrier];
  if (now - track.heard > options_.fresh) track.near_since = track.slow_since = std::nullopt;
  track.heard = now;
  const Eigen::Vector3d& v = planned.first;
  const Eigen::Vector3d off = planned.value - state.position_w_m;
  const double speed = v.norm();
  track.off_m = off.norm();
  if (speed < options_.least_speed_m_s) {
    track.slow_since.reset();
    return;
  }
  track.lag = from_seconds(std::clamp(off.dot(v) / (speed * speed), -10.0, 10.0));
  const double way = state.velocity_w_m_s.dot(v) / (speed * speed);
  if (way < options_.way) {
    if (!track.slow_since) track.slow_since = now;
    track.near_since.reset();
    return;
  }
  track.slow_since.reset();
  if (track.off_m > options_.near_m + 0.05 * speed) {
    track.near_since.reset();
  } else if (!track.near_since) {
    track.near_since = now;
  }
  if (track.near_since && now - *track.near_since >= options_.on_path_for) track.armed = true;
}

bool PathJudge::slow(const Track& track, LocalTime now) const {
  return track.slow_since && now - track.heard <= options_.fresh;
}

std::optional<PathJudge::Stuck> PathJudge::stuck(LocalTime now, std::size_t carriers) {
  const auto slow_now = static_cast<std::size_t>(
      std::count_if(tracks_.begin(), tracks_.end(), [&](const auto& entry) { return slow(entry.second, now); }));
  if (2 * slow_now > carriers) return std::nullopt;
  for (auto& [carrier, track] : tracks_) {
    if (!track.armed || !slow(track, now) || track.heard - *track.slow_since < options_.slow_for) continue;
    track.armed = false;
    return Stuck{carrier, track.lag};
  }
  return std::nullopt;
}

bool PathJudge::on_path(LocalTime now, CarrierId carrier) const {
  const auto found = tracks_.find(carrier);
  return found != tracks_.end() && now - found->second.heard <= options_.fresh && found->second.armed &&
         !found->second.slow_since;
}

std::optional<double> PathJudge::off_m(LocalTime now, CarrierId carrier) const {
  const auto found = tracks_.find(carrier);
  if (found == tracks_.end() || now - found->second.heard > options_.fresh) return std::nullopt;
  return found->second.off_m;
}

}  // namespace gyre::coordinator
