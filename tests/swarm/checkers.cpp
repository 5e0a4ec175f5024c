#include "tests/swarm/checkers.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/text.hpp"
#include "common/mechanics/grasp.hpp"
#include "common/mechanics/quintic.hpp"
#include "common/mechanics/transition.hpp"
#include "coordinator/core/coordinator.hpp"

namespace gyre::swarm {
namespace {

/// A setpoint says so much by rounding.
constexpr double kRounding = 1e-9;
/// A position further than this from where the plan has it is one of an agent that merges.
constexpr double kMerging_m = 1e-6;
/// A vehicle is then on its own (agent options: stall), and its agent no longer knows where it is.
const double kSilenceSeconds = seconds(agent::AgentOptions{}.stall) + 0.05;
/// Of the clock that is read, by rounding and by reading it at two moments of one step.
constexpr double kSwarmTimeJump_s = 2e-6;
/// The clock is slewed by 1 % at most, and its rate may for a while be taken for one that is 1 % off
/// (common/protocol/timekeeper.cpp).
constexpr double kSlew = 0.0205;

/// A coordinator that recovers learns swarm time from messages: as late as they were, and as wrong as their senders.
constexpr Duration kRecoveryError = std::chrono::milliseconds(50);
/// Meanwhile the agents walk that off, each beginning when it noticed; what they claim does not know of it.
constexpr Duration kRecovery = std::chrono::seconds(5);

/// No carrier is further from its attachment in any motion.
double reach_m_of(const LoadWithMotions& load) {
  double reach_m = 0.0;
  for (const mechanics::Plan& plan : load.motions) {
    for (const mechanics::CarrierSlice& slice : slices(plan)) {
      for (int i = 0; i < 32; ++i) {
        reach_m = std::max(reach_m, mechanics::evaluate(slice, period_s(plan) * i / 32.0).length_m.value);
      }
    }
  }
  return reach_m;
}

}  // namespace

Checkers::Checkers(const LoadWithMotions& load, const Scenario& scenario)
    : agents_(load.size()), equilibrium_(load), budget_share_(scenario.residual_budget) {
  const mechanics::Plan& first = load.motions.front();
  for (const Eigen::Vector3d& arm : lever_arms(first)) attachments_w_m_.emplace_back(first.load.position_w_m + arm);
  // Transitions here are not rehearsed: they may ask for more than the limits, as much as their shortness makes them.
  const double travel_m = 2.0 * reach_m_of(load);
  acceleration_m_s2_ =
      2.0 * load.vehicle.acceleration_max_m_s2.value() +
      mechanics::kStepCurvaturePeak * travel_m / std::pow(std::min(seconds(scenario.transition), 2.0), 2);
}

void Checkers::report(Finding::Kind kind, TrueTime at, const std::string& rule, const std::string& text) {
  const auto same = [&rule](const Finding& f) { return f.rule == rule; };
  if (std::none_of(findings_.begin(), findings_.end(), same)) findings_.push_back({kind, at, rule, text});
}

void Checkers::begins(std::size_t agent) {
  agents_[agent] = Agent{};
  agents_[agent].lives = true;
}

void Checkers::ends(std::size_t agent) {
  agents_[agent].lives = false;
}

void Checkers::status(std::size_t agent, TrueTime now, const protocol::AgentStatus& status) {
  Agent& a = agents_[agent];
  if (status.term < a.term)
    report(Finding::Kind::kSafety, now, "terms", text("agent %u went back to an older term", status.carrier));
  if (status.term != a.term) a.term_since = now;
  a.term = status.term;
  a.uncertainty = status.clock_uncertainty;
}

void Checkers::found_anew(std::size_t agent, TrueTime now) {
  agents_[agent].found_anew = now;
  agents_[agent].last.reset();
  if (!stopped_ && !lies_)
    report(Finding::Kind::kSafety, now, "swarm time",
           text("agent at %zu found it anew, though no clock jumped", agent));
}

void Checkers::setpoint(std::size_t agent, TrueTime now, const protocol::Setpoint& setpoint,
                        const protocol::CarrierState& vehicle) {
  Agent& a = agents_[agent];
  if (!a.last || seconds(now - a.last->at) > kSilenceSeconds) check_return(now, setpoint, vehicle);
  ++extremes_.setpoints;
  a.before = a.last;
  a.last = Sample{now, setpoint};
  equilibrium_.commanded(agent, now, setpoint);
  if (a.before) check_continuity(now, a, *a.before, *a.last);
}

void Checkers::check_return(TrueTime now, const protocol::Setpoint& s, const protocol::CarrierState& vehicle) {
  // The vehicle tells its state every 20 ms, and slows down or follows a curve meanwhile.
  constexpr double kStateAge_s = 0.04;
  const double bound_m = 1e-6 + acceleration_m_s2_ * kStateAge_s * kStateAge_s;
  const double step_m = (s.position_w_m - vehicle.position_w_m).norm();
  if (step_m <= bound_m) return;
  report(
      Finding::Kind::kSafety, now, "return",
      text("agent %u comes back %.3g mm away from its vehicle (bound %.3g)", s.carrier, 1e3 * step_m, 1e3 * bound_m));
}

void Checkers::check_continuity(TrueTime now, const Agent& /*agent*/, const Sample& before, const Sample& last) {
  const protocol::Setpoint& p = before.setpoint;
  const protocol::Setpoint& s = last.setpoint;
  const double dt_s = seconds(s.swarm_time - p.swarm_time);
  const double truly_s = seconds(last.at - before.at);
  if (dt_s < 0.0)
    report(Finding::Kind::kSafety, now, "swarm time",
           text("runs backwards by %.3g ms at agent %u", -1e3 * dt_s, s.carrier));
  if (!lies_ && std::abs(dt_s - truly_s) > kSlew * truly_s + kSwarmTimeJump_s) {
    report(Finding::Kind::kSafety, now, "swarm time",
           text("jumps by %.3g ms in %.3g ms at agent %u", 1e3 * (dt_s - truly_s), 1e3 * truly_s, s.carrier));
  }
  // A velocity that changes within the acceleration bound: v1 − v0 <= a dt, and p1 − p0 within a dt² / 2 of v0 dt.
  const double velocity_step = (s.velocity_w_m_s - p.velocity_w_m_s).norm();
  const double position_step = (s.position_w_m - p.position_w_m - truly_s * p.velocity_w_m_s).norm();
  // The setpoints say themselves how fast the velocity changes; only while nobody spoke is there no more than the
  // bound.
  const double said_m_s2 = 1.1 * std::max(s.acceleration_w_m_s2.norm(), p.acceleration_w_m_s2.norm());
  const double bound_m_s2 = truly_s > 0.05
                                ? acceleration_m_s2_
                                : std::min(acceleration_m_s2_, said_m_s2 + 10.0 * truly_s * acceleration_m_s2_);
  const double velocity_bound = bound_m_s2 * truly_s + kRounding;
  const double speed_m_s = std::max(s.velocity_w_m_s.norm(), p.velocity_w_m_s.norm());
  const double position_bound =
      0.5 * bound_m_s2 * truly_s * truly_s + kSlew * truly_s * speed_m_s + kSwarmTimeJump_s * speed_m_s + kRounding;
  const double share = std::max(velocity_step / velocity_bound, position_step / position_bound);
  extremes_.step_of_bound = std::max(extremes_.step_of_bound, share);
  if (share > 1.0) {
    report(Finding::Kind::kSafety, now, "continuity",
           text("agent %u: position steps by %.3g mm (bound %.3g), velocity by %.3g mm/s (bound %.3g), within %.3g ms",
                s.carrier, 1e3 * position_step, 1e3 * position_bound, 1e3 * velocity_step, 1e3 * velocity_bound,
                1e3 * truly_s));
  }
}

/// All agents' clocks at one true time, between their setpoints.
struct Checkers::Moment {
  TrueTime at{};
  std::vector<Duration> clocks;  ///< swarm − true
  double gap_s = 0.0;            ///< longest between two setpoints
};

void Checkers::instant(TrueTime now) {
  check_equilibrium(now);
  disagreement_.reset();
  merging_now_ = false;
  Moment m;
  m.at = now;
  for (const Agent& a : agents_) {
    if (!a.lives || !a.last || !a.before) return;
    m.at = std::min(m.at, a.last->at);
  }
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    const Sample& p = *agents_[i].before;
    const Sample& s = *agents_[i].last;
    m.gap_s = std::max({m.gap_s, seconds(s.at - p.at), seconds(m.at - p.at), seconds(now - s.at)});
    const double x = seconds(m.at - p.at) / seconds(s.at - p.at);
    const double clock_s =
        seconds(p.setpoint.swarm_time.time_since_epoch() - s.setpoint.swarm_time.time_since_epoch() + (s.at - p.at)) *
        (1.0 - x);
    m.clocks.push_back(s.setpoint.swarm_time.time_since_epoch() - s.at.time_since_epoch() + from_seconds(clock_s));
    const protocol::Setpoint& here = s.setpoint;
    const double gap_m = (here.position_w_m - attachments_w_m_[i] - here.cable_length_m * here.direction_w).norm();
    merging_now_ = merging_now_ || gap_m > kMerging_m;
    extremes_.merging += gap_m > kMerging_m ? 1 : 0;
    extremes_.merging_m = std::max(extremes_.merging_m, gap_m);
  }
  constexpr double kHung_s = 0.05;  // somebody sends no setpoints: nobody knows his clock
  if (m.gap_s <= kHung_s) check_clocks(m);
}

