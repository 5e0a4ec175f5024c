// How long changes of pace take, and which are refused.

#include "coordinator/core/ramps.hpp"

#include <gtest/gtest.h>

#include "tests/coordinator/jobs.hpp"

namespace gyre::coordinator {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// One carrier, 2 m/s and 3 m/s² at full pace.
RampLimits limits(double acceleration_max_m_s2) {
  RampLimits out;
  out.limits.acceleration_max_m_s2 = acceleration_max_m_s2;
  mechanics::CarrierFigures carrier;
  carrier.id = 7;
  carrier.speed_m_s = {1.5, 2.0};
  carrier.acceleration_max_m_s2 = 3.0;
  out.figures = {carrier};
  return out;
}

constexpr Duration kLongest = std::chrono::minutes(5);

TEST(Ramps, AreAsShortAsTheyKeepTheLimits) {
  const protocol::Pace rest;
  const auto roomy = ramp_duration(rest, {SwarmTime{}, 1.0, seconds(5), false}, limits(100.0), kLongest);
  ASSERT_TRUE(roomy);
  EXPECT_EQ(roomy.value(), seconds(5));
  const auto narrow = ramp_duration(rest, {SwarmTime{}, 1.0, milliseconds(500), false}, limits(3.2), kLongest);
  ASSERT_TRUE(narrow);
  EXPECT_GT(narrow.value(), seconds(1));
  EXPECT_FALSE(limits(3.2).broken_by(rest.with_ramp(SwarmTime{}, narrow.value(), 1.0).ramps.back()));
  EXPECT_TRUE(limits(3.2).broken_by(rest.with_ramp(SwarmTime{}, narrow.value() * 3 / 4, 1.0).ramps.back()));
}

TEST(Ramps, OfAFixedLengthAreRefusedInWordsUnlessTheyStop) {
  const RampLimits narrow = limits(3.2);
  const auto refused = ramp_duration({}, {SwarmTime{}, 1.0, milliseconds(500), true}, narrow, kLongest);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("carrier 7: acceleration up to"), std::string::npos) << refused.error().text;
  protocol::Pace motion;
  motion.ramps.front().from.pace = motion.ramps.front().target = 1.0;
  const auto stops = ramp_duration(motion, {SwarmTime{}, 0.0, milliseconds(500), true}, narrow, kLongest);
  ASSERT_TRUE(stops);
  EXPECT_GT(stops.value(), milliseconds(500)) << "a flight must be able to end, as gently as it has to";
}

TEST(Ramps, ThatNobodyCanFlyAreRefusedAndAStopIsTriedAllTheSame) {
  const RampLimits impossible = limits(2.0);
  EXPECT_FALSE(ramp_duration({}, {SwarmTime{}, 1.0, seconds(1), false}, impossible, kLongest));
  protocol::Pace motion;
  motion.ramps.front().from.pace = motion.ramps.front().target = 1.0;
  EXPECT_TRUE(ramp_duration(motion, {SwarmTime{}, 0.0, seconds(1), false}, impossible, kLongest));
}

TEST(Ramps, KeepWhatAWinchCanDo) {
  RampLimits winch;
  mechanics::CarrierFigures carrier;
  carrier.paid_out_rate_m_s = {-1.0, 2.0};
  carrier.winch_acceleration_max_m_s2 = 3.0;
  winch.figures = {carrier};
  winch.winch.acceleration_max_m_s2 = 3.2;
  const protocol::Pace rest;
  const auto narrow = ramp_duration(rest, {SwarmTime{}, 1.0, milliseconds(500), false}, winch, kLongest);
  const auto carriers = ramp_duration(rest, {SwarmTime{}, 1.0, milliseconds(500), false}, limits(3.2), kLongest);
  ASSERT_TRUE(narrow && carriers);
  EXPECT_EQ(narrow.value(), carriers.value()) << "as a carrier of the same speed and acceleration";
  EXPECT_NE(winch.broken_by(rest.with_ramp(SwarmTime{}, milliseconds(500), 1.0).ramps.back())->find("winch"),
            std::string::npos);
}

