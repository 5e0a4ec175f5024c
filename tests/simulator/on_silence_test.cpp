// How vehicles that hold brake when no more setpoints come, and how they are led again.

#include "simulator/core/on_silence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/core/carrier_follower.hpp"
#include "simulator/core/winch.hpp"

namespace gyre::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kSilent_s = 0.05;
constexpr double kStands_s = kSilent_s + kBraking_s;
static_assert(seconds(kGoesOnAfter) == kSilent_s && kStands_s == 0.25);

/// Where something has to be that goes along x at 1 m/s.
CarrierTarget straight(double t_s) {
  return {Vector3d(t_s, 0.0, 2.0), Vector3d::UnitX(), Vector3d::Zero()};
}

CarrierFollower holding(double lag_s = 0.0) {
  return CarrierFollower(straight(0.0).position_w_m, lag_s, OnSilence::kHolds);
}

/// Sees neither a step in position nor one in velocity: a velocity that changes by no more than braking from 1 m/s.
class Smooth {
 public:
  void see(const CarrierMotion& now, double t_s) {
    if (before_) {
      const double dt_s = t_s - before_s_;
      const Vector3d mean_m_s = 0.5 * (before_->velocity_w_m_s + now.velocity_w_m_s);
      const double most_m_s2 = 1.01 * mechanics::kStepSlopePeak / kBraking_s;
      ASSERT_LT((now.position_w_m - before_->position_w_m - dt_s * mean_m_s).norm(), 1e-3 * dt_s) << t_s;
      ASSERT_LT((now.velocity_w_m_s - before_->velocity_w_m_s).norm(), most_m_s2 * dt_s) << t_s;
    }
    before_ = now;
    before_s_ = t_s;
  }

 private:
  std::optional<CarrierMotion> before_;
  double before_s_ = 0.0;
};

TEST(Holding, BrakesFromAMetrePerSecondWithinTenCentimetres) {
  CarrierFollower follower = holding();
  follower.command(straight(0.0), 0.0, 0.0);
  EXPECT_NEAR(follower.at(kSilent_s).position_w_m.x(), 0.05, 1e-12) << "until then it is led";
  EXPECT_NEAR(follower.at(kSilent_s + 0.5 * kBraking_s).velocity_w_m_s.x(), 0.5, 1e-12);
  EXPECT_NEAR(follower.at(kStands_s).position_w_m.x(), 0.05 + 0.1, 1e-12);
  EXPECT_EQ(follower.at(kStands_s).velocity_w_m_s, Vector3d::Zero());
  EXPECT_EQ(follower.at(3600.0).position_w_m, follower.at(kStands_s).position_w_m);
  EXPECT_EQ(follower.at(3600.0).velocity_w_m_s, Vector3d::Zero());
}

TEST(Holding, OneThatLagsComesToStandWhereItBrakesToOnlyLater) {
  CarrierFollower follower = holding(0.1);
  follower.command(straight(0.0), 0.0, 0.0);
  double x_m = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    follower.tick(0.002 * tick);
    const CarrierMotion motion = follower.at(0.002 * (tick + 1));
    EXPECT_GE(motion.position_w_m.x(), x_m - 1e-12);
    x_m = motion.position_w_m.x();
    if (0.002 * tick < kStands_s) {
      EXPECT_LT(x_m, 0.15 - 1e-3) << "not there yet";
    }
  }
  EXPECT_NEAR(x_m, 0.15, 1e-6);
}

TEST(Holding, OneThatGoesOnDoesNotBrakeSoSoon) {
  CarrierFollower follower(straight(0.0).position_w_m);
  follower.command(straight(0.0), 0.0, 0.0);
  EXPECT_NEAR(follower.at(1.0).velocity_w_m_s.x(), 1.0, 1e-12);
}

TEST(Holding, NeitherBrakingNorBeingLedAgainIsAStep) {
  for (const double again_s : {0.06, 0.15, 0.25, 5.0}) {
    SCOPED_TRACE(again_s);
    CarrierFollower follower = holding();
    follower.command(straight(0.0), 0.0, 0.0);
    // It waits where the others come by again: half a metre behind the place it is called to.
    const double elsewhere_s = again_s - 0.5;
    Smooth smooth;
    int commanded = 0;
    const double end_s = again_s + kCatchUp_s + 0.1;
    for (double t_s = 0.0; t_s < end_s; t_s += 1e-3) {
      if (t_s > again_s + 0.01 * commanded) {
        follower.command(straight(t_s - elsewhere_s), t_s, t_s);
        ++commanded;
      }
      smooth.see(follower.at(t_s), t_s);
      if (::testing::Test::HasFatalFailure()) return;
    }
    EXPECT_LT((follower.at(end_s).position_w_m - straight(end_s - elsewhere_s).position_w_m).norm(), 1e-9)
        << "it has caught up";
  }
}

