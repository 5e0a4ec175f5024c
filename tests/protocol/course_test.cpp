// A course is read the same way by everybody, settling it changes nothing that is flown, and at the end of the lease
// all stop on one profile.

#include "common/protocol/course.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/protocol/liveness.hpp"
#include "paces.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::protocol {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::constant_pace;
using test::random_axis;
using test::random_duration;

constexpr SwarmTime kNow{std::chrono::hours(1)};
/// What the plan clock shows at kNow: nobody may take one clock for the other.
constexpr PlanTime kThen{std::chrono::minutes(7)};
constexpr PlanNumber kMotion{1, 1}, kOther{1, 2}, kThird{1, 3};

Transition to(const PlanNumber& plan, Duration start, Duration duration) {
  return {{plan, kThen + start}, kThen + start, duration};
}

class CourseTest : public testing::Test {
 protected:
  CourseTest() {
    const mechanics::Plan plan = mechanics::test::polygon_plan(3);
    for (const double factor : {1.0, 1.5, 0.7}) {
      mechanics::Plan other = plan;
      other.cycle.rate_rad_s *= factor;
      slices_.push_back(mechanics::slices(other)[0]);
    }
    course_.pace = constant_pace(1.0, kNow, kThen);
    course_.base = {kMotion, kThen - seconds(100)};
  }
  [[nodiscard]] std::vector<mechanics::TimedLayer> read(const Course& course, PlanTime origin) const {
    return layers(course, origin, [this](const PlanNumber& n) {
      return n.term == 1 && n.revision <= slices_.size() ? &slices_[n.revision - 1] : nullptr;
    });
  }
  [[nodiscard]] Eigen::Vector3d position(const Course& course, SwarmTime t) const {
    const auto stack = read(course, course.moment(t).at);
    return mechanics::evaluate_course(stack.data(), stack.size(), 0.0).position_w_m.value;
  }

  std::vector<mechanics::CarrierSlice> slices_;
  Course course_;
};

TEST_F(CourseTest, IsReadWholeOrNotAtAll) {
  course_.transitions = {to(kOther, {}, seconds(5)), to({9, 9}, {}, seconds(5))};
  EXPECT_TRUE(read(course_, kThen).empty());
  course_.base.number = {9, 9};
  course_.transitions.clear();
  EXPECT_TRUE(read(course_, kThen).empty());
}

TEST_F(CourseTest, LayersAreSecondsOfPlanTimeFromTheOrigin) {
  course_.transitions = {to(kOther, seconds(3), seconds(5))};
  course_.transitions[0].to.epoch -= seconds(1);
  course_.pace = constant_pace(0.25, kNow, kThen);
  const auto stack = read(course_, kThen - seconds(1));
  ASSERT_EQ(stack.size(), 2U);
  EXPECT_EQ(stack[0].slice, &slices_[0]);
  EXPECT_EQ(stack[0].epoch_s, -99.0);
  EXPECT_EQ(stack[1].slice, &slices_[1]);
  EXPECT_EQ(stack[1].epoch_s, 3.0);
  EXPECT_EQ(stack[1].start_s, 4.0);
  EXPECT_EQ(stack[1].duration_s, 5.0);
}

TEST_F(CourseTest, NamesEveryPlanItReliesOnFromTheBottomUp) {
  course_.transitions = {to(kThird, {}, seconds(5)), to(kOther, {}, seconds(5))};
  EXPECT_EQ(plans_of(course_), (std::vector<PlanNumber>{kMotion, kThird, kOther}));
}

TEST_F(CourseTest, SettlingChangesNothingThatIsFlown) {
  course_.transitions = {to(kOther, {}, seconds(6)), to(kMotion, seconds(2), seconds(2)),
                         to(kThird, seconds(3), seconds(4))};
  course_.pace = course_.pace.with_ramp(kNow + seconds(1), seconds(2), 0.3)
                     .with_ramp(kNow + seconds(2), seconds(3), 1.0)
                     .with_ramp(kNow + seconds(11), seconds(2), 0.0);
  Course settled = course_;
  int completed = 0;
  for (Duration t{}; t < seconds(20); t += milliseconds(50)) {
    completed += settle(settled, kNow + t) ? 1 : 0;
    // Of plan time a nanosecond may be rounded.
    EXPECT_LT((position(settled, kNow + t) - position(course_, kNow + t)).norm(), 1e-8) << gyre::seconds(t);
  }
  EXPECT_EQ(completed, 2) << "the second before the third, and both with what lay below";
  EXPECT_EQ(settled.base, (TimedPlan{kThird, kThen + seconds(3)}));
  EXPECT_TRUE(settled.transitions.empty());
  EXPECT_EQ(settled.pace.ramps.size(), 1U);
}

