// Thousands of flights of whole swarms with faults drawn from seeds: whatever happens, the load is held as well as the
// clocks and the wire allow, and once the faults end, everybody finds together.
//
// GYRE_SWARM_FLIGHTS: how many (default 2400; fewer where sanitizers slow everything down).

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "common/mechanics/skew.hpp"
#include "tests/swarm/flight.hpp"

namespace gyre::swarm {
namespace {

constexpr int kChunks = 24;

std::uint64_t flights() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::uint64_t kDefault = 120;
#else
  constexpr std::uint64_t kDefault = 2400;
#endif
  const char* wanted = std::getenv("GYRE_SWARM_FLIGHTS");
  return wanted == nullptr ? kDefault : std::strtoull(wanted, nullptr, 10);
}

class Flights : public testing::TestWithParam<int> {};

TEST_P(Flights, HoldTheLoadAndFindTogether) {
  const std::uint64_t each = std::max<std::uint64_t>(1, flights() / kChunks);
  const std::uint64_t first = 1 + static_cast<std::uint64_t>(GetParam()) * each;
  std::uint64_t noticed = 0;
  for (std::uint64_t seed = first; seed < first + each; ++seed) {
    const FlightReport report = fly(scenario(seed));
    EXPECT_TRUE(report.good()) << describe(report);
    noticed += report.extremes.residual_share > 0.01 ? 1 : 0;
  }
  // Budgets are for the worst that a fault can do. Most do nothing: of 40 000 such flights in 1 of 330 there was ever a
  // moment at which a hundredth of the weight was not held.
  EXPECT_LE(noticed, 1 + each / 50);
}

INSTANTIATE_TEST_SUITE_P(Chunk, Flights, testing::Range(0, kChunks));

FaultCounts& operator+=(FaultCounts& a, const FaultCounts& b) {
  static_assert(sizeof(FaultCounts) % sizeof(std::uint64_t) == 0, "nothing but counts");
  auto* into = reinterpret_cast<std::uint64_t*>(&a);
  const auto* from = reinterpret_cast<const std::uint64_t*>(&b);
  for (std::size_t i = 0; i < sizeof(FaultCounts) / sizeof(std::uint64_t); ++i) into[i] += from[i];
  return a;
}

TEST(Faults, HappenEveryOneOfThem) {
  FaultCounts sum;
  std::uint64_t instants = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const FlightReport report = fly(scenario(seed));
    sum += report.faults;
    instants += report.extremes.instants;
  }
  EXPECT_GT(sum.packets.lost, 10000U);
  EXPECT_GT(sum.packets.lost_in_burst, 1000U);
  EXPECT_GT(sum.packets.duplicated, 10000U);
  EXPECT_GT(sum.packets.held_back, 1000U);
  EXPECT_GT(sum.packets.parted, 10000U);
  EXPECT_GT(sum.packets.garbage, 1000U);
  EXPECT_GT(sum.packets.lies, 100U);
  EXPECT_GT(sum.agents_killed, 20U);
  EXPECT_GT(sum.coordinators_killed, 20U);
  EXPECT_GT(sum.killed_in_change, 5U);
  EXPECT_GT(sum.suspended, 20U);
  EXPECT_GT(sum.stalled, 20U);
  EXPECT_GT(sum.partitions, 20U);
  EXPECT_GT(sum.second_coordinators, 10U);
  EXPECT_GT(sum.twins, 10U);
  EXPECT_GT(sum.second_worlds, 5U);
  EXPECT_GT(sum.stood_down, 10U);
  EXPECT_GT(sum.commands, 100U);
  EXPECT_GT(sum.retunes, 20U);
  EXPECT_GT(sum.unflyable, 5U);
  EXPECT_GT(sum.late_verdicts, 20U);
  EXPECT_GT(sum.losses_named, 5U);
  EXPECT_GT(sum.leases_ended, 20U);
  EXPECT_LE(sum.stuck, 10U) << "nobody holds: only whose lease ended before the others' is seen to stop";
  EXPECT_GT(sum.turned_back, 0U);
  EXPECT_GT(instants, 100000U) << "the equilibrium has to be judged";
}

TEST(Calm, NobodyMergesMeasurably) {
  int flights_with_merges = 0;
  for (std::size_t load = 0; load < loads().size(); ++load) {
    const FlightReport report = fly(calm_scenario(load + 1, load));
    EXPECT_TRUE(report.good()) << describe(report);
    flights_with_merges += report.extremes.merging > 0 ? 1 : 0;
    EXPECT_LT(report.extremes.merging_m, 2e-5) << "load " << load;
  }
  EXPECT_LE(flights_with_merges, 1);
}

