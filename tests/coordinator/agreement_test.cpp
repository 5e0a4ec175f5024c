// How one change is rehearsed and agreed.

#include "coordinator/core/agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/mechanics/orbit_figures.hpp"
#include "coordinator/core/rehearsal.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using protocol::PlanNumber;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// The same forces without what moves them.
std::vector<mechanics::CarrierSlice> at_rest(std::vector<mechanics::CarrierSlice> slices) {
  for (mechanics::CarrierSlice& slice : slices) slice.incoming.amplitude_n = slice.outgoing.amplitude_n = 0.0;
  return slices;
}

class Rehearsed : public testing::Test {
 protected:
  Rehearsed() {
    for (std::size_t i = 0; i < motion_.size(); ++i) stacks_.push_back({{&rest_[i], 0, 0, 0}, {&motion_[i], 0, 0, 5}});
  }
  Rehearsal rehearsal(const mechanics::Limits& limits) {
    mechanics::Plan plan = plan_;
    plan.limits = limits;
    return {stacks_, plan};
  }
  static int steps(Rehearsal& rehearsal) {
    int steps = 1;
    while (!rehearsal.advance() && steps < 100) ++steps;
    return steps;
  }

  mechanics::Plan plan_ = mechanics::test::polygon_plan(3);
  std::vector<mechanics::CarrierSlice> motion_ = mechanics::slices(plan_);
  std::vector<mechanics::CarrierSlice> rest_ = at_rest(mechanics::slices(plan_));
  std::vector<std::vector<mechanics::TimedLayer>> stacks_;
};

TEST_F(Rehearsed, GoesOneCarrierAtATimeAndThenApart) {
  Rehearsal good = rehearsal({});
  EXPECT_EQ(steps(good), 4);
  EXPECT_TRUE(good.reasons().empty());
}

TEST_F(Rehearsed, StopsAtTheFirstCarrierThatBreaksALimit) {
  mechanics::Limits limits;
  limits.speed_max_m_s = 1e-6;
  Rehearsal bad = rehearsal(limits);
  EXPECT_EQ(steps(bad), 1);
  ASSERT_FALSE(bad.reasons().empty());
  EXPECT_EQ(bad.reasons().front().rule, mechanics::Rule::kSpeed);
}

TEST_F(Rehearsed, FindsAWinchOrAVehicleThatCannotFlyIt) {
  mechanics::Plan slow = plan_;
  slow.winch.rate_max_m_s = 1e-6;
  mechanics::Plan weak = plan_;
  for (mechanics::Carrier& c : weak.carriers) c.vehicle = {0.0, 1.0, 9.81, std::nullopt};  // it lifts itself alone
  for (const auto& [plan, rule] :
       {std::pair(slow, mechanics::Rule::kWinch), std::pair(weak, mechanics::Rule::kThrust)}) {
    Rehearsal bad(stacks_, plan);
    EXPECT_EQ(steps(bad), 1);
    ASSERT_EQ(bad.reasons().size(), 1U);
    EXPECT_EQ(bad.reasons().front().rule, rule);
  }
}

TEST_F(Rehearsed, FindsCarriersThatComeTooClose) {
  mechanics::Limits limits;
  limits.separation_min_m = 1e3;
  Rehearsal bad = rehearsal(limits);
  EXPECT_EQ(steps(bad), 4);
  ASSERT_FALSE(bad.reasons().empty());
  EXPECT_EQ(bad.reasons().front().rule, mechanics::Rule::kSeparation);
}

TEST_F(Rehearsed, FindsWhatWouldTouch) {
  mechanics::Limits limits;
  limits.clearance_min_m = 0.1;
  Rehearsal good = rehearsal(limits);
  EXPECT_EQ(steps(good), 4);
  EXPECT_TRUE(good.reasons().empty());

  limits.clearance_min_m = 1e3;
  Rehearsal near = rehearsal(limits);
  EXPECT_EQ(steps(near), 4);
  ASSERT_FALSE(near.reasons().empty());
  EXPECT_EQ(near.reasons().front().rule, mechanics::Rule::kClearance);

  plan_.carriers[1].radius_m = 10.0;
  Rehearsal big = rehearsal({});
  EXPECT_EQ(steps(big), 4);
  ASSERT_FALSE(big.reasons().empty());
  EXPECT_NE(big.reasons().front().text.find("touch"), std::string::npos) << big.reasons().front().text;
  plan_.carriers[1].radius_m = 0.0;

  plan_.load.hull_b_m = mechanics::box_hull({1.0, 1.0, 4.0}, Eigen::Vector3d::Zero());  // higher than the carriers fly
  Rehearsal tall = rehearsal({});
  EXPECT_EQ(steps(tall), 4);
  EXPECT_FALSE(tall.reasons().empty());
}

TEST_F(Rehearsed, ALimitThatBreaksOnlyTowardsTheEndIsFound) {
  for (auto& stack : stacks_) stack.back().duration_s = 30.0;  // slow: the motion itself is what is fastest
  mechanics::Limits limits;
  limits.speed_max_m_s = 0.9 * mechanics::orbit_figures(motion_.front()).speed_m_s.max;
  Rehearsal late = rehearsal(limits);
  EXPECT_EQ(steps(late), 1);
  ASSERT_FALSE(late.reasons().empty());
  EXPECT_EQ(late.reasons().front().rule, mechanics::Rule::kSpeed);
}

