// Stamps that contradict those before: dropped alone, believed when several agree. And agents: one is followed.

#include "simulator/core/setpoint_judge.hpp"

#include <gtest/gtest.h>

#include "common/protocol/age_judge.hpp"
#include "simulator/core/simulator.hpp"
#include "tests/simulator/agents.hpp"
#include "tests/simulator/rigs.hpp"

namespace gyre::simulator {
namespace {

using std::chrono::milliseconds;

constexpr LocalTime kStart(std::chrono::hours(5));

protocol::Setpoint setpoint(Duration stamp) {
  protocol::Setpoint s;
  s.carrier = 1;
  s.swarm_time = SwarmTime(stamp);
  s.winch_length_m = 1.0;
  return s;
}

class StampTest : public testing::Test {
 protected:
  StampTest() {
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(flown({}));
  }
  /// The next one of a hundred per second, from a clock that is off by so much.
  bool flown(Duration off) {
    at_ += milliseconds(10);
    return !judge_.objection(setpoint(at_ + off), kStart + at_);
  }

  SetpointJudge judge_{rigs::paper(), 2.0};
  Duration at_{};
};

TEST_F(StampTest, ThatContradictsThoseBeforeIsDroppedAndDeafensNobody) {
  for (const Duration off : {Duration(std::chrono::hours(1)), Duration(-std::chrono::hours(1)),
                             Duration(milliseconds(1100)), protocol::kLongestStamp - std::chrono::hours(1)}) {
    const auto nonsense = judge_.dropped().nonsense;
    EXPECT_FALSE(flown(off));
    EXPECT_EQ(judge_.dropped().nonsense, nonsense + 1);
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(flown({}));
  }
  EXPECT_EQ(judge_.dropped().late, 0U);
}

TEST_F(StampTest, IsBelievedWhenSeveralInARowAgree) {
  for (const Duration off : {Duration(std::chrono::hours(1)), Duration(-std::chrono::hours(1))}) {
    for (int i = 1; i < kAgreeing; ++i) EXPECT_FALSE(flown(off)) << i;
    EXPECT_TRUE(flown(off));
    EXPECT_TRUE(judge_.began_anew(1));
    EXPECT_TRUE(flown(off));
    EXPECT_FALSE(judge_.began_anew(1));
  }
}

TEST_F(StampTest, IsNotBelievedWhenLiesDifferOrHonestOnesAreAmongThem) {
  for (int i = 1; i < 20; ++i) EXPECT_FALSE(flown(i * std::chrono::hours(1)));
  EXPECT_TRUE(flown({}));
  for (int i = 1; i < 20; ++i) {
    EXPECT_EQ(flown(i % 3 == 0 ? Duration{} : std::chrono::hours(1)), i % 3 == 0);
  }
}

TEST_F(StampTest, OfAnotherAgentIsNotFlownWhileTheFirstIsHeard) {
  const auto say = [this](std::uint64_t agent) {
    protocol::Setpoint s = setpoint(at_ += milliseconds(10));
    s.incarnation = agent;
    return !judge_.objection(s, kStart + at_);
  };
  at_ += milliseconds(300);
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(say(7));
    EXPECT_FALSE(say(8));
  }
  EXPECT_EQ(judge_.dropped().duplicate, 100U);
  EXPECT_EQ(judge_.follows(1, kStart + at_), 7U);
  EXPECT_EQ(judge_.contested(kStart + at_), std::vector<CarrierId>{1});
  // The first one dies: within a quarter of a second the other one flies the carrier.
  int dropped = 0;
  while (dropped < 100 && !say(8)) ++dropped;
  EXPECT_LE(dropped, 25);
  EXPECT_TRUE(say(8));
  EXPECT_EQ(judge_.follows(1, kStart + at_), 8U);
  EXPECT_TRUE(judge_.contested(kStart + at_).empty());
  EXPECT_EQ(judge_.follows(1, kStart + at_ + milliseconds(300)), 0U);
}

TEST(Stamp, OfAnHourAheadMovesNoLoadNorDoesAClockFoundAnew) {
  const mechanics::Plan plan = rigs::paper();
  const auto slices = mechanics::slices(plan);
  auto made = Simulator::create(plan, {}, kStart);
  ASSERT_TRUE(made.ok());
  Simulator simulator = std::move(made).value();
  double furthest_m = 0.0;
  const protocol::Pace pace = protocol::Pace{}.with_ramp(SwarmTime{}, std::chrono::seconds(10), 1.0);
  for (Duration t{}; t < std::chrono::seconds(30); t += milliseconds(10)) {
    for (const mechanics::CarrierSlice& slice : slices) {
      const auto moment = pace.at(SwarmTime(t));
      const auto r = mechanics::evaluate(slice, seconds(moment.at.time_since_epoch()));
      const auto position = mechanics::paced(r.position_w_m, moment.pace, moment.rate_1_s);
      const auto winch =
          mechanics::paced(r.length_m - 1.0 / plan.cable.stiffness_n_m * r.tension_n, moment.pace, moment.rate_1_s);
      const bool lie = t == std::chrono::seconds(15) && slice.id == 1;
      const Duration anew = t >= std::chrono::seconds(20) ? -std::chrono::hours(2) : Duration{};
      protocol::Setpoint s;
      s.carrier = slice.id;
      s.swarm_time = SwarmTime(t + anew + (lie ? Duration(std::chrono::hours(1)) : Duration{}));
      s.position_w_m = position.value;
      s.velocity_w_m_s = position.first;
      s.acceleration_w_m_s2 = position.second;
      s.winch_length_m = winch.value;
      s.winch_rate_m_s = winch.first;
      s.winch_acceleration_m_s2 = winch.second;
      static_cast<void>(simulator.step(kStart + t, s));
    }
    static_cast<void>(simulator.step(kStart + t + milliseconds(10), Advance{}));
    furthest_m = std::max(furthest_m, (simulator.load().position_w_m - plan.load.position_w_m).norm());
  }
  EXPECT_LT(furthest_m, 1e-3);
  EXPECT_EQ(simulator.dropped().nonsense, 1U + slices.size() * (kAgreeing - 1));
}

TEST(Simulator, FollowsOneOfTwoAgentsSaysWhichAndGoesOnByItsCourseAlone) {
  const mechanics::Plan plan = rigs::paper();
  const rigs::Agents agents(plan, 5.0), rivals(plan, 500.0);
  SimulationSettings settings;
  settings.incarnation = 99;
  auto made = Simulator::create(plan, settings, kStart);
  ASSERT_TRUE(made.ok());
  Simulator simulator = std::move(made).value();
  const auto say = [](auto message, std::uint64_t incarnation) {
    message.incarnation = incarnation;
    return message;
  };
  std::uint64_t follows = 0;
  double furthest_m = 0.0;
  for (Duration t{}; t < std::chrono::seconds(20); t += milliseconds(10)) {
    for (std::size_t i = 0; i < agents.count(); ++i) {
      const bool silent = i == 0 && t > std::chrono::seconds(10);
      if (!silent) {
        (void)simulator.step(kStart + t, say(agents.setpoint(i, t), 1));
        (void)simulator.step(kStart + t, say(agents.status(i), 1));
        if (t == Duration{}) (void)simulator.step(kStart + t, say(agents.held(i), 1));
      }
      // A second agent of the first carrier, with a course of its own; it goes when the first one does.
      if (i == 0 && !silent && t > std::chrono::seconds(2)) {
        (void)simulator.step(kStart + t, say(rivals.setpoint(i, t), 2));
        (void)simulator.step(kStart + t, say(rivals.status(i), 2));
      }
    }
    const Outputs out = simulator.step(kStart + t + milliseconds(10), Advance{});
    if (!out.carriers.empty()) {
      follows = out.carriers.front().follows;
      EXPECT_EQ(out.carriers.front().incarnation, 99U);
      EXPECT_EQ(out.load->incarnation, 99U);
    }
    if (t == std::chrono::seconds(5)) {
      EXPECT_EQ(follows, 1U);
      EXPECT_EQ(simulator.complaint(kStart + t).value_or("none"),
                "setpoints of two agents for carrier 1; end one of them");
    }
    furthest_m = std::max(furthest_m, (simulator.load().position_w_m - plan.load.position_w_m).norm());
  }
  EXPECT_EQ(follows, 0U);
  EXPECT_LT(furthest_m, 1e-4);
}

}  // namespace
}  // namespace gyre::simulator
