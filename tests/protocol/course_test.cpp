// A course is read the same way by everybody, and settling it changes nothing that is flown.

#include "common/protocol/course.hpp"

#include <gtest/gtest.h>

#include "common/mechanics/rest_plan.hpp"
#include "common/protocol/liveness.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::protocol {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr SwarmTime kNow{std::chrono::hours(1)};
constexpr PlanNumber kRest{1, 1}, kMotion{1, 2}, kOther{1, 3};

Transition to(std::uint64_t id, const PlanNumber& plan, Duration start, Duration duration, Stage stage = Stage::kGo) {
  return {id, {plan, kNow + start}, kNow + start, duration, stage};
}

class CourseTest : public testing::Test {
 protected:
  CourseTest() {
    const mechanics::Plan plan = mechanics::test::polygon_plan(3);
    mechanics::Plan other = plan;
    other.cycle.rate_rad_s *= 1.5;
    slices_ = {mechanics::slices(mechanics::rest_plan(plan))[0], mechanics::slices(plan)[0],
               mechanics::slices(other)[0]};
    course_.base = {kRest, kNow - seconds(100)};
  }
  [[nodiscard]] std::vector<mechanics::TimedLayer> read(const Course& course, SwarmTime origin) const {
    return layers(course, origin, [this](const PlanNumber& n) {
      return n.term == 1 && n.revision <= slices_.size() ? &slices_[n.revision - 1] : nullptr;
    });
  }
  [[nodiscard]] Eigen::Vector3d position(const Course& course, SwarmTime t) const {
    const auto stack = read(course, t);
    return mechanics::evaluate_course(stack.data(), stack.size(), 0.0).position_w_m.value;
  }

  std::vector<mechanics::CarrierSlice> slices_;
  Course course_;
};

TEST_F(CourseTest, ProposalsAreNamedButNotFlown) {
  course_.transitions = {to(1, kMotion, seconds(1), seconds(5), Stage::kProposed)};
  EXPECT_EQ(read(course_, kNow).size(), 1U);
  EXPECT_EQ(plans_of(course_), (std::vector<PlanNumber>{kRest, kMotion}));
  EXPECT_FALSE(in_transition(course_, kNow + seconds(2)));
  EXPECT_FALSE(settle(course_, kNow + seconds(60)));
}

TEST_F(CourseTest, IsReadWholeOrNotAtAll) {
  course_.transitions = {to(1, kMotion, {}, seconds(5)), to(2, {9, 9}, {}, seconds(5))};
  EXPECT_TRUE(read(course_, kNow).empty());
  course_.base.number = {9, 9};
  course_.transitions.clear();
  EXPECT_TRUE(read(course_, kNow).empty());
}

TEST_F(CourseTest, LayersAreSecondsFromTheOrigin) {
  course_.transitions = {to(1, kMotion, seconds(3), seconds(5))};
  const auto stack = read(course_, kNow - seconds(1));
  ASSERT_EQ(stack.size(), 2U);
  EXPECT_EQ(stack[0].epoch_s, -99.0);
  EXPECT_EQ(stack[1].epoch_s, 4.0);
  EXPECT_EQ(stack[1].start_s, 4.0);
  EXPECT_EQ(stack[1].duration_s, 5.0);
}

TEST_F(CourseTest, IsInTransitionFromTheStartToBeforeTheEnd) {
  course_.transitions = {to(1, kMotion, seconds(1), seconds(2))};
  EXPECT_FALSE(in_transition(course_, kNow + seconds(1) - Duration(1)));
  EXPECT_TRUE(in_transition(course_, kNow + seconds(1)));
  EXPECT_TRUE(in_transition(course_, kNow + seconds(3) - Duration(1)));
  EXPECT_FALSE(in_transition(course_, kNow + seconds(3)));
}

TEST_F(CourseTest, SettlingChangesNothingThatIsFlown) {
  course_.transitions = {to(1, kMotion, {}, seconds(6)), to(2, kRest, seconds(2), seconds(2)),
                         to(3, kOther, seconds(3), seconds(4))};
  Course settled = course_;
  for (Duration t{}; t < seconds(10); t += milliseconds(50)) {
    (void)settle(settled, kNow + t);
    EXPECT_LT((position(settled, kNow + t) - position(course_, kNow + t)).norm(), 1e-12) << gyre::seconds(t);
  }
  EXPECT_EQ(settled.base.number, kOther);
  EXPECT_TRUE(settled.transitions.empty());
}

TEST_F(CourseTest, ACompleteUpperTransitionTakesTheLowerOnesWithIt) {
  course_.transitions = {to(1, kMotion, {}, seconds(60)), to(2, kOther, seconds(1), seconds(2)),
                         to(3, kRest, seconds(20), seconds(2), Stage::kProposed)};
  EXPECT_FALSE(settle(course_, kNow + seconds(3) - Duration(1)));
  EXPECT_TRUE(settle(course_, kNow + seconds(3)));
  EXPECT_EQ(course_.base.number, kOther);
  ASSERT_EQ(course_.transitions.size(), 1U);
  EXPECT_EQ(course_.transitions[0].id, 3U) << "a proposal above it stays";
  EXPECT_FALSE(settle(course_, kNow + seconds(4)));
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
