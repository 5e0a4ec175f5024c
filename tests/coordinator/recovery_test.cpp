// Which plans there are, what a flight remembers, and whether it is the same load.

#include "coordinator/core/recovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "coordinator/core/load_obstacle.hpp"
#include "coordinator/core/plan_book.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using protocol::PlanNumber;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr LocalTime kNow{std::chrono::hours(1)};

/// The same forces without what moves them.
std::vector<mechanics::CarrierSlice> at_rest(std::vector<mechanics::CarrierSlice> slices) {
  for (mechanics::CarrierSlice& slice : slices) slice.incoming.amplitude_n = slice.outgoing.amplitude_n = 0.0;
  return slices;
}

protocol::AgentStatus status(CarrierId carrier, std::uint64_t sequence, std::uint64_t incarnation = 1) {
  protocol::AgentStatus s;
  s.carrier = carrier;
  s.sequence = sequence;
  s.incarnation = incarnation;
  return s;
}

TEST(PlanBook, KnowsAPlanByWhatItIs) {
  const mechanics::Plan plan = mechanics::test::polygon_plan(3);
  const Slices motion = by_carrier(mechanics::slices(plan));
  const Slices rest = by_carrier(at_rest(mechanics::slices(plan)));
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
  EXPECT_TRUE(book.recognise(changed, "motion")) << "worked out on another machine";
  changed.begin()->second.rate_rad_s *= 1.001;
  EXPECT_FALSE(book.recognise(changed, "motion"));
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
  const auto told = book.told(1, numbers);
  ASSERT_EQ(told.size(), protocol::kMaxPlans);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i].number, (PlanNumber{1, i + 1}));
}

