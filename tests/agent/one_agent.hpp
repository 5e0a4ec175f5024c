#pragma once
// One agent on virtual time, told everything a coordinator, a network and a vehicle can tell it.

#include "agent/core/agent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "tests/mechanics/plans.hpp"

namespace gyre::agent {

using protocol::AgentState;
using protocol::Beacon;
using protocol::Course;
using protocol::PlanNumber;
using std::chrono::milliseconds;
using std::chrono::seconds;

inline constexpr std::uint64_t kTerm = 0x10000;
inline constexpr PlanNumber kMotion{kTerm, 1}, kOther{kTerm, 2};
/// The swarm's clock is this far from the agent's.
inline constexpr Duration kOffset = -std::chrono::hours(5);

class AgentTest : public testing::Test {
 protected:
  AgentTest() { restart(1); }

  [[nodiscard]] static std::unique_ptr<Agent> new_agent(std::uint64_t incarnation,
                                                        const mechanics::Limits& vehicle = {}) {
    AgentOptions options;
    options.carrier = 1;
    options.incarnation = incarnation;
    options.address = "here";
    options.vehicle = vehicle;
    return std::make_unique<Agent>(options);
  }
  void restart(std::uint64_t incarnation, const mechanics::Limits& vehicle = {}) {
    agent_ = new_agent(incarnation, vehicle);
  }

  [[nodiscard]] SwarmTime swarm() const { return SwarmTime(now_.time_since_epoch() + kOffset); }

  Outputs tell(const Event& event) {
    Outputs out = agent_->step(now_, event);
    if (stepped_) stepped_(event, out);
    if (out.status) status_ = out.status;
    if (out.held) held_ = out.held;
    if (out.setpoint) setpoint_ = out.setpoint;
    for (const Notice& notice : out.notices) heard_ += notice.text + "\n";
    if (out.question) question_ = out.question;
    if (judges_at_once_) answer();
    return out;
  }
  /// What it waits for; it may ask for more then.
  void answer() {
    if (const auto question = std::exchange(question_, std::nullopt)) tell(judge(*question));
  }

  protocol::TimeReply reply_to(const protocol::TimeRequest& request) {
    const SwarmTime then(request.sent.time_since_epoch() + kOffset + off_);
    return {1, request.incarnation, request.sequence, term_, request.sent, then, then, believed_, rival_};
  }

  /// Lets time pass; a coordinator that `answers` the time requests and beacons.
  void fly(Duration duration, bool answers = true) {
    for (const LocalTime end = now_ + duration; now_ < end; now_ += milliseconds(10)) {
      if (vehicle_) tell(*vehicle_);
      if (answers && course_) beacon();
      const Outputs out = tell(Tick{});
      if (answers && out.time_request) tell(TimeReplyArrived{reply_to(*out.time_request), now_});
      if (visit_ && out.setpoint) visit_(*out.setpoint);
    }
  }

  Outputs beacon() {
    course_->term = term_;  // whoever leads puts his term to all that he says
    return tell(Beacon{term_, ++sequence_, swarm() + off_, *course_, proposal_, {}});
  }

  [[nodiscard]] static protocol::PlanOffer plans(const std::vector<PlanNumber>& numbers, std::uint64_t term = kTerm) {
    static std::uint64_t offers = 0;
    protocol::PlanOffer offer{1, term, ++offers, {}, {}};
    for (const PlanNumber& n : numbers) offer.slices.push_back({n, slice(n)});
    return offer;
  }
  Outputs offer(const std::vector<PlanNumber>& numbers, std::uint64_t term = kTerm) {
    return tell(plans(numbers, term));
  }

  [[nodiscard]] static mechanics::CarrierSlice slice(const PlanNumber& n) {
    mechanics::Plan plan = mechanics::test::polygon_plan(4);
    if (n == kOther) plan.cycle.rate_rad_s *= 1.3;
    return mechanics::slices(plan).front();
  }

  /// A course by this plan, which rests at plan time 0 or moves from there on.
  void course(const PlanNumber& plan, double pace = 0.0) {
    course_ = Course{};
    course_->term = term_;
    course_->revision = 1;
    course_->base = {plan, PlanTime{}};
    course_->pace.ramps = {{swarm(), Duration::zero(), {PlanTime{}, pace, 0.0, 0.0}, pace}};
  }

  /// Holds all plans, with its vehicle in its place, at rest.
  void rest() {
    offer({kMotion, kOther});
    course(kMotion);
    vehicle_at_rest();
    fly(seconds(3));
  }

