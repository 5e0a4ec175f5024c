// A laboratory's push: of the impulse that was asked for, when it was asked for, no stronger than the weight; and what
// the load does under it.

#include "simulator/core/push.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/protocol/disturbance.hpp"
#include "simulator/core/simulator.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr LocalTime kStart(std::chrono::hours(5));
constexpr Duration kTick = milliseconds(2);
constexpr double kWeight_n = 0.3 * 9.81;  // the paper's load

/// What a push gives in all, tick by tick; and the first and the last tick it gives anything in.
struct Given {
  Eigen::Vector3d impulse_n_s = Eigen::Vector3d::Zero();
  std::optional<LocalTime> first, last;
};
Given given(Push& push, LocalTime from, Duration over) {
  Given out;
  for (LocalTime at = from; at < from + over; at += kTick) {
    push.tick(at);
    if (push.force_w_n().isZero(0.0)) continue;
    out.impulse_n_s += gyre::seconds(kTick) * push.force_w_n();
    if (!out.first) out.first = at;
    out.last = at;
  }
  return out;
}

TEST(Push, HasTheImpulseThatWasAskedForWhateverTheTicksAre) {
  const Eigen::Vector3d force(0.3, -0.4, 1.2);
  for (const Duration duration : {Duration(microseconds(1)), Duration(microseconds(900)), Duration(microseconds(2900)),
                                  Duration(milliseconds(200)), Duration(microseconds(333'333))}) {
    Push push(kWeight_n, kTick);
    push.begin(kStart + microseconds(100), force, duration);
    const Given all = given(push, kStart, seconds(1));
    EXPECT_LT((all.impulse_n_s - gyre::seconds(duration) * force).norm(), 1e-12);
    EXPECT_EQ(all.first, kStart + kTick) << "the first tick not before it arrived";
    EXPECT_LE(gyre::seconds(*all.last + kTick - *all.first - duration), gyre::seconds(kTick));
  }
}

TEST(Push, ANewOneTakesThePlaceOfTheOneBefore) {
  Push push(kWeight_n, kTick);
  push.begin(kStart, {1.0, 0.0, 0.0}, seconds(5));
  EXPECT_EQ(given(push, kStart, milliseconds(10)).impulse_n_s.x(), 0.01);
  push.begin(kStart + milliseconds(10), {0.0, 1.0, 0.0}, milliseconds(4));
  const Given rest = given(push, kStart + milliseconds(10), seconds(6));
  EXPECT_EQ(rest.impulse_n_s.x(), 0.0);
  EXPECT_NEAR(rest.impulse_n_s.y(), 0.004, 1e-15);
}

TEST(Push, IsRefusedBeyondTheWeightAndBeyondTheTime) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Push push(kWeight_n, kTick);
  EXPECT_FALSE(push.objection({0.0, 0.0, kWeight_n}, protocol::kLongestPush));
  for (const double wrong : {1.01 * kWeight_n, -1.01 * kWeight_n, kNan, kInfinity}) {
    const auto why = push.objection({0.0, wrong, 0.0}, seconds(1));
    ASSERT_TRUE(why) << wrong;
    EXPECT_NE(why->find("weighs 2.943 N"), std::string::npos) << *why;
  }
  for (const Duration wrong : {Duration{}, Duration(-1), protocol::kLongestPush + Duration(1), Duration::max()}) {
    EXPECT_TRUE(push.objection({1.0, 0.0, 0.0}, wrong));
  }
}

class PushedLoad : public testing::Test {
 protected:
  PushedLoad() {
    auto made = Simulator::create(plan_, {}, kStart);
    EXPECT_TRUE(made.ok());
    simulator_.emplace(std::move(made).value());
  }
  void advance_to(Duration at) {
    while (simulator_->simulated() + kTick <= at) {
      const Duration next = std::min(at, simulator_->simulated() + kPublicationPeriod);
      EXPECT_FALSE(simulator_->step(kStart + next, Advance{}).failure);
      furthest_m_ = std::max(furthest_m_, away().norm());
    }
  }
  [[nodiscard]] Eigen::Vector3d away() const { return simulator_->load().position_w_m - plan_.load.position_w_m; }

  mechanics::Plan plan_ = rigs::paper();
  std::optional<Simulator> simulator_;
  double furthest_m_ = 0.0;
};

// Short against the load's swing, across its cables: nothing but inertia answers, and m dv = F dt.
TEST_F(PushedLoad, IsGivenTheImpulseByAShortPush) {
  advance_to(seconds(1));
  const Eigen::Vector3d force(0.1 * kWeight_n, 0.0, 0.0);
  const Outputs out = simulator_->step(kStart + seconds(1), Pushed{force, milliseconds(2)});
  ASSERT_EQ(out.notices.size(), 1U);
  EXPECT_EQ(out.notices.front().text, "laboratory: the load is pushed by (0.2943, 0, 0) N for 0.002 s");
  advance_to(seconds(1) + milliseconds(2));
  const double speed_m_s = simulator_->load().velocity_w_m_s.x();
  // Its cables hang at an angle, and damp: the load gives way to them within the push, so that a part is theirs.
  EXPECT_GT(speed_m_s, 0.0);
  EXPECT_LT(speed_m_s, 0.2943 * 0.002 / 0.3 * 1.0001);
}

// On one cable, across it, there is nothing else that could take the impulse.
TEST(Push, MovesAFreeLoadByItsImpulse) {
  const Anchor anchor = rigs::anchor_at({0.0, 0.0, 50.0}, 50.0 - 2.0 * 9.81 / 1e4);
  Push push(2.0 * 9.81, kTick);
  push.begin(kStart, {4.0, 0.0, 0.0}, milliseconds(20));
  LoadIntegrator integrator(LoadDynamics(rigs::bob({1e4, 1e3})), {}, 0.0, [&](double /*t_s*/, Surroundings& out) {
    out.anchors = {anchor};
    out.force_w_n = push.force_w_n();
  });
  for (int tick = 0; tick < 20; ++tick) {
    push.tick(kStart + tick * kTick);
    EXPECT_FALSE(integrator.advance_to(gyre::seconds((tick + 1) * kTick)));
  }
  // m v = F T; a pendulum of 50 m has done 1.6e-4 of that by 40 ms: (ω t)² / 2 with ω² = g / l.
  EXPECT_NEAR(integrator.motion().velocity_w_m_s.x(), 4.0 * 0.02 / 2.0, 0.04 * 2e-4);
  // x = ½ a T² + a T (t − T)
  EXPECT_NEAR(integrator.motion().position_w_m.x(), 0.5 * 2.0 * 4e-4 + 0.04 * 0.02, 1.2e-3 * 2e-4);
}

TEST_F(PushedLoad, MovesAndStaysBoundedByATenthOfItsWeight) {
  advance_to(seconds(1));
  EXPECT_LT(furthest_m_, 1e-6);
  (void)simulator_->step(kStart + seconds(1), Pushed{{0.1 * kWeight_n, 0.0, 0.0}, milliseconds(200)});
  advance_to(seconds(11));
  EXPECT_GT(furthest_m_, 1e-3);
  EXPECT_LT(furthest_m_, 0.1);
  EXPECT_EQ(simulator_->dropped().nonsense, 0U);
}

TEST_F(PushedLoad, IsHeldInTheEndWhereTheForceAndTheCablesBalance) {
  // Down, where it does not swing: the cables stretch by F / Σ k (n · z)².
  (void)simulator_->step(kStart, Pushed{{0.0, 0.0, -kWeight_n}, seconds(10)});
  advance_to(seconds(9));
  EXPECT_LT(away().z(), 0.0);
  EXPECT_GT(away().z(), -0.01);
  advance_to(seconds(30));
  EXPECT_GT(away().z(), -0.01);
}

// Upwards by all of its weight its cables go slack.
TEST_F(PushedLoad, SurvivesTheStrongestPushAnyWay) {
  Duration at{};
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0)}) {
    (void)simulator_->step(kStart + at, Pushed{kWeight_n * way, protocol::kLongestPush});
    at += seconds(15);
    advance_to(at);
  }
  EXPECT_TRUE(away().allFinite());
  EXPECT_LT(furthest_m_, 10.0);
}

TEST_F(PushedLoad, WhatIsRefusedIsCountedAndMovesNothing) {
  const Outputs out = simulator_->step(kStart, Pushed{{2.0 * kWeight_n, 0.0, 0.0}, seconds(1)});
  ASSERT_TRUE(out.dropped);
  EXPECT_EQ(out.dropped->counts.nonsense, 1U);
  EXPECT_NE(out.dropped->latest.find("weighs"), std::string::npos);
  EXPECT_TRUE(out.notices.empty());
  advance_to(seconds(2));
  EXPECT_LT(furthest_m_, 1e-6);
  EXPECT_EQ(simulator_->dropped().nonsense, 1U);
}

}  // namespace
}  // namespace gyre::simulator
