// A merge starts where the carrier is, ends on the reference, and asks of the vehicle what it can do.

#include "agent/core/merge.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace gyre::agent {
namespace {

using mechanics::Taylor;
using mechanics::TaylorVector;

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

RC_GTEST_PROP(Merge, BeginsWhereTheCarrierIsInValueRateAndAcceleration, ()) {
  const Command flown = command(10.0, 1.0), reference = command(10.0, 1.0);
  Merge merge({real(0.5, 5.0), real(0.5, 5.0), real(0.1, 2.0)});
  merge.begin(kNow, flown, reference);
  const Command c = merge.apply(kNow, reference);
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
  merge.begin(kNow, flown, reference);
  const double began_m_s = flown.position_w_m.first.norm(), began_m_s2 = flown.position_w_m.second.norm();
  constexpr Duration kStep = std::chrono::milliseconds(10);
  Command before = merge.apply(kNow, reference);
  SwarmTime t = kNow;
  while (merge.under_way(t)) {
    t += kStep;
    const Command c = merge.apply(t, reference);
    RC_ASSERT(c.position_w_m.first.norm() <= 0.5 * limits.speed_m_s + began_m_s + 0.07 * began_m_s2 + 1e-9);
    RC_ASSERT(c.position_w_m.second.norm() <= 0.51 * limits.acceleration_m_s2 + began_m_s2 + 1e-9);
    RC_ASSERT(std::abs(c.winch_m.first) <= 0.5 * limits.winch_rate_m_s + std::abs(flown.winch_m.first) +
                                               0.07 * std::abs(flown.winch_m.second) + 1e-9);
    // Values and rates belong together: the derivative is the derivative.
    const Eigen::Vector3d slope = (c.position_w_m.value - before.position_w_m.value) / seconds(kStep);
    RC_ASSERT((slope - 0.5 * (c.position_w_m.first + before.position_w_m.first)).norm() < 1e-2);
    before = c;
  }
  RC_ASSERT(merge.apply(t, reference).position_w_m.value == reference.position_w_m.value);
  RC_ASSERT(merge.apply(t, reference).winch_m.value == reference.winch_m.value);
  RC_ASSERT((before.position_w_m.value - reference.position_w_m.value).norm() < 1e-9);
}

TEST(Merge, DoesNothingWhereThereIsNoGap) {
  Command c;
  c.position_w_m.value = {1.0, 2.0, 3.0};
  c.winch_m.value = 1.0;
  Merge merge({});
  merge.begin(kNow, c, c);
  EXPECT_FALSE(merge.under_way(kNow));
}

}  // namespace
}  // namespace gyre::agent
