// What is kept of a long recording: every extreme, every gap, and no more memory than a picture needs.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/base/angle.hpp"
#include "ground/plot/core/polyline.hpp"
#include "ground/report/core/envelope.hpp"
#include "ground/report/core/time_axis.hpp"
#include "ground/report/core/trace.hpp"

namespace gyre::ground {
namespace {

using mechanics::Range;

Range figures_of(const std::vector<std::vector<Point>>& pieces) {
  Range out;
  for (const auto& piece : pieces) {
    for (const Point& point : piece) out.include(point.y);
  }
  return out;
}

struct Told {
  Envelope envelope;
  Range figures;
};

/// Times that go on by 10 ms, or by what is drawn.
Told told(const std::vector<int>& figures, const std::vector<int>& steps_ms) {
  Told out;
  double t_s = 0.0;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    t_s += steps_ms.empty() ? 0.01 : std::abs(steps_ms[k % steps_ms.size()] % 400) * 1e-3;
    out.envelope.add(t_s, figures[k]);
    out.figures.include(figures[k]);
  }
  return out;
}

RC_GTEST_PROP(Envelope, NoExtremeIsEverLostHoweverItIsDrawn, (std::vector<int> figures, std::vector<int> steps_ms)) {
  RC_PRE(!figures.empty());
  const Told all = told(figures, steps_ms);
  for (const double width_s : {0.0, 0.1, 7.0}) {
    const Range drawn = figures_of(all.envelope.pieces(width_s));
    RC_ASSERT(drawn.min == all.figures.min);
    RC_ASSERT(drawn.max == all.figures.max);
  }
}

TEST(Envelope, HoursTakeNoMoreRoomThanAPictureAndTheirSpikesStay) {
  Envelope envelope;
  constexpr int kSamples = 1'000'000;  // nearly three hours
  for (int k = 0; k < kSamples; ++k) {
    const double spike = k == 123'456 ? 5.0 : k == 765'432 ? -7.0 : 0.0;
    envelope.add(k * 0.01, std::sin(k * 0.003) + spike);
  }
  EXPECT_LE(envelope.columns(), Envelope::kMostColumns);
  EXPECT_GT(envelope.columns(), Envelope::kMostColumns / 4);
  const auto pieces = envelope.pieces(20.0);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_LE(pieces.front().size(), 4U * 501U);
  bool high = false, low = false;
  for (const Point& point : pieces.front()) {
    high = high || (point.y > 3.9 && std::abs(point.x - 1234.56) < 1e-6);
    low = low || (point.y < -5.9 && std::abs(point.x - 7654.32) < 1e-6);
  }
  EXPECT_TRUE(high) << "a spike is drawn, at its time";
  EXPECT_TRUE(low) << "a spike is drawn, at its time";
}

TEST(Envelope, NoLineIsDrawnAcrossASilence) {
  Envelope envelope;
  for (int k = 0; k < 100; ++k) envelope.add(k * 0.01, 1.0);
  for (int k = 0; k < 100; ++k) envelope.add(3.0 + k * 0.01, 2.0);
  const auto pieces = envelope.pieces(0.05);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].back().x, 0.99, 1e-9);
  EXPECT_NEAR(pieces[1].front().x, 3.0, 1e-9);
}

TEST(Envelope, TimeNeverRunsBackInALine) {
  const Told all = told({3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8, 9, 7}, {3, 0, 12});
  for (const auto& piece : all.envelope.pieces(0.02)) {
    for (std::size_t k = 1; k < piece.size(); ++k) EXPECT_LE(piece[k - 1].x, piece[k].x);
  }
}

Eigen::Vector3d on_circle(double angle) {
  return {std::cos(angle), std::sin(angle), 0.5};
}

