// How carriers, winches and wind behave on their own.

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/core/carrier_follower.hpp"
#include "simulator/core/extrapolation.hpp"
#include "simulator/core/winch.hpp"
#include "simulator/core/wind.hpp"

namespace gyre::simulator {
namespace {

using Eigen::Vector3d;

TEST(Extrapolation, FollowsTheParabolaUpToTheHorizonAndRestsAfterStopping) {
  const ExtrapolationWeights w = extrapolate(0.4);
  EXPECT_DOUBLE_EQ(w.by_velocity, 0.4);
  EXPECT_DOUBLE_EQ(w.by_acceleration, 0.08);
  const ExtrapolationWeights end = extrapolate(kExtrapolationHorizon_s + kStoppingTime_s);
  EXPECT_NEAR(end.rate_by_velocity, 0.0, 1e-15);
  const ExtrapolationWeights week_later = extrapolate(604800.0);
  EXPECT_DOUBLE_EQ(week_later.by_velocity, end.by_velocity);
  EXPECT_DOUBLE_EQ(week_later.by_acceleration, end.by_acceleration);
}

TEST(Extrapolation, RateIsTheDerivativeAndNeverJumps) {
  const double h = 1e-6;
  ExtrapolationWeights before = extrapolate(0.0);
  for (double t_s = h; t_s < 4.0; t_s += 0.01) {
    const ExtrapolationWeights w = extrapolate(t_s);
    const ExtrapolationWeights after = extrapolate(t_s + h);
    const ExtrapolationWeights earlier = extrapolate(t_s - h);
    EXPECT_NEAR((after.by_velocity - earlier.by_velocity) / (2 * h), w.rate_by_velocity, 1e-6) << t_s;
    EXPECT_NEAR((after.by_acceleration - earlier.by_acceleration) / (2 * h), w.rate_by_acceleration, 1e-6) << t_s;
    EXPECT_LT(std::abs(w.rate_by_velocity - before.rate_by_velocity), 0.02) << t_s;
    before = w;
  }
}

/// Where a carrier on a circle has to be.
CarrierTarget circle(double t_s) {
  const double rate = 0.8;
  const double c = std::cos(rate * t_s);
  const double s = std::sin(rate * t_s);
  return {Vector3d(c, s, 2.0), rate * Vector3d(-s, c, 0.0), -rate * rate * Vector3d(c, s, 0.0)};
}

TEST(CarrierFollower, StaysPutWithoutSetpoints) {
  for (const double lag_s : {0.0, 0.2}) {
    CarrierFollower follower(Vector3d(1, 2, 3), lag_s);
    for (int tick = 0; tick < 100; ++tick) follower.tick(0.002 * tick);
    EXPECT_EQ(follower.at(1000.0).position_w_m, Vector3d(1, 2, 3));
    EXPECT_EQ(follower.at(1000.0).velocity_w_m_s, Vector3d::Zero());
  }
}

TEST(CarrierFollower, ExactOneIsWhereTheSetpointSaysFromItsArrivalOn) {
  CarrierFollower follower(Vector3d::Zero());
  // Arrived 1.5 ms before the tick that takes it up.
  follower.command(circle(5.0), 7.0, 7.0015);
  const CarrierTarget truth = circle(5.0095);
  EXPECT_LT((follower.at(7.0095).position_w_m - truth.position_w_m).norm(), 1e-7);
  EXPECT_LT((follower.at(7.0095).velocity_w_m_s - truth.velocity_w_m_s).norm(), 1e-4);
}

/// Led at 100 Hz by `target`, from 0 until `until_s`; `see(t_s)` at every tick of 2 ms.
template <class Target, class See>
void fly(CarrierFollower& follower, double until_s, Target target, See see) {
  for (int tick = 0; tick * 0.002 < until_s; ++tick) {
    const double t_s = tick * 0.002;
    if (tick % 5 == 0) follower.command(target(t_s), t_s, t_s);
    follower.tick(t_s);
    see(t_s);
  }
}

TEST(CarrierFollower, LaggingOneConvergesExponentially) {
  const double lag_s = 0.2;
  CarrierFollower follower(Vector3d::Zero(), lag_s);
  const auto target = [](double /*t_s*/) {
    return CarrierTarget{Vector3d(1, 0, 0), Vector3d::Zero(), Vector3d::Zero()};
  };
  fly(follower, 2.0, target,
      [&](double t_s) { EXPECT_NEAR(1.0 - follower.at(t_s).position_w_m.x(), std::exp(-t_s / lag_s), 6e-3) << t_s; });
}

TEST(CarrierFollower, LaggingOneIsLateByItsLagAndOnTimeWhereItIsAskedAhead) {
  const double lag_s = 0.05;
  const auto ahead = [lag_s](double t_s) {
    // p + T p' of the circle, and its rate; its acceleration stays that of the circle.
    CarrierTarget c = circle(t_s);
    c.position_w_m += lag_s * c.velocity_w_m_s;
    c.velocity_w_m_s += lag_s * c.acceleration_w_m_s2;
    return c;
  };
  const auto worst = [&](auto target) {
    CarrierFollower follower(circle(0.0).position_w_m, lag_s);
    double worst_m = 0.0;
    fly(follower, 6.0, target, [&](double t_s) {
      if (t_s < 1.0) return;
      worst_m = std::max(worst_m, (follower.at(t_s).position_w_m - circle(t_s).position_w_m).norm());
    });
    return worst_m;
  };
  EXPECT_NEAR(worst(circle), 0.8 * lag_s, 0.01 * 0.8 * lag_s) << "speed times lag";
  EXPECT_LT(worst(ahead), 1e-5);
}

TEST(CarrierFollower, LaggingOneJumpsNeitherInPlaceNorInSpeed) {
  CarrierFollower follower(Vector3d::Zero(), 0.1);
  CarrierMotion before = follower.at(0.0);
  const auto target = [](double t_s) {
    return t_s < 0.05 ? CarrierTarget{Vector3d(1, 0, 0), Vector3d::Zero(), Vector3d::Zero()}
                      : CarrierTarget{Vector3d(-3, 2, 0), Vector3d(1, 0, 0), Vector3d::Zero()};
  };
  fly(follower, 0.5, target, [&](double t_s) {
    EXPECT_LT((follower.at(t_s).position_w_m - before.position_w_m).norm(), 1e-12);
    EXPECT_LT((follower.at(t_s).velocity_w_m_s - before.velocity_w_m_s).norm(), 1e-9);
    before = follower.at(t_s + 0.002);
  });
}

TEST(CarrierFollower, ComesToRestWhenSetpointsStop) {
  CarrierFollower follower(Vector3d::Zero());
  follower.command(circle(0.0), 0.0, 0.0);
  EXPECT_LT(follower.at(3.0).velocity_w_m_s.norm(), 1e-12);
  EXPECT_EQ(follower.at(3.0).position_w_m, follower.at(600.0).position_w_m);
  EXPECT_LT((follower.at(600.0).position_w_m - circle(0.0).position_w_m).norm(), 2.5);
}

/// Led along the circle, not led for `silence_s`, led again; `see(before, after, dt_s)` every millisecond.
template <class See>
CarrierFollower led_again(double silence_s, See see) {
  CarrierFollower follower(circle(0.0).position_w_m);
  follower.command(circle(0.0), 0.0, 0.0);
  const double end_s = silence_s + 2.0 * kCatchUp_s;
  for (double t_s = 0.0; t_s < end_s; t_s += 0.001) {
    const CarrierMotion before = follower.at(t_s);
    if (t_s >= silence_s) follower.command(circle(t_s), t_s, t_s);
    see(before, follower.at(t_s + 0.001), 0.001);
  }
  EXPECT_LT((follower.at(end_s).position_w_m - circle(end_s).position_w_m).norm(), 1e-5) << "it has caught up";
  return follower;
}

TEST(CarrierFollower, CatchesUpWithoutALeapAfterItHadSlowedDown) {
  for (const double silence_s : {1.1, 2.0, 7.0}) {
    led_again(silence_s, [silence_s](const CarrierMotion& before, const CarrierMotion& after, double dt_s) {
      const Vector3d mean = 0.5 * (before.velocity_w_m_s + after.velocity_w_m_s);
      ASSERT_LT((after.position_w_m - before.position_w_m - dt_s * mean).norm(), 1e-5) << silence_s;
      ASSERT_LT((after.velocity_w_m_s - before.velocity_w_m_s).norm(), 0.01) << silence_s;
    });
  }
}

TEST(CarrierFollower, IsCalledBackWithoutALeapWhileItCatchesUp) {
  CarrierFollower follower(circle(0.0).position_w_m);
  follower.command(circle(0.0), 0.0, 0.0);
  CarrierTarget here;
  here.position_w_m = follower.at(5.0).position_w_m;
  CarrierMotion before = follower.at(5.0);
  for (double t_s = 5.0; t_s < 10.0; t_s += 0.001) {
    const bool called_back = t_s >= 5.1;
    follower.command(called_back ? here : circle(t_s), t_s, t_s, called_back ? Hand::kReturns : Hand::kSame);
    const CarrierMotion after = follower.at(t_s);
    ASSERT_LT((after.position_w_m - before.position_w_m).norm(), 1e-3) << t_s;
    before = after;
  }
  EXPECT_LT((before.position_w_m - here.position_w_m).norm(), 1e-9);
}

TEST(CarrierFollower, LeapsWhereSetpointsDoAndNobodyWasSilent) {
  double leap = 0.0;
  led_again(0.9, [&leap](const CarrierMotion& before, const CarrierMotion& after, double /*dt_s*/) {
    leap = std::max(leap, (after.position_w_m - before.position_w_m).norm());
  });
  EXPECT_GT(leap, 0.05) << "an exact carrier is where its setpoints are, and the load feels what they do";
}

TEST(Winch, CatchesUpAsTheCarrierDoes) {
  Winch winch(1.0, {});
  winch.command({1.0, 0.1, 0.0}, 0.0, 0.0);
  double before = winch.at(5.0).length_m;
  for (int tick = 0; tick < 4000; ++tick) {
    const double t_s = 5.0 + 0.001 * tick;
    winch.command({2.0, 0.0, 0.0}, t_s, t_s);
    EXPECT_LT(std::abs(winch.at(t_s).length_m - before), 0.001);
    before = winch.at(t_s).length_m;
  }
  EXPECT_DOUBLE_EQ(before, 2.0);
}

struct WinchRun {
  double worst_error_m = 0.0;
  double fastest_m_s = 0.0;
};

/// Setpoints at 100 Hz for a winch at 500 Hz; figures from `settled_s` on.
template <class Target>
WinchRun run(Winch& winch, Target target, double until_s, double settled_s) {
  WinchRun out;
  for (int tick = 0; tick * 0.002 < until_s; ++tick) {
    const double t_s = tick * 0.002;
    if (tick % 5 == 0) winch.command(target(t_s), t_s, t_s);
    winch.tick(t_s);
    for (const double within_s : {0.0, 0.001, 0.002}) {
      const WinchMotion m = winch.at(t_s + within_s);
      out.fastest_m_s = std::max(out.fastest_m_s, std::abs(m.rate_m_s));
      if (t_s >= settled_s) {
        out.worst_error_m = std::max(out.worst_error_m, std::abs(m.length_m - target(t_s + within_s).length_m));
      }
    }
  }
  return out;
}

WinchTarget swinging(double t_s) {
  return {1.0 + 0.3 * std::sin(t_s), 0.3 * std::cos(t_s), -0.3 * std::sin(t_s)};
}

TEST(Winch, WithoutALagFollowsAMovingLengthWithoutSteadyError) {
  Winch winch(1.0, {0.0, 1.0, std::nullopt, 0.002});
  EXPECT_LT(run(winch, swinging, 10.0, 2.0).worst_error_m, 2e-6);
}

TEST(Winch, IsLateByItsLagAndOnTimeWhereItIsAskedAhead) {
  Winch late(1.0, {0.05, std::nullopt, std::nullopt, 0.002});
  EXPECT_NEAR(run(late, swinging, 10.0, 2.0).worst_error_m, 0.05 * 0.3, 2e-4) << "lag times rate";
  Winch led(1.0, {0.05, std::nullopt, std::nullopt, 0.002});
  double worst_m = 0.0;
  for (int tick = 0; tick < 5000; ++tick) {
    const double t_s = 0.002 * tick;
    const WinchTarget s = swinging(t_s);
    if (tick % 5 == 0) {
      led.command({s.length_m + 0.05 * s.rate_m_s, s.rate_m_s + 0.05 * s.acceleration_m_s2, s.acceleration_m_s2}, t_s,
                  t_s);
    }
    led.tick(t_s);
    if (t_s > 2.0) worst_m = std::max(worst_m, std::abs(led.at(t_s).length_m - s.length_m));
  }
  EXPECT_LT(worst_m, 3e-6);
}

TEST(Winch, AcceleratesNoHarderThanItsLimitAndArrivesAllTheSame) {
  for (const double lag_s : {0.0, 0.2}) {
    Winch winch(1.0, {lag_s, std::nullopt, 0.5, 0.002});
    winch.command({2.0, 0.0, 0.0}, 0.0, 0.0);
    double hardest_m_s2 = 0.0;
    for (int tick = 0; tick < 6000; ++tick) {
      const double t_s = 0.002 * tick;
      const double before_m_s = winch.at(t_s).rate_m_s;
      if (tick % 5 == 0) winch.command({2.0, 0.0, 0.0}, t_s, t_s);
      winch.tick(t_s);
      hardest_m_s2 = std::max(hardest_m_s2, std::abs(winch.at(t_s + 0.002).rate_m_s - before_m_s) / 0.002);
    }
    EXPECT_LE(hardest_m_s2, 0.5 * (1.0 + 1e-9));
    EXPECT_GT(hardest_m_s2, 0.499) << "the limit has to have been felt";
    if (lag_s > 0.0) {
      EXPECT_NEAR(winch.at(12.0).length_m, 2.0, 1e-4);
    }
  }
}

TEST(Winch, ConvergesAtItsTimeConstant) {
  Winch winch(1.0, {0.1, std::nullopt, std::nullopt, 0.002});
  const auto target = [](double /*t_s*/) { return WinchTarget{1.5, 0.0, 0.0}; };
  run(winch, target, 0.3, 1.0);
  EXPECT_NEAR(1.5 - winch.at(0.3).length_m, 0.5 * std::exp(-3.0), 0.003);
}

TEST(Winch, NeverTurnsFasterThanItsLimitAndArrivesAllTheSame) {
  Winch winch(1.0, {0.05, 0.2, std::nullopt, 0.002});
  const auto target = [](double /*t_s*/) { return WinchTarget{2.0, 0.0, 0.0}; };
  const WinchRun figures = run(winch, target, 10.0, 6.0);
  EXPECT_LE(figures.fastest_m_s, 0.2 * (1.0 + 1e-12));
  EXPECT_GT(figures.fastest_m_s, 0.199) << "the limit has to have been felt";
  EXPECT_LT(figures.worst_error_m, 1e-9);
}

TEST(Winch, RateIsContinuous) {
  Winch winch(1.0, {0.05, std::nullopt, std::nullopt, 0.002});
  winch.command({1.2, 0.1, 0.0}, 0.0, 0.0);
  for (int tick = 0; tick < 100; ++tick) {
    const double t_s = 0.002 * tick;
    const WinchMotion before = winch.at(t_s);
    winch.tick(t_s);
    EXPECT_DOUBLE_EQ(winch.at(t_s).rate_m_s, before.rate_m_s);
    EXPECT_DOUBLE_EQ(winch.at(t_s).length_m, before.length_m);
  }
}

TEST(Winch, AShortTimeConstantDoesNotOscillate) {
  Winch winch(1.0, {1e-6, std::nullopt, std::nullopt, 0.002});
  winch.command({1.1, 0.0, 0.0}, 0.0, 0.0);
  double before = 1.0;
  for (int tick = 0; tick < 200; ++tick) {
    winch.tick(0.002 * tick);
    const double length = winch.at(0.002 * (tick + 1)).length_m;
    EXPECT_GE(length, before - 1e-12);
    EXPECT_LE(length, 1.1 + 1e-12);
    before = length;
  }
  EXPECT_NEAR(before, 1.1, 1e-9);
}

TEST(Winch, WithoutLagAndLimitsIsExact) {
  Winch winch(1.0, {});
  winch.command({2.0, 0.5, 0.0}, 1.0, 1.0);
  EXPECT_DOUBLE_EQ(winch.at(1.2).length_m, 2.1);
}

TEST(Wind, RisesFromCalmToItsMean) {
  Wind wind({Vector3d(1, 2, 0), 0.0, 1.0}, 1, 0.002);
  wind.tick(0.0);
  EXPECT_EQ(wind.force_w_n(0.0), Vector3d::Zero());
  wind.tick(kWindRise_s + 1.0);
  EXPECT_EQ(wind.force_w_n(kWindRise_s + 1.0), Vector3d(1, 2, 0));
}

TEST(Wind, GustsHaveTheirDeviationAndTimeScale) {
  const double tick_s = 0.01;
  const double scale_s = 0.5;
  Wind wind({Vector3d::Zero(), 3.0, scale_s}, 42, tick_s);
  std::vector<double> gusts;
  for (int tick = 0; tick < 1000000; ++tick) {
    wind.tick(tick * tick_s);
    gusts.push_back(wind.force_w_n(tick * tick_s).y());
  }
  const std::size_t shift = 50;  // one time scale
  double square = 0.0;
  double product = 0.0;
  for (std::size_t i = shift; i < gusts.size(); ++i) {
    square += gusts[i] * gusts[i];
    product += gusts[i] * gusts[i - shift];
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(gusts.size() - shift)), 3.0, 0.1);
  EXPECT_NEAR(product / square, std::exp(-1.0), 0.03);
}

TEST(Wind, IsContinuousAndTheSameForTheSameSeed) {
  Wind one({Vector3d::Zero(), 1.0, 1.0}, 7, 0.002);
  Wind same({Vector3d::Zero(), 1.0, 1.0}, 7, 0.002);
  Wind other({Vector3d::Zero(), 1.0, 1.0}, 8, 0.002);
  bool differs = false;
  Vector3d end = Vector3d::Zero();
  for (int tick = 0; tick < 1000; ++tick) {
    const double t_s = tick * 0.002;
    one.tick(t_s);
    same.tick(t_s);
    other.tick(t_s);
    EXPECT_LT((one.force_w_n(t_s) - end).norm(), 1e-9);
    end = one.force_w_n(t_s + 0.002);
    EXPECT_EQ(end, same.force_w_n(t_s + 0.002));
    differs = differs || end != other.force_w_n(t_s + 0.002);
  }
  EXPECT_TRUE(differs);
}

TEST(RandomStream, NamesKeepStreamsApart) {
  RandomStream one(1, "wind");
  RandomStream same(1, "wind");
  RandomStream other(1, "loss");
  const std::uint64_t first = one.next();
  EXPECT_EQ(first, same.next());
  EXPECT_NE(first, other.next());
}

}  // namespace
}  // namespace gyre::simulator
