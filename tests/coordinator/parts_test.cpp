// The coordinator's parts, each by itself: who is there, which plans there are, what a flight remembers, how one
// agrees.

#include <gtest/gtest.h>

#include "common/mechanics/orbit_figures.hpp"
#include "common/mechanics/rest_plan.hpp"
#include "coordinator/core/agreement.hpp"
#include "coordinator/core/fleet.hpp"
#include "coordinator/core/plan_book.hpp"
#include "coordinator/core/recovery.hpp"
#include "coordinator/core/rehearsal.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using protocol::PlanNumber;
using protocol::Stage;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr LocalTime kNow{std::chrono::hours(1)};

protocol::AgentStatus status(CarrierId carrier, std::uint64_t sequence, std::uint64_t incarnation = 1) {
  protocol::AgentStatus s;
  s.carrier = carrier;
  s.sequence = sequence;
  s.incarnation = incarnation;
  return s;
}

TEST(Fleet, TellsWhoCameWentAndCameBackAnother) {
  Fleet fleet({1, 2}, milliseconds(450));
  EXPECT_TRUE(fleet.silent(kNow, 1));
  EXPECT_EQ(fleet.take(kNow, status(1, 5)), Fleet::Verdict::kTaken);
  EXPECT_EQ(fleet.take(kNow, status(1, 5)), Fleet::Verdict::kDuplicate);
  EXPECT_EQ(fleet.take(kNow, status(1, 4)), Fleet::Verdict::kLate);
  EXPECT_EQ(fleet.take(kNow, status(3, 1)), Fleet::Verdict::kStranger);
  auto changes = fleet.changes(kNow);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].carrier, 1U);
  EXPECT_FALSE(changes[0].lost);
  EXPECT_TRUE(fleet.changes(kNow + milliseconds(450)).empty());
  changes = fleet.changes(kNow + milliseconds(451));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(changes[0].lost);
  EXPECT_EQ(fleet.take(kNow + seconds(1), status(1, 1, 2)), Fleet::Verdict::kTaken) << "a new life counts from one";
  changes = fleet.changes(kNow + seconds(1));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_TRUE(changes[0].restarted);
  EXPECT_EQ(fleet.missing(kNow + seconds(1), [](const auto&) { return true; }), std::vector<CarrierId>{2});
}

TEST(Fleet, TheDeadConfirmNothing) {
  Fleet fleet({1}, milliseconds(450));
  protocol::AgentStatus former = status(1, 7, 1);
  former.confirmed = 4;
  EXPECT_EQ(fleet.take(kNow, former), Fleet::Verdict::kTaken);
  EXPECT_EQ(fleet.take(kNow, status(1, 1, 2)), Fleet::Verdict::kTaken);
  (void)fleet.changes(kNow);
  ++former.sequence;  // it was on its way for long
  EXPECT_EQ(fleet.take(kNow, former), Fleet::Verdict::kLate);
  EXPECT_EQ(fleet.status(1)->incarnation, 2U);
  EXPECT_EQ(fleet.status(1)->confirmed, 0U);
  EXPECT_TRUE(fleet.changes(kNow).empty());
  EXPECT_EQ(fleet.take(kNow, status(1, 2, 2)), Fleet::Verdict::kTaken);
}

TEST(PlanBook, KnowsAPlanByWhatItIs) {
  const mechanics::Plan plan = mechanics::test::polygon_plan(3);
  const Slices motion = by_carrier(mechanics::slices(plan));
  const Slices rest = by_carrier(mechanics::slices(mechanics::rest_plan(plan)));
  PlanBook book;
  Slices partly = motion;
  partly.erase(partly.begin());
  book.learn({7, 3}, partly);
  EXPECT_FALSE(book.recognise(rest, "rest"));
  EXPECT_EQ(book.recognise(motion, "motion"), (PlanNumber{7, 3}));
  EXPECT_STREQ(book.name({7, 3}), "motion");
  EXPECT_NE(book.slice({7, 3}, motion.begin()->first), nullptr) << "it takes what was not learned";
  Slices changed = motion;
  changed.begin()->second.rate_rad_s = std::nextafter(changed.begin()->second.rate_rad_s, 10.0);
  EXPECT_FALSE(book.recognise(changed, "motion")) << "to the bit";
  EXPECT_EQ(book.add(8, rest, "rest"), (PlanNumber{8, 1}));
  book.keep({{8, 1}});
  EXPECT_EQ(book.slice({7, 3}, 2), nullptr);
  EXPECT_STREQ(book.name({7, 3}), "unknown");
}