TEST_F(Rehearsed, WhatIsStillUnderWayIsPartOfIt) {
  // Half-way into the motion it is turned back to rest, where it came from.
  std::vector<std::vector<Eigen::Vector3d>> places;
  for (std::size_t i = 0; i < stacks_.size(); ++i) {
    stacks_[i].back().start_s = -3.0;
    stacks_[i].push_back({&rest_[i], 0.0, 0.0, 5.0});
    places.emplace_back();
    mechanics::test::sample(0.0, 5.0, 500, [&](double t_s) {
      const auto& stack = stacks_[i];
      places.back().push_back(mechanics::evaluate_course(stack.data(), stack.size(), t_s).position_w_m.value);
    });
  }
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < places[0].size(); ++k) {
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)}) {
      least_m = std::min(least_m, (places[a][k] - places[b][k]).norm());
    }
  }
  const double at_rest_m = (places[0].back() - places[1].back()).norm();
  ASSERT_LT(least_m, at_rest_m - 0.1);
  mechanics::Limits limits;
  limits.separation_min_m = 0.5 * (least_m + at_rest_m);
  Rehearsal close = rehearsal(limits);
  EXPECT_EQ(steps(close), 4);
  EXPECT_FALSE(close.reasons().empty());

  limits = {};
  limits.speed_max_m_s = 0.1 * mechanics::orbit_figures(motion_.front()).speed_m_s.max;
  Rehearsal fast = rehearsal(limits);
  EXPECT_EQ(steps(fast), 1);
  EXPECT_FALSE(fast.reasons().empty());
}

TEST_F(Rehearsed, AnAgreementWhoseLeadIsUsedUpIsRehearsedAgainForALaterStart) {
  Intent intent;
  intent.plan = PlanNumber{1, 2};
  intent.duration = seconds(5);
  const AgreementOptions options;
  Agreement agreement(intent, options);
  SwarmTime now{};
  for (int attempt = 1; attempt <= options.attempts; ++attempt) {
    agreement.schedule(now, 3);
    agreement.rehearse(rehearsal({}));
    for (int carrier = 0; carrier < 3; ++carrier) ASSERT_EQ(agreement.step(now, {}), Agreement::Step::kWait);
    const SwarmTime last = agreement.start() - options.lead / 2 - options.go_margin;
    Agreement in_time(agreement);
    EXPECT_EQ(in_time.step(last, {}), Agreement::Step::kWait);
    EXPECT_TRUE(in_time.proposed());
    now = last + Duration(1);
    ASSERT_EQ(agreement.step(now, {}), attempt < options.attempts ? Agreement::Step::kAgain : Agreement::Step::kGiveUp);
  }
  EXPECT_EQ(agreement.duration(), seconds(5)) << "a slower one would take as long to rehearse";
  EXPECT_NE(agreement.why().find("too long"), std::string::npos);
}

TEST_F(Rehearsed, AnAgreementTriesSlowerAndThenGivesUp) {
  mechanics::Limits limits;
  limits.speed_max_m_s = 1e-6;
  Intent intent;
  intent.plan = PlanNumber{1, 2};
  intent.duration = seconds(5);
  intent.may_slow_down = true;
  const AgreementOptions options;
  Agreement agreement(intent, options);
  SwarmTime now{};
  for (int attempt = 1; attempt < options.attempts; ++attempt) {
    agreement.schedule(now, 3);
    ASSERT_TRUE(agreement.needs_rehearsal());
    agreement.rehearse(rehearsal(limits));
    ASSERT_EQ(agreement.step(now, {}), Agreement::Step::kAgain);
    EXPECT_EQ(agreement.duration(), seconds(5) * (1 << attempt));
  }
  agreement.schedule(now, 3);
  agreement.rehearse(rehearsal(limits));
  EXPECT_EQ(agreement.step(now, {}), Agreement::Step::kGiveUp);
  EXPECT_NE(agreement.why().find("break a limit"), std::string::npos);
}

TEST(Agreement, GoesWhenAllHaveConfirmedAndGivesUpWhenItIsTooLate) {
  Intent intent;
  intent.wish.pace = 1.0;
  intent.duration = seconds(2);
  const AgreementOptions options;
  Agreement agreement(intent, options);
  agreement.schedule(SwarmTime{}, 4);
  EXPECT_EQ(agreement.start(), SwarmTime{options.lead}) << "a ramp is not rehearsed";
  EXPECT_FALSE(agreement.needs_rehearsal());
  EXPECT_EQ(agreement.step(SwarmTime{}, {}), Agreement::Step::kWait);
  EXPECT_TRUE(agreement.proposed());
  EXPECT_EQ(agreement.step(SwarmTime{}, {2}), Agreement::Step::kWait);
  Agreement late = agreement;
  EXPECT_EQ(agreement.step(SwarmTime{milliseconds(100)}, {}), Agreement::Step::kGo);
  const SwarmTime last = late.start() - options.go_margin;
  EXPECT_EQ(late.step(last, {2}), Agreement::Step::kWait);
  Agreement hung = late;
  EXPECT_EQ(hung.step(last + seconds(3), {}), Agreement::Step::kGiveUp) << "its start is long past";
  EXPECT_EQ(late.step(last + Duration(1), {2}), Agreement::Step::kGiveUp);
  EXPECT_EQ(late.why(), "not confirmed in time by carrier 2");
}

}  // namespace
}  // namespace gyre::coordinator