TEST(Calm, TheSameSeedIsTheSameFlight) {
  for (const std::uint64_t seed : {3U, 17U, 99U}) {
    const FlightReport once = fly(scenario(seed));
    const FlightReport again = fly(scenario(seed));
    EXPECT_EQ(once.flown, again.flown);
    EXPECT_EQ(once.faults.packets.sent, again.faults.packets.sent);
    EXPECT_EQ(once.extremes.residual_share, again.extremes.residual_share);
    EXPECT_EQ(once.extremes.setpoints, again.extremes.setpoints);
  }
}

/// A steady flight at full pace, and what happens in it.
class Silence : public testing::Test {
 protected:
  static constexpr std::size_t kAgent = kCoordinators + 1;

  /// Of this load, until `heal_s`.
  explicit Silence(std::size_t load = 0) { begin(load); }
  void begin(std::size_t load) {
    s_ = calm_scenario(5, load);
    const auto not_a_start = [](const Action& a) { return a.deed != Deed::kStart; };
    s_.actions.erase(std::remove_if(s_.actions.begin(), s_.actions.end(), not_a_start), s_.actions.end());
  }
  Action& at(double at_s, Deed deed, std::size_t process = kAgent) {
    Action action;
    action.at = TrueTime(from_seconds(at_s));
    action.deed = deed;
    action.process = process;
    s_.actions.push_back(action);
    return s_.actions.back();
  }
  void cut_both_ways(double at_s, std::size_t agent) {
    Action& cut = at(at_s, Deed::kCut);
    for (std::size_t c = 0; c < kCoordinators; ++c) {
      cut.cuts.push_back({c, agent});
      cut.cuts.push_back({agent, c});
    }
  }
  /// Flies until then, and tells what nobody excuses: the greatest share of the weight that was not held.
  double fly_until(double until_s) {
    swarm_ = std::make_unique<Swarm>(s_, Sabotage{}, Swarm::Trace{});
    swarm_->run_until(TrueTime(from_seconds(until_s)));
    EXPECT_TRUE(swarm_->checkers().findings().empty()) << swarm_->checkers().findings().front().text;
    return swarm_->checkers().extremes().residual_share;
  }
  [[nodiscard]] std::size_t carriers() const { return loads()[s_.load].size(); }
  /// Of the greatest force rate of any motion of this load, per second of disagreement, as a share of the weight.
  [[nodiscard]] double share_per_second() const {
    const auto& plan = loads()[s_.load].motions.front();
    const double weight_n = plan.load.mass_kg * plan.gravity_m_s2;
    return mechanics::kSkewShare / mechanics::skew_budget_s(mechanics::slices(plan), weight_n);
  }

  Scenario s_;
  std::unique_ptr<Swarm> swarm_;
};

TEST_F(Silence, OfOneAgentsRadioIsNotNoticedAndAllStopTogetherOrFlyOn) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    for (const bool stops : {true, false}) {
      begin(load);
      if (!stops) s_.silence.stop_after.reset();
      s_.residual_budget = cost::kCalm;
      cut_both_ways(10.0 + 0.01 * static_cast<double>(load), kAgent);
      const double share = fly_until(25.0);
      EXPECT_LT(share, cost::kCalm) << load;
      EXPECT_EQ(swarm_->faults().leases_ended, stops ? 1U : 0U);
      EXPECT_EQ(swarm_->coordinator()->course().rests(SwarmTime::max() - kLongest), stops);
    }
  }
}

TEST_F(Silence, ThatBeginsWhileAStepOfTheLeaseIsOnItsWayCostsThatStep) {
  // Wherever in a tenth of a second the link breaks. One of the two directions may break first.
  int noticed = 0;
  for (int i = 0; i < 100; ++i) {
    begin(1 + static_cast<std::size_t>(i) % (loads().size() - 1));
    s_.residual_budget = cost::kCalm + 0.15 * share_per_second();  // a step, and what the beacons' period adds
    cut_both_ways(10.0 + 0.001 * i, kAgent);
    noticed += fly_until(22.0) > cost::kCalm ? 1 : 0;
  }
  EXPECT_LE(noticed, 20) << "most often nothing is on its way";
}

TEST_F(Silence, OneWayOnlyIsNotNoticedEither) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    for (const bool hears : {true, false}) {
      begin(load);
      Action& cut = at(10.0, Deed::kCut);
      for (std::size_t c = 0; c < kCoordinators; ++c) {
        cut.cuts.push_back(hears ? Network::Cut{kAgent, c} : Network::Cut{c, kAgent});
      }
      s_.residual_budget = cost::kCalm + 0.15 * share_per_second();
      (void)fly_until(25.0);
      EXPECT_EQ(swarm_->faults().leases_ended, 1U) << load << hears;
    }
  }
}