TEST_F(CourseTest, ACompleteUpperTransitionTakesTheLowerOnesWithIt) {
  course_.transitions = {to(kOther, {}, seconds(60)), to(kThird, seconds(1), seconds(2)),
                         to(kMotion, seconds(20), seconds(2))};
  EXPECT_FALSE(settle(course_, kNow + seconds(3) - Duration(1)));
  EXPECT_TRUE(settle(course_, kNow + seconds(3)));
  EXPECT_EQ(course_.base.number, kThird);
  ASSERT_EQ(course_.transitions.size(), 1U);
  EXPECT_EQ(course_.transitions[0], to(kMotion, seconds(20), seconds(2))) << "what is above it stays";
  EXPECT_FALSE(settle(course_, kNow + seconds(4)));
}

TEST_F(CourseTest, ATransitionStandsStillWithThePhase) {
  course_.transitions = {to(kOther, seconds(-2), seconds(4))};
  course_.pace = constant_pace(0.0, kNow, kThen);
  EXPECT_FALSE(settle(course_, kNow + std::chrono::hours(5)));
  EXPECT_EQ(position(course_, kNow), position(course_, kNow + std::chrono::hours(5)));
  course_.pace = constant_pace(0.5, kNow, kThen);
  EXPECT_FALSE(settle(course_, kNow + seconds(4) - Duration(2)));
  EXPECT_TRUE(settle(course_, kNow + seconds(4)));
}

TEST_F(CourseTest, WhatTheLeasesEndStopsShortOfIsNotComplete) {
  course_.lease = kNow + seconds(1);
  course_.transitions = {to(kOther, {}, seconds(2) + Duration(1))};  // where all stop, but for a nanosecond
  EXPECT_FALSE(settle(course_, kNow + std::chrono::minutes(1)));
  course_.transitions = {to(kOther, {}, seconds(2))};
  EXPECT_TRUE(settle(course_, kNow + std::chrono::minutes(1)));
}

TEST_F(CourseTest, WithoutALeaseItFliesOnForEver) {
  EXPECT_EQ(course_.flown_pace(kNow + std::chrono::hours(9000)), course_.pace);
  EXPECT_EQ(course_.moment(kNow + std::chrono::hours(9000)).at, kThen + std::chrono::hours(9000));
}

TEST_F(CourseTest, RunsAtItsPaceUntilTheLeaseEndsAndNotAMomentLonger) {
  course_.lease = kNow + seconds(3);
  EXPECT_EQ(course_.flown_pace(*course_.lease), course_.pace);
  EXPECT_EQ(course_.moment(*course_.lease).at, kThen + seconds(3));
  EXPECT_FALSE(course_.rests(*course_.lease));
  const SwarmTime stopped = *course_.lease + course_.stopping;
  EXPECT_FALSE(course_.rests(stopped - Duration(1)));
  EXPECT_TRUE(course_.rests(stopped));
  EXPECT_EQ(course_.moment(stopped).at, course_.moment(stopped + std::chrono::hours(1)).at);
  // From full pace it takes half as much plan time as swarm time to stop.
  EXPECT_EQ(course_.moment(stopped).at, kThen + seconds(3) + course_.stopping / 2);
}

TEST_F(CourseTest, AtRestTheLeasesEndIsNoStop) {
  course_.pace = constant_pace(0.0, kNow, kThen);
  course_.lease = kNow + seconds(3);
  for (const Duration t : {Duration(seconds(3)), Duration(seconds(3)) + Duration(1), Duration(seconds(4))}) {
    EXPECT_TRUE(course_.rests(kNow + t)) << gyre::seconds(t);
    EXPECT_EQ(course_.flown_pace(kNow + t), course_.pace) << gyre::seconds(t);
  }
  // One that is about to start does not, any more.
  course_.pace = course_.pace.with_ramp(kNow + seconds(4), seconds(2), 1.0);
  EXPECT_FALSE(course_.rests(*course_.lease));
  EXPECT_EQ(course_.moment(kNow + seconds(20)).at, kThen);
}

TEST_F(CourseTest, ASecondsLongerLeaseIsFlownASecondLonger) {
  course_.lease = kNow + seconds(3);
  Course longer = course_;
  longer.lease = *course_.lease + seconds(1);
  const SwarmTime later = kNow + std::chrono::minutes(1);
  EXPECT_EQ(longer.moment(later).at - course_.moment(later).at, seconds(1));
}

// Whoever hears the stop and whoever sees the lease end fly the same.
RC_GTEST_PROP(Lease, a_stop_at_its_end_is_the_same_whether_told_as_lease_or_as_ramp, ()) {
  Course leased;
  leased.pace = random_axis(3);
  leased.lease = test::kAxisBegin + random_duration(0.0, 30.0);
  leased.stopping = random_duration(0.5, 6.0);
  Course told = leased;
  told.pace = leased.pace.with_ramp(*leased.lease, leased.stopping, 0.0);
  told.lease.reset();
  // One has settled on the way, as agents do, and forgot nothing that it may need.
  Course settling = leased;
  for (int i = 0; i < 5; ++i) (void)settle(settling, test::kAxisBegin + i * seconds(10));
  for (int i = 0; i < 40; ++i) {
    const SwarmTime t = *leased.lease + Duration(i == 0 ? 0 : 1) + (i < 2 ? Duration{} : random_duration(0.0, 40.0));
    const PlanMoment a = told.moment(t);
    const PlanMoment b = leased.moment(t);
    RC_ASSERT(a.at == b.at);
    RC_ASSERT(std::abs(a.pace - b.pace) < 1e-12);
    RC_ASSERT(std::abs(a.rate_1_s - b.rate_1_s) < 1e-12);
    RC_ASSERT(std::abs(a.curvature_1_s2 - b.curvature_1_s2) < 1e-11);
    const PlanMoment c = settling.moment(t);
    RC_ASSERT(std::abs((a.at - c.at).count()) <= 1);
    RC_ASSERT(std::abs(a.pace - c.pace) < 1e-12);
  }
  RC_ASSERT(leased.rests(*leased.lease + leased.stopping));
}