TEST(PlanBook, OffersEachPlanOnceAndNoMoreThanAMessageTakes) {
  const Slices motion = by_carrier(mechanics::slices(mechanics::test::polygon_plan(3)));
  PlanBook book;
  std::vector<PlanNumber> numbers;
  for (std::size_t i = 0; i < protocol::kMaxPlans + 3; ++i) numbers.push_back(book.add(1, motion, "motion"));
  numbers.insert(numbers.begin() + 1, numbers[0]);
  const auto offer = book.offer(1, 1, numbers);
  ASSERT_EQ(offer.slices.size(), protocol::kMaxPlans);
  for (std::size_t i = 0; i < offer.slices.size(); ++i) EXPECT_EQ(offer.slices[i].number, (PlanNumber{1, i + 1}));
}

protocol::AgentStatus flying(CarrierId carrier, std::uint64_t term, std::uint64_t revision) {
  protocol::AgentStatus s = status(carrier, 1);
  s.term = term;
  s.course.revision = revision;
  s.course.base.number = {term, 1};
  s.swarm_time = SwarmTime(std::chrono::hours(9));
  return s;
}

TEST(Recovery, KnowsOfNoFlightWhereNobodyFlies) {
  Recovery recovery;
  recovery.take(kNow, status(1, 1));
  EXPECT_FALSE(recovery.course());
  EXPECT_EQ(recovery.highest_term(), 0U);
  EXPECT_TRUE(recovery.complete_for(1));
}

TEST(Recovery, TheNewestCourseWinsWithoutItsProposals) {
  protocol::AgentStatus newest = flying(2, 5, 8);
  newest.confirmed = 17;
  newest.course.transitions = {{3, {{5, 2}, {}}, {}, seconds(5), Stage::kGo},
                               {21, {{5, 3}, {}}, {}, seconds(5), Stage::kProposed}};
  for (const bool newest_first : {true, false}) {
    Recovery recovery;
    if (newest_first) recovery.take(kNow, newest);
    recovery.take(kNow, flying(1, 5, 7));
    recovery.take(kNow, flying(3, 4, 90));
    if (!newest_first) recovery.take(kNow, newest);
    ASSERT_TRUE(recovery.course());
    EXPECT_EQ(recovery.course()->revision, 8U);
    ASSERT_EQ(recovery.course()->transitions.size(), 1U);
    EXPECT_EQ(recovery.course()->transitions[0].id, 3U);
    EXPECT_EQ(recovery.highest_term(), 5U);
    EXPECT_EQ(recovery.last_transition(), 21U) << "no number is used twice";
  }
}

TEST(Recovery, SwarmTimeIsTakenFromWhoProvesMost) {
  Recovery recovery;
  const auto tell = [&](Duration late, Duration error, Duration uncertainty) {
    protocol::AgentStatus s = flying(1, 5, 1);
    s.swarm_time += error;
    s.clock_uncertainty = uncertainty;
    recovery.take(kNow + late, s);
  };
  tell(milliseconds(30), {}, milliseconds(1));
  tell(milliseconds(1), {}, milliseconds(1));
  tell(milliseconds(20), {}, milliseconds(1));
  tell({}, seconds(1), seconds(2));  // far ahead, and knows that it does not know
  const Duration truth = std::chrono::hours(9) - kNow.time_since_epoch();
  EXPECT_EQ(recovery.swarm_offset(), truth - milliseconds(1));
}

TEST(Recovery, IsCompleteWhenEveryPlanOfTheCourseIsHeld) {
  Recovery recovery;
  recovery.take(kNow, flying(1, 5, 1));
  EXPECT_FALSE(recovery.complete_for(1));
  recovery.take(protocol::HeldPlans{1, 1, {{{5, 1}, {}}}});
  EXPECT_TRUE(recovery.complete_for(1));
  EXPECT_FALSE(recovery.complete_for(2));
}

TEST(Recovery, FindsWhoCarriesAnotherLoad) {
  const mechanics::Plan plan = mechanics::test::polygon_plan(3);
  const Slices ours = by_carrier(mechanics::slices(plan));
  const auto stranger_where = [&](CarrierId carrier, mechanics::CarrierSlice slice) {
    Recovery recovery;
    recovery.take(protocol::HeldPlans{1, 1, {{{5, 1}, ours.at(1)}}});
    recovery.take(protocol::HeldPlans{carrier, 1, {{{5, 1}, slice}}});
    return recovery.stranger_to(ours);
  };
  mechanics::CarrierSlice slice = ours.at(2);
  slice.rate_rad_s *= 2.0;
  EXPECT_FALSE(stranger_where(2, slice)) << "another motion of the same load";
  slice.attachment_w_m.z() += 0.1;
  EXPECT_EQ(stranger_where(2, slice), CarrierId{2});
  EXPECT_FALSE(stranger_where(9, slice)) << "nobody of this mission";
}

