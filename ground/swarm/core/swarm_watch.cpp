#include "ground/swarm/core/swarm_watch.hpp"

#include <algorithm>
#include <utility>

#include "common/base/angle.hpp"
#include "common/base/text.hpp"
#include "common/protocol/sanity.hpp"
#include "common/protocol/term.hpp"
#include "ground/swarm/core/course_line.hpp"

namespace gyre::ground {
namespace {

/// Of beacons and load states, fifty and a hundred a second: at 60 % loss the odds against such a gap are 1e5 to one.
constexpr Duration kStreamSilence = std::chrono::milliseconds(500);
/// Of the coordinator's word, twice a second and delivered again where it is lost.
constexpr Duration kWordSilence = std::chrono::seconds(3);

}  // namespace

SwarmWatch::SwarmWatch(const mission::Mission& mission, LocalTime now)
    : load_(mission.plan.load),
      gravity_m_s2_(mission.plan.gravity_m_s2),
      tolerance_(mission.load_tolerance),
      begin_(now),
      beacon_heard_(kStreamSilence),
      coordinator_heard_(kWordSilence),
      load_heard_(kStreamSilence) {
  for (const mechanics::Carrier& carrier : mission.plan.carriers) {
    arm_m_ = std::max(arm_m_, carrier.attachment_b_m.norm());
  }
}

void SwarmWatch::see(const protocol::Beacon& beacon, LocalTime arrived) {
  // Two coordinators may be heard for a moment, while one takes over.
  if (beacon_ && beacon.term < beacon_->term && !beacon_heard_.silent(arrived)) return;
  beacon_ = beacon;
  beacon_heard_.heard(arrived);
}

void SwarmWatch::see(const protocol::CoordinatorStatus& status, LocalTime arrived) {
  if (coordinator_ && status.term < coordinator_->term && !coordinator_heard_.silent(arrived)) return;
  coordinator_ = status;
  coordinator_heard_.heard(arrived);
}

void SwarmWatch::see(const protocol::Health& health, LocalTime /*arrived*/) {
  Duration& late = late_max_[health.process];
  late = std::max(late, health.late_max);
  if (health.complaint.empty()) {
    complaints_.erase(health.process);
  } else {
    complaints_[health.process] = health.complaint;
  }
}

void SwarmWatch::see(const protocol::LoadState& load, LocalTime arrived) {
  if (!sane(load)) return;                                       // whatever is not a number is not far away either
  if (!load_heard_.believes(arrived, load.incarnation)) return;  // another simulator's world
  displacement_now_m_ = (load.position_w_m - load_.position_w_m).norm();
  rotation_now_deg_ = degrees(load.orientation_w_b.angularDistance(load_.orientation_w_b));
  window_.displacement_max_m = std::max(window_.displacement_max_m, displacement_now_m_);
  window_.rotation_max_deg = std::max(window_.rotation_max_deg, rotation_now_deg_);
  ++window_.samples;
  // Not newer: it was restarted, or the wire changed the order.
  if (last_load_ && load.stamp > last_load_->stamp) {
    window_.residual_max = std::max(window_.residual_max, residual(*last_load_, load));
  }
  last_load_ = load;
}

double SwarmWatch::residual(const protocol::LoadState& before, const protocol::LoadState& after) const {
  const double dt_s = seconds(after.stamp - before.stamp);
  const Eigen::Vector3d acceleration = (after.velocity_w_m_s - before.velocity_w_m_s) / dt_s;
  const Eigen::Vector3d spin = after.angular_velocity_b_rad_s;
  const Eigen::Vector3d spin_up = (spin - before.angular_velocity_b_rad_s) / dt_s;
  const double weight_n = load_.mass_kg * gravity_m_s2_;
  // F = m dv/dt      M = J dw/dt + w x J w
  const double force_n = load_.mass_kg * acceleration.norm();
  const double moment_n_m = (load_.inertia_b_kg_m2 * spin_up + spin.cross(load_.inertia_b_kg_m2 * spin)).norm();
  return std::max(force_n, arm_m_ > 0.0 ? moment_n_m / arm_m_ : 0.0) / weight_n;
}

std::optional<std::string> SwarmWatch::out_of_contact(LocalTime now) const {
  if (beacon_heard_.silent(now)) return "the coordinator is not heard";
  if (load_heard_.silent(now)) return "nobody tells where the load is";
  return std::nullopt;
}

std::string SwarmWatch::complaint(LocalTime now) const {
  if (const auto missing = out_of_contact(now)) return *missing;
  if (coordinator_heard_.silent(now)) return "the coordinator beacons, but does not say how it is";
  if (!coordinator_->silent.empty()) return text("carrier %u is silent", coordinator_->silent.front());
  const protocol::Course& course = beacon_->course;
  if (course.wish.by == protocol::Wisher::kSilence && course.wish.pace == 0.0)
    return "all have stopped, because somebody fell silent";
  if (course.wish.by == protocol::Wisher::kEvidence && course.wish.pace == 0.0) {
    return "all have stopped, because a carrier got stuck";
  }
  if (!course.transitions.empty()) return "a transition is under way";
  if (!course.flown_pace(beacon_->swarm_time).constant(beacon_->swarm_time)) return "the pace is changing";
  if (beacon_->proposal) return "a change is proposed";
  if (course.wish.pace != course.pace.target()) return pace_name(course.wish.pace) + " is wished, and not agreed yet";
  if (course.base.number != coordinator_->plan) return "the load is not held by the mission's plan";
  if (coordinator_->skew_budget > Duration::zero() && coordinator_->skew > coordinator_->skew_budget) {
    return text("the clocks may disagree by %.3g ms, the plan in force allows %.3g ms",
                1e3 * seconds(coordinator_->skew), 1e3 * seconds(coordinator_->skew_budget));
  }
  if (!complaints_.empty()) return complaints_.begin()->first + ": " + complaints_.begin()->second;
  if (displacement_now_m_ > tolerance_.displacement_max_m) {
    return text("the load is %.3g mm away, the mission allows %.3g mm", 1e3 * displacement_now_m_,
                1e3 * tolerance_.displacement_max_m);
  }
  if (rotation_now_deg_ > tolerance_.rotation_max_deg) {
    return text("the load is turned by %.3g degrees, the mission allows %.3g", rotation_now_deg_,
                tolerance_.rotation_max_deg);
  }
  return {};
}

Account SwarmWatch::account(LocalTime now) {
  Account account;
  account.time_s = seconds(now - begin_);
  account.complaint = complaint(now);
  account.course = beacon_ ? course_line(*beacon_, coordinator_) : "unknown";
  account.complaints = complaints_;
  account.late_max = std::exchange(late_max_, {});
  account.load = window_;
  account.allowed = tolerance_;
  window_ = {};
  if (coordinator_) {
    account.term = protocol::generation(coordinator_->term);
    account.silent = coordinator_->silent;
    account.skew = coordinator_->skew;
    account.skew_budget = coordinator_->skew_budget;
  }
  return account;
}

}  // namespace gyre::ground