// Which overtakes another, and runs ahead of full pace meanwhile.
TEST(Ramps, ThatHurryKeepTheSpeedsAndRatesThatAreAllowed) {
  const protocol::Ramp hurries{SwarmTime{}, seconds(5), {PlanTime{}, 1.0, 0.5, 0.0}, 1.0};
  const double peak = protocol::peaks(hurries, 0.0, 0.0).pace;
  ASSERT_GT(peak, 1.01);
  RampLimits carrier = limits(100.0);
  carrier.figures.front().winch_rate_m_s = {-1.2, 0.5};
  carrier.figures.front().paid_out_rate_m_s = {-0.5, 1.4};
  EXPECT_FALSE(carrier.broken_by(hurries));
  const auto broken_by = [&](double speed_m_s, double winch_rate_m_s, double paid_out_m_s) {
    RampLimits limited = carrier;
    limited.limits.speed_max_m_s = speed_m_s;
    limited.limits.winch_rate_max_m_s = winch_rate_m_s;
    limited.winch.rate_max_m_s = paid_out_m_s;
    return limited.broken_by(hurries).has_value();
  };
  const double speed = 2.0 * peak, rate = 1.2 * peak, paid_out = 1.4 * peak;
  EXPECT_FALSE(broken_by(1.001 * speed, 1.001 * rate, 1.001 * paid_out));
  EXPECT_TRUE(broken_by(0.999 * speed, 1.001 * rate, 1.001 * paid_out));
  EXPECT_TRUE(broken_by(1.001 * speed, 0.999 * rate, 1.001 * paid_out));
  EXPECT_TRUE(broken_by(1.001 * speed, 1.001 * rate, 0.999 * paid_out));
}

TEST(Ramps, AreJudgedByThoseWhoAskForMost) {
  RampLimits all = limits(10.0);
  mechanics::CarrierFigures less = all.figures.front();
  less.id = 8;
  less.speed_m_s.max = 1.9;
  all.include(less);
  EXPECT_EQ(all.figures.size(), 1U);
  mechanics::CarrierFigures other = less;
  other.acceleration_max_m_s2 = 3.1;
  all.include(other);
  EXPECT_EQ(all.figures.size(), 2U) << "one is faster, the other harder accelerated";
  RampLimits winches = limits(10.0);
  mechanics::CarrierFigures pays_out = less;
  pays_out.winch_acceleration_max_m_s2 = 0.1;
  winches.include(pays_out);
  EXPECT_EQ(winches.figures.size(), 2U) << "one is faster, the other's winch harder accelerated";
  other.id = 9;
  other.speed_m_s.max = 2.5;
  all.include(other);
  ASSERT_EQ(all.figures.size(), 1U);
  EXPECT_EQ(all.figures.front().id, 9U);
}

TEST(Ramps, AtTheEndOfALeaseAreLongEnoughForTheFastest) {
  EXPECT_EQ(stopping_time(limits(100.0), seconds(2), kLongest), seconds(2));
  const Duration gently = stopping_time(limits(3.2), seconds(2), kLongest);
  EXPECT_FALSE(limits(3.2).broken_by({SwarmTime{}, gently, {PlanTime{}, 1.0, 0.0, 0.0}, 0.0}));
}

TEST(Ramps, LeaveNobodyTooSlowForGood) {
  mechanics::Limits least;
  least.speed_min_m_s = 1.2;
  const auto& figures = limits(1.0).figures;
  EXPECT_TRUE(too_slow(0.7, least, figures)) << "1.05 m/s";
  EXPECT_FALSE(too_slow(0.9, least, figures));
  EXPECT_FALSE(too_slow(0.0, least, figures)) << "rest is no flight";
  EXPECT_FALSE(too_slow(0.7, {}, figures));
}

TEST(Ramps, EndAtNoPaceAtWhichASwingGrows) {
  const std::optional<mechanics::Swings> swings = test::swinging({}).swings;
  EXPECT_TRUE(swing_grows(0.7, swings));
  EXPECT_TRUE(swing_grows(0.3, swings)) << "nobody looked between rest and 0.6";
  EXPECT_FALSE(swing_grows(0.95, swings));
  EXPECT_FALSE(swing_grows(0.0, swings)) << "rest is no motion";
  EXPECT_FALSE(swing_grows(1.0, swings)) << "its certificate has judged it";
  EXPECT_FALSE(swing_grows(0.7, std::nullopt));
}

}  // namespace
}  // namespace gyre::coordinator