class Rehearsed : public testing::Test {
 protected:
  Rehearsed() {
    for (std::size_t i = 0; i < motion_.size(); ++i) stacks_.push_back({{&rest_[i], 0, 0, 0}, {&motion_[i], 0, 0, 5}});
  }
  Rehearsal rehearsal(const mechanics::Limits& limits) { return {stacks_, limits}; }
  static int steps(Rehearsal& rehearsal) {
    int steps = 1;
    while (!rehearsal.advance() && steps < 100) ++steps;
    return steps;
  }

  mechanics::Plan plan_ = mechanics::test::polygon_plan(3);
  std::vector<mechanics::CarrierSlice> motion_ = mechanics::slices(plan_);
  std::vector<mechanics::CarrierSlice> rest_ = mechanics::slices(mechanics::rest_plan(plan_));
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

TEST_F(Rehearsed, FindsCarriersThatComeTooClose) {
  mechanics::Limits limits;
  limits.separation_min_m = 1e3;
  Rehearsal bad = rehearsal(limits);
  EXPECT_EQ(steps(bad), 4);
  ASSERT_FALSE(bad.reasons().empty());
  EXPECT_EQ(bad.reasons().front().rule, mechanics::Rule::kSeparation);
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
  intent.to = {1, 2};
  intent.duration = seconds(5);
  const AgreementOptions options;
  Agreement agreement(1, intent, options);
  SwarmTime now{};
  for (int attempt = 1; attempt <= options.attempts; ++attempt) {
    agreement.schedule(now, 3);
    agreement.rehearse(rehearsal({}));
    for (int carrier = 0; carrier < 3; ++carrier) ASSERT_EQ(agreement.step(now, {}), Agreement::Step::kWait);
    const SwarmTime last = agreement.transition().start - options.lead / 2 - options.go_margin;
    EXPECT_EQ(Agreement(agreement).step(last, {}), Agreement::Step::kPropose);
    now = last + Duration(1);
    ASSERT_EQ(agreement.step(now, {}), attempt < options.attempts ? Agreement::Step::kAgain : Agreement::Step::kGiveUp);
  }
  EXPECT_EQ(agreement.transition().duration, seconds(5)) << "a slower one would take as long to rehearse";
  EXPECT_NE(agreement.why().find("too long"), std::string::npos);
}

TEST_F(Rehearsed, AnAgreementTriesSlowerAndThenGivesUp) {
  mechanics::Limits limits;
  limits.speed_max_m_s = 1e-6;
  Intent intent;
  intent.to = {1, 2};
  intent.duration = seconds(5);
  intent.may_slow_down = true;
  const AgreementOptions options;
  Agreement agreement(1, intent, options);
  SwarmTime now{};
  for (int attempt = 1; attempt < options.attempts; ++attempt) {
    agreement.schedule(now, 3);
    ASSERT_TRUE(agreement.needs_rehearsal());
    agreement.rehearse(rehearsal(limits));
    ASSERT_EQ(agreement.step(now, {}), Agreement::Step::kAgain);
    EXPECT_EQ(agreement.transition().duration, seconds(5) * (1 << attempt));
  }
  agreement.schedule(now, 3);
  agreement.rehearse(rehearsal(limits));
  EXPECT_EQ(agreement.step(now, {}), Agreement::Step::kGiveUp);
  EXPECT_NE(agreement.why().find("break a limit"), std::string::npos);
}

TEST(Agreement, GoesWhenAllHaveConfirmedAndGivesUpWhenItIsTooLate) {
  Intent intent;
  intent.to = {1, 2};
  intent.duration = seconds(2);
  intent.rehearsed = false;
  const AgreementOptions options;
  Agreement agreement(1, intent, options);
  agreement.schedule(SwarmTime{}, 4);
  EXPECT_EQ(agreement.step(SwarmTime{}, {}), Agreement::Step::kPropose);
  EXPECT_EQ(agreement.step(SwarmTime{}, {2}), Agreement::Step::kWait);
  Agreement late = agreement;
  EXPECT_EQ(agreement.step(SwarmTime{milliseconds(100)}, {}), Agreement::Step::kGo);
  EXPECT_EQ(agreement.transition().stage, Stage::kGo);
  const SwarmTime last = late.transition().start - options.go_margin;
  EXPECT_EQ(late.step(last, {2}), Agreement::Step::kWait);
  EXPECT_EQ(late.step(last + Duration(1), {2}), Agreement::Step::kGiveUp);
  EXPECT_EQ(late.transition().stage, Stage::kProposed);
}

}  // namespace
}  // namespace gyre::coordinator