  /// In full motion, which nobody's vehicle tells anything of.
  void engage() {
    rest();
    vehicle_.reset();
    ramp(milliseconds(200), seconds(2), 1.0);
    fly(seconds(3));
  }

  void vehicle_at_rest() {
    const auto r = mechanics::evaluate(slice(kMotion), 0.0);
    vehicle_ = protocol::CarrierState{};
    vehicle_->carrier = 1;
    vehicle_->position_w_m = r.position_w_m.value;
    vehicle_->tension_n = r.tension_n.value;
    vehicle_->winch_length_m = vehicle_->cable_length_m = r.length_m.value;
    if (const double k = slice(kMotion).cable_stiffness_n_m; k > 0.0) vehicle_->winch_length_m -= r.tension_n.value / k;
  }

  // What the coordinator does to the course.
  [[nodiscard]] Course next() const {
    Course next = *course_;
    protocol::settle(next, swarm());
    ++next.revision;
    return next;
  }
  [[nodiscard]] Course with_ramp(Duration in, Duration duration, double pace) const {
    Course with = next();
    with.pace = with.pace.with_ramp(swarm() + in, duration, pace);
    return with;
  }
  [[nodiscard]] Course with_transition(const PlanNumber& to, Duration in, Duration duration) const {
    Course with = next();
    const PlanTime from = with.moment(swarm() + in).at;
    with.transitions.push_back({{to, from}, from, duration});
    return with;
  }
  void ramp(Duration in, Duration duration, double pace) { course_ = with_ramp(in, duration, pace); }
  void transition(const PlanNumber& to, Duration in, Duration duration) { course_ = with_transition(to, in, duration); }

  /// From now on, no setpoint may be further from the last than its own rates explain.
  void watch_for_steps() {
    visit_ = [this, last = setpoint_, then = now_ - milliseconds(10)](const protocol::Setpoint& s) mutable {
      if (last) {
        // By the vehicle's clock where swarm time was found anew: it flies on by its own.
        const double local_s = gyre::seconds(now_ - then);
        const double swarm_s = gyre::seconds(s.swarm_time - last->swarm_time);
        const double dt = std::abs(swarm_s - local_s) < 1e-3 ? swarm_s : local_s;
        const Eigen::Vector3d mean = 0.5 * (s.velocity_w_m_s + last->velocity_w_m_s);
        EXPECT_LT((s.position_w_m - last->position_w_m - dt * mean).norm(), 1e-4);
        EXPECT_LT((s.velocity_w_m_s - last->velocity_w_m_s).norm(), 0.1);
        EXPECT_LT(
            std::abs(s.winch_length_m - last->winch_length_m - 0.5 * dt * (s.winch_rate_m_s + last->winch_rate_m_s)),
            1e-4);
        EXPECT_GT(dt, 0.0);
      }
      last = s;
      then = now_;
    };
  }

  /// What the plan at the bottom of the course has for the last setpoint's moment, at full pace.
  [[nodiscard]] mechanics::Reference planned() const {
    Course settled = *course_;
    protocol::settle(settled, setpoint_->swarm_time);
    EXPECT_TRUE(settled.transitions.empty()) << "there is more than one plan";
    return mechanics::evaluate(slice(settled.base.number),
                               gyre::seconds(settled.moment(setpoint_->swarm_time).at - settled.base.epoch));
  }
  [[nodiscard]] double off_the_plan_m() const {
    return (setpoint_->position_w_m - planned().position_w_m.value).norm();
  }

  std::uint64_t term_ = kTerm;
  Duration off_{};              ///< the coordinator's swarm time
  std::uint64_t believed_ = 0;  ///< whom it takes for this carrier's agent; 0: whoever asks
  std::string rival_;
  LocalTime now_{-std::chrono::hours(1)};  // below zero: nothing may depend on where a clock begins
  std::unique_ptr<Agent> agent_;
  std::optional<Course> course_;
  std::optional<Course> proposal_;
  std::optional<protocol::CarrierState> vehicle_;
  std::optional<protocol::AgentStatus> status_;
  std::optional<protocol::HeldPlans> held_;
  std::optional<protocol::Setpoint> setpoint_;
  bool judges_at_once_ = true;
  std::optional<PlanQuestion> question_;  ///< that was not answered yet
  std::function<void(const protocol::Setpoint&)> visit_;
  std::function<void(const Event&, const Outputs&)> stepped_;
  std::string heard_;
  std::uint64_t sequence_ = 0;
};

}  // namespace gyre::agent