TEST_F(Silence, OfHalfTheSwarmIsNotNoticed) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    for (const bool with_coordinator : {true, false}) {
      begin(load);
      Action& part = at(10.0, Deed::kPartition);
      part.groups.assign(kCoordinators + carriers(), 0);
      for (std::size_t i = 0; i < carriers(); ++i) {
        part.groups[kCoordinators + i] = (i < carriers() / 2) == with_coordinator ? 1 : 0;
      }
      s_.residual_budget = cost::kCalm + 0.15 * share_per_second();
      (void)fly_until(25.0);
    }
  }
}

TEST_F(Silence, OfADeadAgentIsNamedAndItsVehicleGoesOnAlongItsPath) {
  for (double at_s = 10.0; at_s < 11.0; at_s += 0.05) {
    for (const bool stops : {true, false}) {
      begin(0);
      if (!stops) s_.silence.stop_after.reset();
      at(at_s, Deed::kKill);
      EXPECT_LT(fly_until(at_s + 10.0), cost::kCalm);
      EXPECT_EQ(swarm_->faults().losses_named, 1U);
      EXPECT_EQ(swarm_->faults().leases_ended, stops ? 1U : 0U);
    }
  }
}

TEST_F(Silence, OfADeadAgentWhoseVehicleHoldsStopsAllAtItsPhase) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    for (const bool stops : {true, false}) {
      begin(load);
      if (!stops) s_.silence.stop_after.reset();
      s_.holding = {kAgent - kCoordinators};
      at(10.0 + 0.3 * static_cast<double>(load), Deed::kKill);
      // Until all have stopped, and while they go back to where it stands.
      s_.residual_budget = cost::kCalm + 0.6 * share_per_second();
      (void)fly_until(25.0);
      EXPECT_EQ(swarm_->faults().stuck, 1U) << load;
      EXPECT_EQ(swarm_->coordinator()->course().wish.by, protocol::Wisher::kEvidence);
      EXPECT_LT(swarm_->checkers().residual_share_now().value(), cost::kCalm + 0.05 * share_per_second())
          << load << ": they stand where it stands";
    }
  }
}

TEST_F(Silence, OfTheCoordinatorEndsInARestThatAllReachTogether) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    begin(load);
    at(10.0, Deed::kKill, 0);
    at(40.0, Deed::kStart, 0);
    s_.residual_budget = cost::kCalm;
    EXPECT_LT(fly_until(50.0), cost::kCalm);
    const protocol::Course& course = swarm_->coordinator()->course();
    EXPECT_EQ(course.wish.by, protocol::Wisher::kSilence);
    EXPECT_EQ(course.pace.target(), 0.0) << "it stays at rest, whatever the coordinator was started with";
  }
}

TEST_F(Silence, OfTheCoordinatorWithinTheLeaseIsNothing) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    begin(load);
    at(10.0, Deed::kKill, 0);
    at(12.0, Deed::kStart, 0);
    s_.residual_budget = cost::kCalm;
    EXPECT_LT(fly_until(25.0), cost::kCalm);
    EXPECT_EQ(swarm_->coordinator()->course().pace.target(), 1.0);
  }
}

TEST_F(Silence, IsWhatASecondAgentOfACarrierKeepsUntilTheFirstIsGone) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    begin(load);
    at(10.0, Deed::kTwin).length = std::chrono::seconds(5);
    s_.residual_budget = cost::kCalm;
    EXPECT_LT(fly_until(20.0), cost::kCalm) << load;
    EXPECT_EQ(swarm_->faults().twins, 1U);
    EXPECT_EQ(swarm_->coordinator()->course().pace.target(), 1.0);
    // The first one dies beside it, and comes back when it flies.
    begin(load);
    at(10.0, Deed::kTwin).length = std::chrono::seconds(15);
    at(12.0, Deed::kKill);
    at(18.0, Deed::kStart);
    s_.residual_budget = cost::kProcess;
    EXPECT_LT(fly_until(40.0), cost::kProcess) << load;
    EXPECT_EQ(swarm_->coordinator()->course().pace.target(), 1.0) << "somebody always flies it";
    EXPECT_TRUE(swarm_->merged());
  }
}

TEST_F(Silence, OfTheFirstCoordinatorLetsTheNextOneBelieveTheAgentThatFlies) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    begin(load);
    at(10.0, Deed::kTwin).length = std::chrono::seconds(20);
    at(12.0, Deed::kKill, 0);
    at(14.0, Deed::kStart, 0);
    s_.residual_budget = cost::kCalm;
    EXPECT_LT(fly_until(25.0), cost::kCalm) << load;
    EXPECT_EQ(swarm_->coordinator()->course().pace.target(), 1.0);
  }
}

