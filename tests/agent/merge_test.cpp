// A merge starts where the carrier is, ends on the reference, and asks of the vehicle what it can do.

#include "agent/core/merge.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/angle.hpp"

namespace gyre::agent {
namespace {

constexpr SwarmTime kNow{std::chrono::hours(1)};

double real(double low, double high) {
  return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1'000'001);
}
Eigen::Vector3d vector(double size) {
  return {real(-size, size), real(-size, size), real(-size, size)};
}
Command command(double size_m, double rate) {
  Command c;
  c.position_w_m = {vector(size_m), vector(rate), vector(rate)};
  c.winch_m = {real(0.5, 3.0), real(-rate, rate), real(-rate, rate)};
  return c;
}

/// One command for ever.
Path held(const Command& command) {
  return {[command](SwarmTime) { return command; }, std::nullopt};
}

constexpr double kRate_rad_s = 0.2;
/// A circle, with a cable that becomes longer and shorter on it.
Command circle(SwarmTime at, double radius_m) {
  const double theta = kRate_rad_s * seconds(at - kNow);
  const double c = std::cos(theta), s = std::sin(theta), w = kRate_rad_s;
  return {{radius_m * Eigen::Vector3d(c, s, 0.0), radius_m * w * Eigen::Vector3d(-s, c, 0.0),
           -radius_m * w * w * Eigen::Vector3d(c, s, 0.0)},
          {2.0 + 0.1 * s, 0.1 * w * c, -0.1 * w * w * s}};
}
Path round_and_round(double radius_m) {
  return {[radius_m](SwarmTime at) { return circle(at, radius_m); }, from_seconds(kTwoPi / kRate_rad_s)};
}
/// It is where it should have been `behind` ago, and flies on from there at `pace` of the motion's speed.
Command late(double radius_m, Duration behind, double pace) {
  Command flown = circle(kNow - behind, radius_m);
  flown.position_w_m.first *= pace;
  flown.position_w_m.second *= pace * pace;
  flown.winch_m.first *= pace;
  flown.winch_m.second *= pace * pace;
  return flown;
}
Command standing(double radius_m, Duration behind) {
  return late(radius_m, behind, 0.0);
}

RC_GTEST_PROP(Merge, BeginsWhereTheCarrierIsInValueRateAndAcceleration, ()) {
  const Command flown = command(10.0, 1.0), reference = command(10.0, 1.0);
  Merge merge({real(0.5, 5.0), real(0.5, 5.0), real(0.1, 2.0)});
  merge.begin(kNow, flown, held(reference));
  const Command c = merge.apply(kNow, held(reference));
  RC_ASSERT((c.position_w_m.value - flown.position_w_m.value).norm() < 1e-9);
  RC_ASSERT((c.position_w_m.first - flown.position_w_m.first).norm() < 1e-9);
  RC_ASSERT((c.position_w_m.second - flown.position_w_m.second).norm() < 1e-9);
  RC_ASSERT(std::abs(c.winch_m.value - flown.winch_m.value) < 1e-9);
  RC_ASSERT(std::abs(c.winch_m.first - flown.winch_m.first) < 1e-9);
}

RC_GTEST_PROP(Merge, LandsExactlyAndLeavesHalfOfTheVehicleToThePlan, ()) {
  // The reference stands still here, so all that is asked of the vehicle is asked by the merge.
  const Command flown = command(50.0, 0.5);
  Command reference = command(50.0, 0.0);
  reference.position_w_m.first.setZero();
  reference.position_w_m.second.setZero();
  const MergeLimits limits{real(0.5, 5.0), real(0.5, 5.0), real(0.1, 2.0)};
  Merge merge(limits);
  merge.begin(kNow, flown, held(reference));
  const double began_m_s = flown.position_w_m.first.norm(), began_m_s2 = flown.position_w_m.second.norm();
  constexpr Duration kStep = std::chrono::milliseconds(10);
  Command before = merge.apply(kNow, held(reference));
  SwarmTime t = kNow;
  while (merge.under_way(t)) {
    t += kStep;
    const Command c = merge.apply(t, held(reference));
    RC_ASSERT(c.position_w_m.first.norm() <= 0.5 * limits.speed_m_s + began_m_s + 0.07 * began_m_s2 + 1e-9);
    RC_ASSERT(c.position_w_m.second.norm() <= 0.51 * limits.acceleration_m_s2 + began_m_s2 + 1e-9);
    RC_ASSERT(std::abs(c.winch_m.first) <= 0.5 * limits.winch_rate_m_s + std::abs(flown.winch_m.first) +
                                               0.07 * std::abs(flown.winch_m.second) + 1e-9);
    // Values and rates belong together: the derivative is the derivative.
    const Eigen::Vector3d slope = (c.position_w_m.value - before.position_w_m.value) / seconds(kStep);
    RC_ASSERT((slope - 0.5 * (c.position_w_m.first + before.position_w_m.first)).norm() < 1e-2);
    before = c;
  }
  RC_ASSERT(merge.apply(t, held(reference)).position_w_m.value == reference.position_w_m.value);
  RC_ASSERT(merge.apply(t, held(reference)).winch_m.value == reference.winch_m.value);
  RC_ASSERT((before.position_w_m.value - reference.position_w_m.value).norm() < 1e-9);
}

// Half of the acceleration is the plan's, and gap and rate share the rest. A short way takes as long as its share asks.
TEST(Merge, AShortWayFromRestTakesItsShareOfTheAccelerationAndNoLess) {
  for (const double acceleration_m_s2 : {0.1, 0.5}) {
    const MergeLimits limits{5.0, acceleration_m_s2, 5.0};
    Merge merge(limits);
    Command flown, reference;
    flown.position_w_m.value = {1.0, 0.0, 0.0};
    merge.begin(kNow, flown, held(reference));
    double largest_m_s2 = 0.0;
    for (SwarmTime t = kNow; merge.under_way(t); t += std::chrono::milliseconds(10)) {
      largest_m_s2 = std::max(largest_m_s2, merge.apply(t, held(reference)).position_w_m.second.norm());
    }
    EXPECT_LE(largest_m_s2, 0.25 * acceleration_m_s2 * 1.001);
    EXPECT_GE(largest_m_s2, 0.25 * acceleration_m_s2 * 0.99);
  }
}

TEST(Merge, OfAGapThatGrowsTakesHalfOfTheAccelerationAndNoMore) {
  // Both fade in ten seconds, and ask for most at nearly the same moment.
  Command flown;
  flown.position_w_m.value.x() = 4.33;
  flown.position_w_m.first.x() = 0.633;
  const Path place = held(Command{});
  Merge merge({100.0, 1.0, 1.0});
  merge.begin(kNow, flown, place);
  double most_m_s2 = 0.0;
  for (SwarmTime t = kNow; merge.under_way(t); t += std::chrono::milliseconds(10)) {
    most_m_s2 = std::max(most_m_s2, merge.apply(t, place).position_w_m.second.norm());
  }
  EXPECT_LE(most_m_s2, 0.5);
  EXPECT_GT(most_m_s2, 0.48);
}

TEST(Merge, OfWhoFellBehindOnAMotionStaysOnItsPath) {
  using std::chrono::milliseconds;
  for (const auto behind : {milliseconds(500), milliseconds(3000), milliseconds(10000), milliseconds(-4000)}) {
    for (const double pace : {0.0, 0.5, 1.0}) {
      const Path path = round_and_round(1.0);
      const Command flown = late(1.0, behind, pace);
      Merge merge({2.0, 2.0, 0.5});
      merge.begin(kNow, flown, path);
      Command before = merge.apply(kNow, path);
      EXPECT_LT((before.position_w_m.value - flown.position_w_m.value).norm(), 1e-6);
      EXPECT_LT((before.position_w_m.first - flown.position_w_m.first).norm(), 1e-6);
      EXPECT_LT((before.position_w_m.second - flown.position_w_m.second).norm(), 1e-6);
      SwarmTime t = kNow;
      while (merge.under_way(t)) {
        t += milliseconds(10);
        ASSERT_LT(t, kNow + std::chrono::minutes(1));
        const Command c = merge.apply(t, path);
        EXPECT_NEAR(c.position_w_m.value.norm(), 1.0, 1e-6) << "beside the circle";
        EXPECT_NEAR(c.winch_m.value, 2.0 + 0.1 * c.position_w_m.value.y(), 1e-6) << "a cable for another place";
        const Eigen::Vector3d slope = (c.position_w_m.value - before.position_w_m.value) / 0.01;
        EXPECT_LT((slope - 0.5 * (c.position_w_m.first + before.position_w_m.first)).norm(), 1e-4);
        EXPECT_LT((c.position_w_m.first - before.position_w_m.first).norm(), 0.01 * 2.0);
        before = c;
      }
      EXPECT_EQ(merge.apply(t, path).position_w_m.value, circle(t, 1.0).position_w_m.value);
    }
  }
}

TEST(Merge, OfCarriersThatFellBehindTogetherKeepsThemInStep) {
  // Two vehicles of the same swarm, of different strength, on orbits of different size.
  Merge small({5.0, 5.0, 0.5}), large({2.0, 2.0, 1.0});
  small.begin(kNow, standing(0.3, std::chrono::seconds(3)), round_and_round(0.3));
  large.begin(kNow, standing(1.2, std::chrono::seconds(3)), round_and_round(1.2));
  for (SwarmTime t = kNow; large.under_way(t); t += std::chrono::milliseconds(50)) {
    const Eigen::Vector3d a = small.apply(t, round_and_round(0.3)).position_w_m.value / 0.3;
    const Eigen::Vector3d b = large.apply(t, round_and_round(1.2)).position_w_m.value / 1.2;
    EXPECT_LT((a - b).norm(), 1e-5);
  }
}

TEST(Merge, OfAVehicleThatCannotHurryOrIsBesideItsPathGoesStraight) {
  const Command behind = standing(1.0, std::chrono::seconds(3));
  Command beside = circle(kNow, 1.0);
  beside.position_w_m.value.z() += 0.4;
  beside.position_w_m.first.setZero();
  const auto least_radius_m = [](const MergeLimits& limits, const Command& flown) {
    const Path path = round_and_round(1.0);
    Merge merge(limits);
    merge.begin(kNow, flown, path);
    double least = 1.0;
    for (SwarmTime t = kNow; merge.under_way(t); t += std::chrono::milliseconds(50)) {
      least = std::min(least, merge.apply(t, path).position_w_m.value.norm());
    }
    return least;
  };
  EXPECT_LT(least_radius_m({0.25, 2.0, 0.5}, behind), 0.99) << "a chord, and no arc";
  EXPECT_GT(least_radius_m({2.0, 2.0, 0.5}, beside), 0.97) << "the other side of the circle is no nearer";
}

/// What a vehicle tells of itself: no acceleration.
Command told(Command flown) {
  flown.position_w_m.second.setZero();
  flown.winch_m.second = 0.0;
  return flown;
}

TEST(Merge, WithAVehicleThatFliesItsPathMovesNobodyHoweverOldItsWord) {
  constexpr double kRadius_m = 50.0;  // ten metres a second, and two metres a second squared towards the middle
  for (const Duration on_its_way : {from_seconds(0), from_seconds(0.007), from_seconds(0.02)}) {
    Merge merge({40.0, 40.0, 5.0});
    // It came ten milliseconds ago, and was on its way before that.
    merge.begin_at_vehicle(kNow, from_seconds(0.01), told(late(kRadius_m, from_seconds(0.01) + on_its_way, 1.0)),
                           round_and_round(kRadius_m));
    double off_m = 0.0;
    for (Duration t{}; t < from_seconds(10.0); t += from_seconds(0.02)) {
      const Command asked = merge.apply(kNow + t, round_and_round(kRadius_m));
      off_m = std::max(off_m, (asked.position_w_m.value - circle(kNow + t, kRadius_m).position_w_m.value).norm());
    }
    // Along the path it is found to where the bend of twenty milliseconds, 0.4 mm, leaves it.
    EXPECT_LT(off_m, 1e-3) << seconds(on_its_way);
  }
}

TEST(Merge, WithAVehicleThatStandsBeginsWhereItStands) {
  Merge merge({40.0, 40.0, 5.0});
  const Command there = told(standing(50.0, from_seconds(0.015)));
  merge.begin_at_vehicle(kNow, from_seconds(0.01), there, round_and_round(50.0));
  const Command asked = merge.apply(kNow, round_and_round(50.0));
  EXPECT_LT((asked.position_w_m.value - there.position_w_m.value).norm(), 1e-6) << "it is late by no word";
  EXPECT_LT(asked.position_w_m.first.norm(), 1e-6);
}

TEST(Merge, DoesNothingWhereThereIsNoGap) {
  Command c;
  c.position_w_m.value = {1.0, 2.0, 3.0};
  c.winch_m.value = 1.0;
  Merge merge({});
  merge.begin(kNow, c, held(c));
  EXPECT_FALSE(merge.under_way(kNow));
}

}  // namespace
}  // namespace gyre::agent
