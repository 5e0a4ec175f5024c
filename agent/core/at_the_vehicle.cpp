// How an agent and its vehicle stay together: what the vehicle is told begins where it is, and goes on from there.

#include "agent/core/agent.hpp"
#include "common/protocol/sanity.hpp"

namespace gyre::agent {

namespace {

Command command_of(const protocol::CarrierState& s) {
  return {{s.position_w_m, s.velocity_w_m_s, Eigen::Vector3d::Zero()}, {s.winch_length_m, s.winch_rate_m_s, 0.0}};
}

}  // namespace

void Agent::on(LocalTime now, const protocol::CarrierState& state, Outputs& /*out*/) {
  if (!sane(state) || state.carrier != options_.carrier) {
    ++dropped_.nonsense;
    return;
  }
  const protocol::Incumbent::Verdict verdict = vehicles_.hear(now, state.incarnation);
  if (verdict == protocol::Incumbent::Verdict::kRival) {
    ++dropped_.duplicate;
    return;
  }
  // Silent while this agent was awake; after a stall of its own, what comes first is old (back_at_the_vehicle).
  const bool flies = flown_at_ && now - *flown_at_ <= options_.stall;
  const bool was_silent = !vehicle_ || now - vehicle_heard_ > options_.vehicle_timeout;
  const bool another = vehicle_ && verdict == protocol::Incumbent::Verdict::kSucceeds;
  vehicle_ = state;
  vehicle_heard_ = now;
  vehicle_held_ = now - age_of(state, now, was_silent, verdict == protocol::Incumbent::Verdict::kSucceeds);
  // How late the first one came is not known before the next ones: nothing has happened then, and nothing was said.
  if (seems_lost_ && !is_lost(now)) {
    awake_since_.reset();
    seems_lost_ = false;
  }
  if (flies && (was_silent || another) && is_lost(now)) {
    awake_since_ = now;
    seems_lost_ = true;
  }
  if (state.follows == 0 || state.follows == options_.incarnation) {
    unfollowed_since_.reset();
  } else if (!unfollowed_since_) {
    unfollowed_since_ = now;
  }
}

/// What waited, for a vehicle that was stopped or for this process, is older than its arrival. A stamp of zero is none:
/// that vehicle is taken at its word.
Duration Agent::age_of(const protocol::CarrierState& state, LocalTime now, bool after_silence, bool of_another) {
  if (of_another) vehicle_ages_ = {};
  if (state.stamp == LocalTime{} || !usable(state.stamp)) return Duration::zero();
  if (after_silence) vehicle_ages_.keep(now);
  return vehicle_ages_.age(state.stamp.time_since_epoch(), now);
}

void Agent::listen(LocalTime now) {
  awake_since_ = now;
  seems_lost_ = false;
  vehicle_.reset();
}

bool Agent::led_by_another(LocalTime now) const {
  return unfollowed_since_ && now - vehicle_heard_ <= options_.vehicle_timeout;
}

bool Agent::is_lost(LocalTime now) const {
  const std::optional<SwarmTime> time = swarm_time(now);
  if (!time || !reference(course_, *time)) return false;
  const Command asked = merge_.apply(*time - (now - vehicle_held_), path(course_));
  return (asked.position_w_m.value - vehicle_->position_w_m).norm() > options_.vehicle_lost_m;
}

/// After a stall, its own or the wire's to the vehicle, the vehicle has gone on by itself: what it is told next begins
/// where it is. False while that is unknown.
bool Agent::back_at_the_vehicle(LocalTime now) {
  if (flown_at_ && now - *flown_at_ > options_.stall && !awake_since_) listen(now);
  // What is said to a vehicle that follows another agent is not flown, and would be a leap once that one is gone.
  if (led_by_another(now)) {
    awake_since_ = now;
    seems_lost_ = false;
  }
  if (awake_since_) {
    const Duration awake = now - *awake_since_;
    const bool tells = vehicle_ && now - vehicle_held_ <= options_.vehicle_fresh;
    if (awake < options_.backlog || (!tells && awake < options_.vehicle_wait)) return false;
    if (tells) begin_at_the_vehicle(now, path(course_));
    awake_since_.reset();
    seems_lost_ = false;
  }
  flown_at_ = now;
  return true;
}

void Agent::begin_at_the_vehicle(LocalTime now, const Path& path) {
  merge_.begin_at_vehicle(clock_.at(now), now - vehicle_held_, command_of(*vehicle_), path);
  steps_.forget();  // it was silent, and what it said before was not flown
  flown_at_ = now;  // a stall before the first setpoint is one, too
}

}  // namespace gyre::agent
