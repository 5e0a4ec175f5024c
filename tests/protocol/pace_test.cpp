// The pace axis against its laws: one smooth motion of plan time, whatever is asked for and when, to the nanosecond.

#include "common/protocol/pace.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "paces.hpp"

namespace gyre::protocol {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the rig of this room
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kTick{1};

/// Plan time is told in whole nanoseconds, out of two parts that are.
constexpr double kRounding_s = 3e-9;

double passed_s(const PlanMoment& from, const PlanMoment& to) {
  return gyre::seconds(to.at - from.at);
}

bool same(const PlanMoment& a, const PlanMoment& b) {
  return a.at == b.at && a.pace == b.pace && a.rate_1_s == b.rate_1_s && a.curvature_1_s2 == b.curvature_1_s2;
}

/// That nothing steps from just before `time` to just after it: it changes by no more than the next derivative can do
/// within the two nanoseconds, which is far less than what is asked for there.
void check_no_step(const Pace& axis, SwarmTime time) {
  const PlanMoment before = axis.at(time - kTick);
  const PlanMoment after = axis.at(time + kTick);
  RC_ASSERT(std::abs(passed_s(before, after) - 2e-9 * before.pace) <= kRounding_s);
  RC_ASSERT(std::abs(after.pace - before.pace) <= 1e-7);
  RC_ASSERT(std::abs(after.rate_1_s - before.rate_1_s) <= 1e-6);
  RC_ASSERT(std::abs(after.curvature_1_s2 - before.curvature_1_s2) <= 1e-5);
}

RC_GTEST_PROP(Pace, its_derivatives_are_the_limit_of_differences, ()) {
  const Pace axis = random_axis(3);
  const SwarmTime t = kAxisBegin + random_duration(-1.0, 30.0);
  // Differences may not look across a ramp's start or end, where pace''' steps.
  const Duration h = milliseconds(2);
  for (const Ramp& ramp : axis.ramps) {
    for (const SwarmTime edge : {ramp.start, ramp.end()}) RC_PRE(edge <= t - 2 * h || edge >= t + 2 * h);
  }
  const PlanMoment now = axis.at(t);
  const auto difference = [&](Duration step, const auto& figure) {
    const auto apart = [&](int steps) { return figure(axis.at(t + steps * step)) - figure(axis.at(t - steps * step)); };
    return (8.0 * apart(1) - apart(2)) / (12.0 * gyre::seconds(step));
  };
  // Plan time is whole nanoseconds, so its differences take a longer step than those of the others, which are not.
  RC_ASSERT(std::abs(difference(h, [&](const PlanMoment& m) { return passed_s(now, m); }) - now.pace) < 4e-6);
  RC_ASSERT(std::abs(difference(h / 4, [](const PlanMoment& m) { return m.pace; }) - now.rate_1_s) < 1e-6);
  RC_ASSERT(std::abs(difference(h / 4, [](const PlanMoment& m) { return m.rate_1_s; }) - now.curvature_1_s2) < 1e-4);
}

RC_GTEST_PROP(Pace, nothing_steps_where_a_ramp_begins_or_ends_also_when_one_overtakes_another, ()) {
  const Pace axis = random_axis(3);
  for (const Ramp& ramp : axis.ramps) {
    if (ramp.duration == Duration::zero()) continue;
    check_no_step(axis, ramp.start);
    check_no_step(axis, ramp.end());
  }
}

RC_GTEST_PROP(Pace, plan_time_passes_as_the_integral_of_the_pace, ()) {
  const Pace axis = random_axis(3);
  const SwarmTime begin = kAxisBegin - seconds(1);
  const Duration span = seconds(31);
  constexpr int kPanels = 15'500;  // 2 ms each: Simpson's rule is exact on cubics
  double sum = 0.0;
  for (int i = 0; i <= kPanels; ++i) {
    const double weight = i == 0 || i == kPanels ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * axis.at(begin + span * i / kPanels).pace;
  }
  const double integral_s = sum * gyre::seconds(span) / (3.0 * kPanels);
  RC_ASSERT(std::abs(passed_s(axis.at(begin), axis.at(begin + span)) - integral_s) < 1e-7);
}

RC_GTEST_PROP(Pace, a_ramp_leads_where_it_is_asked_to_and_leaves_what_was_before_it, ()) {
  const Pace axis = random_axis(whole(0, 3));
  const SwarmTime start = kAxisBegin + random_duration(-5.0, 30.0);  // also at a moment when others are to come
  const Duration duration = random_duration(0.1, 5.0);
  const double target = real(0.0, 1.0);
  const Pace with = axis.with_ramp(start, duration, target);

  RC_ASSERT(with.target() == target);
  RC_ASSERT(with.ramps.back().end() == start + duration);
  RC_ASSERT(with.constant(start + duration));
  RC_ASSERT(!with.constant(start + duration - kTick));
  RC_ASSERT(same(with.at(start + duration), {with.at(start + duration).at, target, 0.0, 0.0}));
  RC_ASSERT(with.at(start + duration + hours(1)).pace == target);
  RC_ASSERT(std::is_sorted(with.ramps.begin(), with.ramps.end(),
                           [](const Ramp& a, const Ramp& b) { return a.start < b.start; }));
  const PlanMoment taken_over = axis.at(start);
  const PlanMoment there = with.at(start);
  RC_ASSERT(there.at == taken_over.at);
  RC_ASSERT(std::abs(there.pace - taken_over.pace) < 1e-14);
  RC_ASSERT(std::abs(there.rate_1_s - taken_over.rate_1_s) < 1e-13);
  RC_ASSERT(std::abs(there.curvature_1_s2 - taken_over.curvature_1_s2) < 1e-12);
  for (int i = 0; i < 20; ++i) {
    const SwarmTime before = start - random_duration(0.0, 20.0);
    // Before the axis begins there is only a constant pace, whatever is taken over from it.
    if (before < axis.ramps.front().start) continue;
    RC_ASSERT(same(with.at(before), axis.at(before)));
  }
}

TEST(Pace, a_ramp_at_the_moment_another_begins_takes_its_place) {
  const SwarmTime start = kAxisBegin + seconds(1);
  const Pace once = constant_pace(0.0).with_ramp(start, seconds(2), 1.0);
  const Pace twice = once.with_ramp(start, seconds(4), 0.5);
  EXPECT_EQ(twice.ramps.size(), once.ramps.size());
  EXPECT_EQ(twice, constant_pace(0.0).with_ramp(start, seconds(4), 0.5));
}

TEST(Pace, a_ramp_before_the_axis_began_is_all_there_is) {
  const Pace axis = constant_pace(1.0).with_ramp(kAxisBegin + seconds(5), seconds(2), 0.0);
  const Pace with = axis.with_ramp(kAxisBegin - seconds(3), seconds(2), 0.0);
  ASSERT_EQ(with.ramps.size(), 1U);
  EXPECT_EQ(with.at(kAxisBegin - seconds(3)).at, PlanTime(-seconds(3))) << "a constant pace before its start";
  EXPECT_EQ(with.at(kAxisBegin - seconds(4)).at, PlanTime(-seconds(4)));
  EXPECT_TRUE(with.rests(kAxisBegin));
}

TEST(Pace, there_is_room_for_what_passes_and_three_that_come) {
  Pace axis = constant_pace(0.5);
  for (int i = 1; i < static_cast<int>(kMaxRamps); ++i)
    axis = axis.with_ramp(kAxisBegin + i * seconds(1), seconds(3), 1.0);
  EXPECT_EQ(axis.ramps.size(), kMaxRamps);
  EXPECT_EQ(axis.with_ramp(kAxisBegin + milliseconds(1500), seconds(1), 0.0).ramps.size(), 3U)
      << "what was to come after it does not come";
}

RC_GTEST_PROP(Pace, settling_forgets_what_has_passed_and_changes_nothing_ahead, ()) {
  const Pace axis = random_axis(3);
  const SwarmTime now = kAxisBegin + random_duration(-2.0, 35.0);
  Pace settled = axis;
  const bool changed = settled.settle(now);
  RC_ASSERT(changed == !(settled == axis));
  RC_ASSERT(settled.target() == axis.target());
  RC_ASSERT(settled.constant(now) == axis.constant(now));
  if (settled.ramps.size() > 1) RC_ASSERT(settled.ramps[1].start > now);  // RC_ASSERT evaluates both sides of an "or"
  RC_ASSERT(!axis.constant(now) || settled.ramps.front().duration == Duration::zero());
  for (int i = 0; i < 50; ++i) {
    const SwarmTime ahead = i == 0 ? now : now + random_duration(0.0, 40.0);
    const PlanMoment a = axis.at(ahead);
    const PlanMoment b = settled.at(ahead);
    RC_ASSERT(std::abs((a.at - b.at).count()) <= 1);
    RC_ASSERT(a.pace == b.pace && a.rate_1_s == b.rate_1_s && a.curvature_1_s2 == b.curvature_1_s2);
  }
  RC_ASSERT(!settled.settle(now));
}

TEST(Pace, settling_at_the_very_moment_of_a_start_or_an_end_forgets_what_was_before) {
  const SwarmTime first = kAxisBegin + seconds(1);
  const SwarmTime second = kAxisBegin + seconds(2);
  const Pace axis = constant_pace(0.0).with_ramp(first, seconds(3), 1.0).with_ramp(second, seconds(3), 0.0);
  Pace settled = axis;
  EXPECT_FALSE(settled.settle(first - kTick));
  EXPECT_TRUE(settled.settle(first));
  EXPECT_EQ(settled.ramps.size(), 2U);
  EXPECT_FALSE(settled.settle(second - kTick));
  EXPECT_TRUE(settled.settle(second));
  ASSERT_EQ(settled.ramps.size(), 1U);
  EXPECT_EQ(settled.ramps[0], axis.ramps[2]) << "while it is passing it stays as it is";
  EXPECT_FALSE(settled.settle(second + seconds(3) - kTick));
  EXPECT_TRUE(settled.settle(second + seconds(3)));
  EXPECT_EQ(settled.ramps[0].duration, Duration::zero());
  EXPECT_EQ(settled.ramps[0].start, second + seconds(3));
}

// Agents settle at moments of their own, a thousand times: they may not drift apart by it.
TEST(Pace, it_may_be_settled_at_any_moments_without_drifting) {
  const Pace axis = constant_pace(0.0)
                        .with_ramp(kAxisBegin + seconds(1), seconds(4), 1.0)
                        .with_ramp(kAxisBegin + seconds(3), seconds(4), 0.25)
                        .with_ramp(kAxisBegin + seconds(12), seconds(2), 0.7);
  Pace often = axis;
  Pace seldom = axis;
  for (Duration t{}; t < seconds(20); t += milliseconds(1)) {
    const SwarmTime now = kAxisBegin + t;
    (void)often.settle(now);
    if (t % seconds(7) == Duration::zero()) (void)seldom.settle(now);
    ASSERT_LE(std::abs((often.at(now).at - axis.at(now).at).count()), 3);
    ASSERT_LE(std::abs((seldom.at(now).at - axis.at(now).at).count()), 3);
  }
  EXPECT_EQ(often.ramps.size(), 1U);
}

RC_GTEST_PROP(Pace, at_full_pace_it_counts_nanoseconds_exactly_over_days, ()) {
  Pace axis = constant_pace(0.0).with_ramp(kAxisBegin, random_duration(0.5, 20.0), 1.0);
  if (whole(0, 1) == 0) (void)axis.settle(kAxisBegin + seconds(60));
  const SwarmTime since = kAxisBegin + seconds(60);
  const Duration passed = hours(whole(0, 24 * 10)) + Duration(whole(0, 1'000'000'000)) + seconds(whole(0, 3600));
  RC_ASSERT(axis.at(since + passed).at - axis.at(since).at == passed);
  RC_ASSERT(axis.at(since + passed + kTick).at - axis.at(since + passed).at == kTick);
}

TEST(Pace, at_rest_plan_time_stands_to_the_nanosecond) {
  const Pace axis = constant_pace(1.0).with_ramp(kAxisBegin + seconds(5), milliseconds(2345), 0.0);
  const SwarmTime end = kAxisBegin + seconds(5) + milliseconds(2345);
  EXPECT_FALSE(axis.rests(end - kTick));
  EXPECT_TRUE(axis.rests(end));
  for (const Duration later : {Duration{}, kTick, Duration(seconds(1)), Duration(hours(24 * 365))}) {
    EXPECT_TRUE(same(axis.at(end + later), {axis.at(end).at, 0.0, 0.0, 0.0}));
  }
}

TEST(Pace, it_rests_only_where_it_will_not_move_again) {
  EXPECT_TRUE(Pace{}.rests(kAxisBegin));
  EXPECT_EQ(Pace{}.at(kAxisBegin).at, PlanTime{});
  EXPECT_FALSE(constant_pace(0.3).rests(kAxisBegin));
  const Pace starting = constant_pace(0.0).with_ramp(kAxisBegin + seconds(5), seconds(1), 1.0);
  EXPECT_EQ(starting.at(kAxisBegin).pace, 0.0);
  EXPECT_FALSE(starting.rests(kAxisBegin));
}

TEST(Pace, any_number_of_what_it_is_made_of_makes_it_another) {
  const Pace axis = constant_pace(0.2).with_ramp(kAxisBegin + seconds(1), seconds(2), 0.9);
  EXPECT_EQ(axis, Pace(axis));
  const auto other = [&axis](const auto& change) {
    Pace changed = axis;
    change(changed.ramps.back());
    return !(changed == axis);
  };
  EXPECT_TRUE(other([](Ramp& r) { r.start += kTick; }));
  EXPECT_TRUE(other([](Ramp& r) { r.duration += kTick; }));
  EXPECT_TRUE(other([](Ramp& r) { r.from.at += kTick; }));
  EXPECT_TRUE(other([](Ramp& r) { r.from.pace += 1e-9; }));
  EXPECT_TRUE(other([](Ramp& r) { r.from.rate_1_s += 1e-9; }));
  EXPECT_TRUE(other([](Ramp& r) { r.from.curvature_1_s2 += 1e-9; }));
  EXPECT_TRUE(other([](Ramp& r) { r.target += 1e-9; }));
}

/// The greatest that a ramp asks for, sampled ten times as densely as the proof's grid.
RampPeaks sampled(const Ramp& ramp, double speed_max_m_s, double acceleration_max_m_s2) {
  constexpr int kSamples = 2560 + 7;  // not a multiple: points of the grid and between them
  RampPeaks most;
  for (int i = 0; i <= kSamples; ++i) {
    const PlanMoment m = ramp.at(ramp.start + ramp.duration * i / kSamples);
    most.pace = std::max(most.pace, std::abs(m.pace));
    most.acceleration_m_s2 = std::max(most.acceleration_m_s2,
                                      m.pace * m.pace * acceleration_max_m_s2 + std::abs(m.rate_1_s) * speed_max_m_s);
  }
  return most;
}

RC_GTEST_PROP(Peaks, they_are_never_below_a_dense_sampling_and_at_most_a_hundredth_above_it, ()) {
  const Pace axis = random_axis(3);
  const Ramp& ramp = axis.ramps[static_cast<std::size_t>(whole(1, 3))];
  const double speed_max_m_s = whole(0, 2) == 0 ? 0.0 : real(0.0, 20.0);
  const double acceleration_max_m_s2 = real(0.0, 20.0);
  const RampPeaks most = sampled(ramp, speed_max_m_s, acceleration_max_m_s2);
  const RampPeaks claim = peaks(ramp, speed_max_m_s, acceleration_max_m_s2);
  RC_ASSERT(claim.pace >= most.pace);
  RC_ASSERT(claim.acceleration_m_s2 >= most.acceleration_m_s2);
  RC_ASSERT(claim.pace <= 1.01 * std::max(most.pace, 1e-3));
  RC_ASSERT(claim.acceleration_m_s2 <= 1.01 * most.acceleration_m_s2 + 1e-9);
}

TEST(Peaks, from_rest_to_full_pace_they_are_those_of_the_step) {
  const Ramp ramp = constant_pace(0.0).with_ramp(kAxisBegin, seconds(4), 1.0).ramps.back();
  EXPECT_NEAR(peaks(ramp, 2.0, 0.0).acceleration_m_s2, 2.0 * 15.0 / 8.0 / 4.0, 1e-3);  // v_max · 15/8 / T
  EXPECT_NEAR(peaks(ramp, 0.0, 3.0).acceleration_m_s2, 3.0, 1e-2);
  EXPECT_NEAR(peaks(ramp, 2.0, 0.0).pace, 1.0, 1e-3);
}

TEST(Peaks, a_constant_pace_asks_for_its_square) {
  const Ramp ramp = constant_pace(0.5).ramps.front();
  EXPECT_EQ(peaks(ramp, 7.0, 8.0).pace, 0.5);
  EXPECT_EQ(peaks(ramp, 7.0, 8.0).acceleration_m_s2, 2.0);
}

TEST(Peaks, a_ramp_that_overtakes_another_goes_a_little_beyond_its_target) {
  const SwarmTime middle = kAxisBegin + seconds(2);  // at its steepest
  const Pace axis = constant_pace(0.0).with_ramp(kAxisBegin, seconds(4), 1.0).with_ramp(middle, seconds(4), 0.5);
  EXPECT_GT(peaks(axis.ramps.back(), 1.0, 1.0).pace, 0.54);
}

TEST(Peaks, no_ramp_that_overtakes_another_runs_far_backwards_or_beyond_full_pace) {
  for (const double first_s : {0.5, 1.0, 2.0, 5.0}) {
    for (const double second_s : {0.5, 1.0, 5.0, 30.0}) {
      for (int i = 0; i <= 20; ++i) {
        const SwarmTime when = kAxisBegin + from_seconds(first_s * i / 20.0);
        for (const double from : {0.0, 1.0}) {
          const Pace axis = constant_pace(from)
                                .with_ramp(kAxisBegin, from_seconds(first_s), 1.0 - from)
                                .with_ramp(when, from_seconds(second_s), from);
          for (int k = 0; k <= 1000; ++k) {
            const double pace = axis.at(when + from_seconds(second_s * k / 1000.0)).pace;
            EXPECT_GT(pace, -0.2);
            EXPECT_LT(pace, 1.2);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace gyre::protocol