protocol::AgentStatus flying(CarrierId carrier, std::uint64_t term, std::uint64_t revision) {
  protocol::AgentStatus s = status(carrier, 1);
  s.term = term;
  s.course.term = term;
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

TEST(Recovery, TheNewestCourseIsThatOfTheNewestTermAndRevision) {
  std::vector<protocol::AgentStatus> swarm{flying(2, 5, 8), flying(1, 5, 7), flying(3, 4, 90)};
  swarm[0].course.transitions = {{{{5, 2}, {}}, {}, seconds(5)}};
  // It heard of a newer coordinator already, and still flies what the former one had told.
  swarm.push_back(flying(4, 6, 91));
  swarm.back().course.term = 4;
  std::sort(swarm.begin(), swarm.end(), [](const auto& a, const auto& b) { return a.carrier < b.carrier; });
  do {
    Recovery recovery;
    for (const protocol::AgentStatus& status : swarm) recovery.take(kNow, status);
    ASSERT_TRUE(recovery.course());
    EXPECT_EQ(recovery.course()->term, 5U);
    EXPECT_EQ(recovery.course()->revision, 8U);
    EXPECT_EQ(recovery.course()->transitions.size(), 1U);
    EXPECT_EQ(recovery.highest_term(), 6U);
  } while (std::next_permutation(swarm.begin(), swarm.end(),
                                 [](const auto& a, const auto& b) { return a.carrier < b.carrier; }));
}

TEST(Recovery, TheLeaseIsThatOfWhoHeardMostOfTheNewestCourse) {
  const SwarmTime base(std::chrono::hours(9));
  const auto holding = [&](CarrierId carrier, std::uint64_t revision, Duration lease) {
    protocol::AgentStatus s = flying(carrier, 5, revision);
    s.course.lease = base + lease;
    return s;
  };
  const std::vector<protocol::AgentStatus> swarm{holding(1, 8, seconds(4)), holding(2, 8, seconds(5)),
                                                 holding(3, 7, seconds(9))};
  for (const auto& order : {std::array<std::size_t, 3>{0, 1, 2}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}}) {
    Recovery recovery;
    for (const std::size_t i : order) recovery.take(kNow, swarm[i]);
    EXPECT_EQ(recovery.course()->lease, base + seconds(5));
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
  recovery.take(protocol::HeldPlans{1, 1, {{{5, 1}, {}}}, {}});
  EXPECT_TRUE(recovery.complete_for(1));
  EXPECT_FALSE(recovery.complete_for(2));
}

TEST(Recovery, RefusesInWordsWhoCarriesAnotherLoad) {
  const mechanics::Plan plan = mechanics::test::polygon_plan(3);
  const Slices ours = by_carrier(mechanics::slices(plan));
  const auto refused = [&](CarrierId carrier, const mechanics::CarrierSlice& slice) -> std::string {
    Recovery recovery;
    recovery.take(protocol::HeldPlans{1, 1, {{{5, 1}, ours.at(1)}}, {}});
    recovery.take(protocol::HeldPlans{carrier, 1, {{{5, 1}, slice}}, {}});
    return recovery.obstacle_to(ours).value_or("");
  };
  const auto with = [&](const std::function<void(mechanics::CarrierSlice&)>& change) {
    mechanics::CarrierSlice slice = ours.at(2);
    change(slice);
    return refused(2, slice);
  };
  EXPECT_EQ(with([](auto& s) { s.rate_rad_s *= 2.0; }), "") << "another motion of the same load";
  EXPECT_EQ(with([](auto& s) { s.incoming.amplitude_n *= 2.0; }), "");
  EXPECT_EQ(with([](auto& s) { s.law = mechanics::LengthLaw::fixed(1.0); }), "");
  EXPECT_EQ(with([](auto& s) { s.attachment_w_m.z() += 1e-5; }),
            "carrier 2 is attached elsewhere than in this mission, or the load hangs elsewhere");
  EXPECT_EQ(with([](auto& s) { s.particular_force_w_n *= 1.00001; }).rfind("carrier 2 holds 6.5", 0), 0U);
  EXPECT_EQ(with([](auto& s) {
              s.cable_stiffness_n_m *= 1.00001;
            }).rfind("carrier 2 flies with cables of another stiffness (", 0),
            0U);
  EXPECT_EQ(with([](auto& s) { s.winch_lag_s += 0.01; }).rfind("carrier 2 flies with another lag", 0), 0U);
  EXPECT_EQ(with([](auto& s) { s.vehicle_lag_s += 0.01; }).rfind("carrier 2 flies with another lag", 0), 0U);
  // Rounding in the last bits is no other load.
  EXPECT_EQ(with([](auto& s) {
              s.attachment_w_m *= 1.0 + 1e-14;
              s.particular_force_w_n *= 1.0 - 1e-14;
              s.cable_stiffness_n_m *= 1.0 + 1e-14;
            }),
            "");
  mechanics::CarrierSlice stranger = ours.at(2);
  stranger.id = 9;
  EXPECT_EQ(refused(9, stranger), "carrier 9 flies there, and is not in this mission");
}

TEST(LoadObstacle, IsEveryDifferenceOfTheLoadAndNoneOfTheMotion) {
  const mechanics::Plan flown = mechanics::test::polygon_plan(4);
  const auto obstacle = [&](const std::function<void(mechanics::Plan&)>& change) {
    mechanics::Plan wanted = flown;
    change(wanted);
    return load_obstacle(flown, wanted).value_or("none");
  };
  const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
  EXPECT_EQ(obstacle([](auto&) {}), "none");
  EXPECT_EQ(obstacle([](auto& p) { p.cycle.rate_rad_s *= 2.0; }), "none");
  EXPECT_EQ(obstacle([](auto& p) { p.carriers[0].law = mechanics::LengthLaw::fixed(2.0); }), "none");
  EXPECT_EQ(obstacle([](auto& p) { std::reverse(p.carriers.begin(), p.carriers.end()); }), "none") << "by id";
  EXPECT_EQ(obstacle([](auto& p) { p.load.mass_kg *= 1.0 + 1e-9; }), "none") << "rounding";
  EXPECT_TRUE(has(obstacle([](auto& p) { p.load.mass_kg *= 1.0 + 1e-5; }), "the load weighs"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.gravity_m_s2 *= 1.0 + 1e-5; }), "the load weighs"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.load.inertia_b_kg_m2(0, 0) *= 1.0 + 1e-4; }), "inertia"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.load.position_w_m.x() += 1e-4; }), "pose"));
  EXPECT_TRUE(has(obstacle([](auto& p) {
                    p.load.orientation_w_b = Eigen::AngleAxisd(1e-3, Eigen::Vector3d::UnitZ()) * p.load.orientation_w_b;
                  }),
                  "pose"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.cable.stiffness_n_m *= 1.0 + 1e-5; }), "stiffness"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.cable.compensate_stretch = !p.cable.compensate_stretch; }), "stretch"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.winch.time_constant_s = 0.01; }), "its winches lag by 0.01 s"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.carriers[1].vehicle.time_constant_s = 0.01; }), "carrier 2 lags by 0.01 s"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.carriers.pop_back(); }), "it has 3 carriers, 4 are flying"));
  EXPECT_TRUE(has(obstacle([](auto& p) { p.carriers[2].id = 9; }), "it has no carrier 3"));
  EXPECT_TRUE(
      has(obstacle([](auto& p) { p.carriers[2].attachment_b_m.x() += 1e-4; }), "carrier 3 is attached elsewhere"));
}

}  // namespace
}  // namespace gyre::coordinator