TEST(Holding, AnAgentThatBeginsWhereItStandsLeavesNoGap) {
  CarrierFollower follower = holding();
  follower.command(straight(0.0), 0.0, 0.0);
  const Vector3d here_w_m = follower.at(4.0).position_w_m;
  for (double since_s = 0.0; since_s < 1.0; since_s += 0.01) {
    CarrierTarget target;
    target.position_w_m = here_w_m + 0.5 * since_s * since_s * Vector3d::UnitY();
    target.velocity_w_m_s = since_s * Vector3d::UnitY();
    target.acceleration_w_m_s2 = Vector3d::UnitY();
    follower.command(target, 4.0 + since_s, 4.0 + since_s);
    ASSERT_LT((follower.at(4.0 + since_s).position_w_m - target.position_w_m).norm(), 1e-12) << since_s;
  }
}

TEST(Holding, StandsAsSoonWhenItFallsSilentWhileItCatchesUp) {
  CarrierFollower follower = holding();
  follower.command(straight(0.0), 0.0, 0.0);
  double last_s = 2.0;
  for (; last_s < 3.0; last_s += 0.01) follower.command(straight(last_s), last_s, last_s);
  last_s -= 0.01;
  ASSERT_GT((straight(last_s).position_w_m - follower.at(last_s).position_w_m).norm(), 0.1) << "it still catches up";
  Smooth smooth;
  for (double t_s = last_s; t_s < last_s + 0.3; t_s += 1e-3) {
    // It is faster than 1 m/s now, by half of a gap of 1.85 m over 3 s and more, and brakes the harder.
    const CarrierMotion motion = follower.at(t_s);
    smooth.see({0.4 * motion.position_w_m, 0.4 * motion.velocity_w_m_s}, t_s);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_LT(follower.at(last_s + kStands_s + 1e-9).velocity_w_m_s.norm(), 1e-12);
  EXPECT_EQ(follower.at(last_s + 0.3).position_w_m, follower.at(last_s + 60.0).position_w_m);
}

TEST(Holding, LateIsNotSilent) {
  CarrierFollower follower = holding();
  for (double t_s = 0.2; t_s < 1.0; t_s += 0.01) {
    follower.command(straight(t_s - 0.15), t_s - 0.15, t_s);
    ASSERT_LT((follower.at(t_s + 0.01).position_w_m - straight(t_s + 0.01).position_w_m).norm(), 1e-12) << t_s;
  }
}

TEST(Holding, TheWinchBrakesAsWell) {
  for (const double lag_s : {0.0, 0.05}) {
    Winch winch(1.0, {lag_s, std::nullopt, std::nullopt, 0.002}, OnSilence::kHolds);
    WinchMotion before;
    // Led up to half a second, ahead of what it lags, so that one that does has got there, too.
    const double last_s = 0.5;
    for (int tick = 0; tick < 650; ++tick) {
      const double t_s = 0.002 * tick;
      if (t_s <= last_s) winch.command({1.0 + 0.4 * (t_s + lag_s), 0.4, 0.0}, t_s, t_s);
      winch.tick(t_s);
      const WinchMotion now = winch.at(t_s);
      if (tick > 250) {
        ASSERT_NEAR(now.length_m, before.length_m + 0.001 * (before.rate_m_s + now.rate_m_s), 1e-5) << t_s;
        ASSERT_LT(std::abs(now.rate_m_s - before.rate_m_s), 1.1 * 0.4 * 0.002 * mechanics::kStepSlopePeak / kBraking_s);
      }
      if (t_s > last_s + kStands_s + 0.002) {
        ASSERT_NEAR(now.rate_m_s, 0.0, 1e-3 + 0.4 * std::exp(-(t_s - last_s - kStands_s) / 0.05)) << t_s;
      }
      before = now;
    }
    EXPECT_NEAR(before.length_m, 1.0 + 0.4 * (0.5 + lag_s + 0.05 + 0.1), 1e-4);
    EXPECT_NEAR(before.rate_m_s, 0.0, 1e-3);
    // And is paid out again without a leap, after a silence that one that goes on would not have slowed down in.
    for (int tick = 650; tick < 2650; ++tick) {
      const double t_s = 0.002 * tick;
      winch.command({2.0, 0.0, 0.0}, t_s, t_s);
      winch.tick(t_s);
      ASSERT_LT(std::abs(winch.at(t_s).length_m - before.length_m), 0.002 * 2.0 * 0.74 / kCatchUp_s) << t_s;
      before = winch.at(t_s);
    }
    EXPECT_NEAR(before.length_m, 2.0, 1e-5);
  }
}

}  // namespace
}  // namespace gyre::simulator
