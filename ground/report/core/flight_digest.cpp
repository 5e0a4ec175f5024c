#include "ground/report/core/flight_digest.hpp"

#include <algorithm>

#include "common/base/angle.hpp"

namespace gyre::ground {
namespace {

/// A flight is engaged and released a few times; a recording can be of days.
constexpr std::size_t kMostMotions = 64;
constexpr std::size_t kMostMissions = 16;
constexpr std::size_t kMostCarriers = kMaxCarrierId;
constexpr double kMillimetres = 1e3;

std::vector<CarrierId> carriers_of(const std::optional<mission::Mission>& mission) {
  std::vector<CarrierId> ids;
  if (!mission) return ids;
  for (const mechanics::Carrier& carrier : mission->plan.carriers) ids.push_back(carrier.id);
  return ids;
}

}  // namespace

FlightDigest::FlightDigest(std::optional<mission::Mission> mission) : mission_(std::move(mission)) {
  if (!mission_) return;
  record_.emplace(mission_->plan);
  certificate_.emplace(mission_->plan);
}

void FlightDigest::see(LocalTime heard, const SwarmMessage& message) {
  if (!monitor_) monitor_.emplace(view_, carriers_of(mission_), heard);
  if (!view_.step(heard, message)) return;
  ++messages_;
  monitor_->look(heard);
  if (const auto* beacon = std::get_if<protocol::Beacon>(&message)) axis_.see(heard, beacon->swarm_time);
  const double t_s = axis_.at(heard);
  recorded_s_.include(t_s);
  note_motion(heard, t_s);
  if (const auto* state = std::get_if<protocol::CarrierState>(&message)) {
    on(heard, t_s, *state);
  } else if (const auto* load = std::get_if<protocol::LoadState>(&message)) {
    on(heard, t_s, *load);
  } else if (const auto* status = std::get_if<protocol::CoordinatorStatus>(&message)) {
    on(*status);
  }
  if (!record_) return;
  if (const auto* beacon = std::get_if<protocol::Beacon>(&message)) {
    certificate_->include(beacon->course);
    record_->see_beacon();
  }
  if (!monitor_->under_way(heard)) return;
  if (const auto* status = std::get_if<protocol::AgentStatus>(&message)) record_->see(*status);
  if (const auto* health = std::get_if<protocol::Health>(&message)) record_->see(*health);
}

void FlightDigest::note_motion(LocalTime heard, double t_s) {
  const bool was_in_motion = in_motion_;
  in_motion_ = monitor_->phase(heard) == FlightPhase::kFlying;
  if (!in_motion_) return;
  const bool goes_on = was_in_motion || motion_s_.size() >= kMostMotions;
  if (!goes_on) motion_s_.push_back({t_s, t_s});
  if (was_in_motion) flown_s_ += t_s - motion_s_.back().max;
  motion_s_.back().max = t_s;
}

double FlightDigest::note_stream(const std::string& who, double t_s) {
  Stream& stream = streams_[who];
  const double silent_s = stream.last_s ? t_s - *stream.last_s : 0.0;
  if (silent_s > stream.longest.duration_s) stream.longest = {who, *stream.last_s, silent_s};
  stream.last_s = t_s;
  return silent_s;
}

void FlightDigest::on(LocalTime heard, double t_s, const protocol::CarrierState& state) {
  if (carriers_.size() >= kMostCarriers && carriers_.count(state.carrier) == 0) return;
  const std::string who = "carrier " + std::to_string(state.carrier);
  CarrierSeries& series = carriers_[state.carrier];
  if (note_stream(who, t_s) > Envelope::kGap_s) series.path.interrupt();
  series.tension_n.add(t_s, state.tension_n);
  series.length_m.add(t_s, state.cable_length_m);
  series.speed_m_s.add(t_s, state.velocity_w_m_s.norm());
  series.winch_rate_m_s.add(t_s, state.winch_rate_m_s);
  series.altitude_m.add(t_s, state.position_w_m.z());
  series.path.add(state.position_w_m);
  if (record_ && monitor_->under_way(heard)) record_->see(state, monitor_->phase(heard) == FlightPhase::kFlying);
}

void FlightDigest::on(LocalTime heard, double t_s, const protocol::LoadState& state) {
  if (note_stream("the load", t_s) > Envelope::kGap_s) load_.path.interrupt();
  if (!load_reference_) {
    load_reference_ = state;
    if (mission_) {
      load_reference_->position_w_m = mission_->plan.load.position_w_m;
      load_reference_->orientation_w_b = mission_->plan.load.orientation_w_b;
    }
  }
  load_.displacement_mm.add(t_s, (state.position_w_m - load_reference_->position_w_m).norm() * kMillimetres);
  load_.rotation_deg.add(t_s, degrees(state.orientation_w_b.angularDistance(load_reference_->orientation_w_b)));
  load_.path.add(state.position_w_m);
  if (record_ && monitor_->under_way(heard)) record_->see(state, heard);
}

void FlightDigest::on(const protocol::CoordinatorStatus& status) {
  if (certificate_) certificate_->see(status);
  const bool news = missions_told_.empty() || missions_told_.back() != status.mission;
  if (news && missions_told_.size() < kMostMissions) missions_told_.push_back(status.mission);
}

std::vector<Silence> FlightDigest::silences() const {
  std::vector<Silence> out;
  double end_s = 0.0;
  for (const auto& [who, stream] : streams_) end_s = std::max(end_s, *stream.last_s);
  for (const auto& [who, stream] : streams_) {
    const double silent_s = end_s - *stream.last_s;
    const Silence longest =
        silent_s > stream.longest.duration_s ? Silence{who, *stream.last_s, silent_s} : stream.longest;
    if (longest.duration_s > Envelope::kGap_s) out.push_back(longest);
  }
  return out;
}

std::optional<FlightReport> FlightDigest::judged() const {
  if (!record_ || flown_s_ <= 0.0) return std::nullopt;
  return judge_flight(*mission_, *certificate_, *record_, flown_s_);
}

}  // namespace gyre::ground