// A lease that has ended may still grow, when a word comes late: what was to be flown beyond it is still there.
RC_GTEST_PROP(Lease, settling_beyond_its_end_forgets_nothing_that_a_longer_one_needs, ()) {
  Course course;
  course.pace = random_axis(3);
  course.lease = test::kAxisBegin + random_duration(0.0, 10.0);
  Course settled = course;
  (void)settle(settled, *course.lease + random_duration(0.0, 60.0));
  course.lease = settled.lease = *course.lease + random_duration(0.0, 20.0);
  for (int i = 0; i < 40; ++i) {
    const SwarmTime t = *course.lease + random_duration(0.0, 30.0);
    RC_ASSERT(std::abs((course.moment(t).at - settled.moment(t).at).count()) <= 1);
  }
}

TEST_F(CourseTest, IsTheSameMotionWhoeverWishedItUnderWhateverNumber) {
  course_.transitions = {to(kOther, {}, seconds(6))};
  course_.lease = kNow;
  const auto still_same = [this](const auto& change) {
    Course other = course_;
    change(other);
    EXPECT_FALSE(other == course_);
    return same_motion(other, course_);
  };
  EXPECT_TRUE(course_ == course_ && same_motion(course_, course_));
  EXPECT_TRUE(still_same([](Course& c) { ++c.term; }));
  EXPECT_TRUE(still_same([](Course& c) { ++c.revision; }));
  EXPECT_TRUE(still_same([](Course& c) { c.wish.pace = 0.5; }));
  EXPECT_TRUE(still_same([](Course& c) { c.wish.rest_when_changed = true; }));
  EXPECT_TRUE(still_same([](Course& c) { c.wish.by = Wisher::kPerson; }));
  EXPECT_TRUE(still_same([](Course& c) { c.lease.reset(); }));
  EXPECT_TRUE(still_same([](Course& c) { *c.lease += Duration(1); }));
  EXPECT_TRUE(still_same([](Course& c) { c.stopping += Duration(1); }));
  EXPECT_FALSE(still_same([](Course& c) { c.pace.ramps[0].target = 0.5; }));
  EXPECT_FALSE(still_same([](Course& c) { c.base.number = kThird; }));
  EXPECT_FALSE(still_same([](Course& c) { c.base.epoch += Duration(1); }));
  EXPECT_FALSE(still_same([](Course& c) { c.transitions.clear(); }));
  EXPECT_FALSE(still_same([](Course& c) { c.transitions[0].to.number = kThird; }));
  EXPECT_FALSE(still_same([](Course& c) { c.transitions[0].to.epoch += Duration(1); }));
  EXPECT_FALSE(still_same([](Course& c) { c.transitions[0].start += Duration(1); }));
  EXPECT_FALSE(still_same([](Course& c) { c.transitions[0].duration += Duration(1); }));
}

TEST(Course, IsNewerByTermFirstThenByRevision) {
  const auto numbered = [](std::uint64_t term, std::uint64_t revision) {
    Course course;
    course.term = term;
    course.revision = revision;
    return course;
  };
  EXPECT_TRUE(numbered(2, 1).newer_than(numbered(1, 9)));
  EXPECT_FALSE(numbered(1, 9).newer_than(numbered(2, 1)));
  EXPECT_TRUE(numbered(1, 2).newer_than(numbered(1, 1)));
  EXPECT_FALSE(numbered(1, 1).newer_than(numbered(1, 1)));
}

TEST(Course, AsItIsMadeItIsNoneAndRestsWishedByNobody) {
  const Course course;
  EXPECT_TRUE(course.none());
  EXPECT_TRUE(course.rests(kNow));
  EXPECT_EQ(course.wish, (Wish{0.0, false, Wisher::kNobody}));
}

TEST(Liveness, NeverHeardIsSilentAndTheTimeoutItselfIsNot) {
  constexpr LocalTime begin{-std::chrono::hours(1)};
  Liveness liveness(milliseconds(500));
  EXPECT_TRUE(liveness.silent(begin));
  EXPECT_FALSE(liveness.ever_heard());
  liveness.heard(begin);
  EXPECT_FALSE(liveness.silent(begin + milliseconds(500)));
  EXPECT_TRUE(liveness.silent(begin + milliseconds(500) + Duration(1)));
  EXPECT_TRUE(liveness.ever_heard());
}

}  // namespace
}  // namespace gyre::protocol