TEST_F(Silence, ASecondSimulatorThatComesAndGoesIsNobodysWorld) {
  for (std::size_t load = 0; load < loads().size(); ++load) {
    begin(load);
    for (const double at_s : {10.0, 14.0}) at(at_s, Deed::kSecondWorld).length = std::chrono::seconds(2);
    // An agent that starts again meanwhile asks where its carrier is.
    at(14.5, Deed::kKill);
    at(15.0, Deed::kStart);
    s_.residual_budget = cost::kProcess;
    EXPECT_LT(fly_until(30.0), cost::kProcess) << load;
    EXPECT_EQ(swarm_->faults().stuck, 0U);
    EXPECT_EQ(swarm_->coordinator()->course().pace.target(), 1.0);
    EXPECT_TRUE(swarm_->merged());
  }
}

TEST_F(Silence, IsNoReasonToStopInTheMiddleOfARelease) {
  begin(0);
  at(10.0, Deed::kKill);
  at(11.0, Deed::kCommand).command = protocol::CommandKind::kRelease;
  EXPECT_LT(fly_until(25.0), cost::kCalm);
  ASSERT_EQ(swarm_->replies().size(), 1U);
  EXPECT_TRUE(swarm_->replies().front().done) << swarm_->replies().front().text;
  EXPECT_EQ(swarm_->coordinator()->course().wish.by, protocol::Wisher::kPerson);
  EXPECT_EQ(swarm_->coordinator()->course().pace.target(), 0.0);
}

TEST_F(Silence, OfAnAgentWhoseClockStoodStillEndsWithinTwoSeconds) {
  // Meanwhile its vehicle counts swarm time by a clock of its own: no longer than that may drift by little.
  for (const double length_s : {0.2, 0.7, 3.0, 20.0, 300.0}) {
    for (const std::size_t load : {0U, 3U, 9U}) {
      begin(load);
      s_.silence.stop_after.reset();
      at(10.0, Deed::kClockStop).length = from_seconds(length_s);
      s_.residual_budget = cost::kProcess;
      EXPECT_LT(fly_until(12.0 + length_s), cost::kProcess) << length_s << " s, load " << load;
      EXPECT_EQ(swarm_->faults().found_anew, 1U) << length_s;
      swarm_->run_until(TrueTime(from_seconds(20.0 + length_s)));
      std::string why;
      EXPECT_TRUE(swarm_->agrees(std::chrono::milliseconds(2), &why)) << length_s << ": " << why;
      EXPECT_TRUE(swarm_->merged()) << length_s;
      EXPECT_TRUE(swarm_->checkers().findings().empty()) << swarm_->checkers().findings().front().text;
    }
  }
}

TEST_F(Silence, OfAnAgentWhoseClockLeaptIsShorterThanAnybodyNotices) {
  for (const double length_s : {0.005, 0.012, 0.02, 0.05, 0.3, 5.0}) {
    for (const std::size_t load : {0U, 3U, 9U}) {
      for (int phase = 0; phase < 10; ++phase) {
        begin(load);
        at(10.0 + 1e-3 * phase, Deed::kClockLeap).length = from_seconds(length_s);
        // A leap within a beat or so is flown for a beat or two.
        const double flown_s = length_s < 0.015 ? length_s : 0.0;
        s_.residual_budget = cost::kCalm + flown_s * share_per_second();
        EXPECT_LT(fly_until(20.0), s_.residual_budget) << length_s << " s, load " << load;
        EXPECT_EQ(swarm_->faults().found_anew, 1U) << length_s;
        std::string why;
        EXPECT_TRUE(swarm_->agrees(std::chrono::milliseconds(2), &why)) << length_s << ": " << why;
        EXPECT_TRUE(swarm_->merged()) << length_s;
      }
    }
  }
}

TEST_F(Silence, OfACoordinatorWhoseClockStoodStillMovesNobodysTime) {
  for (const double length_s : {0.2, 0.7, 3.0, 20.0, 3600.0}) {
    for (const bool stops : {true, false}) {
      begin(0);
      if (!stops) s_.silence.stop_after.reset();
      at(10.0, Deed::kClockStop, 0).length = from_seconds(length_s);
      s_.residual_budget = cost::kCalm;
      EXPECT_LT(fly_until(20.0 + length_s), cost::kCalm) << length_s;
      EXPECT_EQ(swarm_->faults().found_anew, 0U) << length_s;
      std::string why;
      EXPECT_TRUE(swarm_->agrees(std::chrono::milliseconds(2), &why)) << length_s << ": " << why;
      EXPECT_EQ(swarm_->coordinator()->course().pace.target(), stops && length_s > 5.0 ? 0.0 : 1.0) << length_s;
    }
  }
}

}  // namespace
}  // namespace gyre::swarm