void Checkers::check_clocks(const Moment& m) {
  const auto [least, most] = std::minmax_element(m.clocks.begin(), m.clocks.end());
  disagreement_ = *most - *least;
  extremes_.disagreement_s = std::max(extremes_.disagreement_s, seconds(*disagreement_));
  const Agent& early = agents_[static_cast<std::size_t>(least - m.clocks.begin())];
  const Agent& late = agents_[static_cast<std::size_t>(most - m.clocks.begin())];
  if (early.uncertainty == Duration::max() || late.uncertainty == Duration::max() || lies_) return;
  // They claim three standard deviations, which are exceeded now and then.
  Duration claimed = (early.uncertainty + late.uncertainty) * 13 / 10 + std::chrono::microseconds(20);
  const auto settling = [&m](const Agent& a) {
    return m.at < a.term_since + kRecovery || (a.found_anew != TrueTime::min() && m.at < a.found_anew + kRecovery);
  };
  if (std::any_of(agents_.begin(), agents_.end(), settling)) return;
  if (early.term != late.term) claimed += kRecoveryError;
  if (*disagreement_ > claimed) {
    report(Finding::Kind::kSafety, m.at, "clocks",
           text("two agents' swarm times differ by %.4g ms and claim to by %.4g ms at most",
                1e3 * seconds(*disagreement_), 1e3 * seconds(claimed)));
  }
}

void Checkers::check_equilibrium(TrueTime now) {
  const auto share = equilibrium_.residual_share();
  if (!share) return;
  ++extremes_.instants;
  extremes_.residual_share = std::max(extremes_.residual_share, *share);
  extremes_.residual_of_budget = std::max(extremes_.residual_of_budget, *share / budget_share_);
  if (*share > budget_share_) {
    report(Finding::Kind::kSafety, now, "equilibrium",
           text("%.3g of the weight is not held, this flight's faults may cost %.3g", *share, budget_share_));
  }
}

}  // namespace gyre::swarm
