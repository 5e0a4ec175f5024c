#include "agent/core/step_judge.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"

namespace gyre::agent {
namespace {

double absurd(const std::optional<double>& limit, double ever) {
  return limit ? std::min(ever, StepJudge::kAbsurdTimes * *limit) : ever;
}

/// How far it is from what the last one said of the time that passed.
double leap_m(const protocol::Setpoint& from, const protocol::Setpoint& to, double dt_s) {
  const double way =
      (to.position_w_m - from.position_w_m - 0.5 * dt_s * (from.velocity_w_m_s + to.velocity_w_m_s)).norm();
  const double cable = to.winch_length_m - from.winch_length_m - 0.5 * dt_s * (from.winch_rate_m_s + to.winch_rate_m_s);
  const double bend = std::max({from.acceleration_w_m_s2.norm(), to.acceleration_w_m_s2.norm(),
                                std::abs(from.winch_acceleration_m_s2), std::abs(to.winch_acceleration_m_s2)});
  return std::max(way, std::abs(cable)) - StepJudge::kGenerous * dt_s * dt_s * bend;
}

}  // namespace

StepJudge::StepJudge(const mechanics::Limits& vehicle, Duration long_ago)
    : speed_max_m_s_(absurd(vehicle.speed_max_m_s, kAbsurdSpeed_m_s)),
      acceleration_max_m_s2_(absurd(vehicle.acceleration_max_m_s2, kAbsurdAcceleration_m_s2)),
      winch_rate_max_m_s_(absurd(vehicle.winch_rate_max_m_s, kAbsurdSpeed_m_s)),
      long_ago_(long_ago) {}

std::optional<std::string> StepJudge::objection(LocalTime now, const protocol::Setpoint& s) {
  const bool finite = s.position_w_m.allFinite() && s.velocity_w_m_s.allFinite() && s.acceleration_w_m_s2.allFinite() &&
                      s.direction_w.allFinite() && std::isfinite(s.tension_n + s.cable_length_m) &&
                      std::isfinite(s.winch_length_m + s.winch_rate_m_s + s.winch_acceleration_m_s2);
  if (!finite) return "its own setpoint has no value: withheld";
  const double speed_m_s = s.velocity_w_m_s.norm();
  const double acceleration_m_s2 = std::max(s.acceleration_w_m_s2.norm(), std::abs(s.winch_acceleration_m_s2));
  if (speed_m_s > speed_max_m_s_ || std::abs(s.winch_rate_m_s) > winch_rate_max_m_s_) {
    return text("its own setpoint asks for %.3g m/s, the winch for %.3g m/s: withheld", speed_m_s, s.winch_rate_m_s);
  }
  if (acceleration_m_s2 > acceleration_max_m_s2_) {
    return text("its own setpoint asks for %.3g m/s2: withheld", acceleration_m_s2);
  }
  if (last_ && now - last_->at <= long_ago_) {
    // By the vehicle's clock where swarm time was found anew: it flies on by its own.
    const double leap = std::min(leap_m(last_->setpoint, s, seconds(now - last_->at)),
                                 leap_m(last_->setpoint, s, seconds(s.swarm_time - last_->setpoint.swarm_time)));
    if (leap > kUnnoticed_m) return text("its own setpoint steps by %.2f m: withheld", leap);
  }
  last_ = Last{now, s};
  return std::nullopt;
}

}  // namespace gyre::agent