TEST(Trace, AHundredRoundsTakeTheRoomOfOne) {
  Trace once, often;
  for (int k = 0; k <= 5000; ++k) once.add(on_circle(k * kTwoPi / 5000));
  for (int k = 0; k <= 500'000; ++k) often.add(on_circle(k * kTwoPi / 5000));
  EXPECT_LE(often.steps(), Trace::kMostSteps);
  std::size_t points = 0;
  for (const auto& stroke : often.strokes()) points += stroke.size();
  EXPECT_LE(points, 2 * Trace::kMostSteps) << "a step has two ends";
  EXPECT_EQ(often.cell_m(), once.cell_m());
  EXPECT_LE(often.steps(), once.steps() + once.steps() / 100) << "what rounding moves into the next cell";
}

TEST(Trace, EverywhereItWasIsDrawnAndNowhereElse) {
  Trace trace;
  for (int k = 0; k <= 20'000; ++k) trace.add(on_circle(k * kTwoPi / 7000));
  ASSERT_FALSE(trace.strokes().empty());
  const double near_m = std::sqrt(3.0) * trace.cell_m() + kTwoPi / 7000;
  for (const auto& stroke : trace.strokes()) {
    for (const Eigen::Vector3d& place : stroke) EXPECT_NEAR(place.head<2>().norm(), 1.0, 1e-12);
    for (std::size_t k = 1; k < stroke.size(); ++k) EXPECT_LT((stroke[k] - stroke[k - 1]).norm(), 2.0 * near_m);
  }
  for (int k = 0; k < 100; ++k) {
    double nearest_m = 1.0;
    for (const auto& stroke : trace.strokes()) {
      for (const Eigen::Vector3d& place : stroke)
        nearest_m = std::min(nearest_m, (place - on_circle(k * kTwoPi / 100)).norm());
    }
    EXPECT_LT(nearest_m, near_m) << k;
  }
  EXPECT_NEAR(trace.extent()[0].span(), 2.0, 1e-6);
}

TEST(Trace, WhatIsNotKnownIsNotDrawn) {
  Trace trace;
  trace.add({0.0, 0.0, 0.0});
  trace.add({0.01, 0.0, 0.0});
  trace.interrupt();
  trace.add({1.0, 0.0, 0.0});
  trace.add({1.01, 0.0, 0.0});
  ASSERT_EQ(trace.strokes().size(), 2U);
  EXPECT_EQ(trace.strokes()[1].front().x(), 1.0);
}

LocalTime local(double time_s) {
  return LocalTime(from_seconds(time_s));
}
SwarmTime swarm(double time_s) {
  return SwarmTime(from_seconds(time_s));
}

TEST(TimeAxis, CountsSwarmTimeFromTheFirstMessageOn) {
  TimeAxis axis;
  EXPECT_EQ(axis.at(local(100.0)), 0.0);
  axis.see(local(101.0), swarm(7.0));
  EXPECT_NEAR(axis.at(local(101.5)), 1.5, 1e-9);
  // The recorder's clock runs a thousandth too fast.
  for (int k = 1; k <= 1000; ++k) axis.see(local(101.0 + k * 1.001), swarm(7.0 + k));
  EXPECT_NEAR(axis.at(local(101.0 + 1001.0)), 1.0 + 1000.0, 1e-6);
  EXPECT_EQ(axis.leaps(), 0U);
}

TEST(TimeAxis, GoesOnWhereSwarmTimeLeapsAndNeverBack) {
  TimeAxis axis;
  axis.see(local(0.0), swarm(500.0));
  EXPECT_NEAR(axis.at(local(10.0)), 10.0, 1e-9);
  axis.see(local(10.0), swarm(3.0));
  EXPECT_EQ(axis.leaps(), 1U);
  EXPECT_NEAR(axis.at(local(11.0)), 11.0, 1e-9);
  EXPECT_NEAR(axis.at(local(4.0)), 11.0, 1e-9);
}

RC_GTEST_PROP(Simplified, IsNeverFurtherOffThanAllowed, (std::vector<std::pair<int, int>> places)) {
  std::vector<Point> points;
  for (const auto& [x, y] : places) points.push_back({1.0 * (x % 100), 1.0 * (y % 100)});
  constexpr double kTolerance = 3.0;
  const std::vector<Point> fewer = simplified(points, kTolerance);
  RC_ASSERT(fewer.size() <= points.size());
  for (const Point& p : points) {
    double nearest = fewer.size() == 1 ? std::hypot(p.x - fewer[0].x, p.y - fewer[0].y) : 1e9;
    for (std::size_t k = 1; k < fewer.size(); ++k) {
      const Point a = fewer[k - 1], way{fewer[k].x - a.x, fewer[k].y - a.y};
      const double length2 = way.x * way.x + way.y * way.y;
      const double along =
          length2 > 0.0 ? std::clamp(((p.x - a.x) * way.x + (p.y - a.y) * way.y) / length2, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, std::hypot(p.x - a.x - along * way.x, p.y - a.y - along * way.y));
    }
    RC_ASSERT(nearest <= kTolerance + 1e-9);
  }
}

}  // namespace
}  // namespace gyre::ground
