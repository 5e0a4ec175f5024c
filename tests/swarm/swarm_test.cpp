// Thousands of flights of whole swarms with faults drawn from seeds: whatever happens, the load is held as well as the
// clocks and the wire allow, and once the faults end, everybody finds together.
//
// GYRE_SWARM_FLIGHTS: how many (default 2400; fewer where sanitizers slow everything down).

#include <gtest/gtest.h>

#include <cstdlib>

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
  for (std::uint64_t seed = first; seed < first + each; ++seed) {
    const FlightReport report = fly(scenario(seed));
    EXPECT_TRUE(report.good()) << describe(report);
  }
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
  double half_applied = 0.0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const FlightReport report = fly(scenario(seed));
    sum += report.faults;
    instants += report.extremes.instants;
    half_applied = std::max(half_applied, report.extremes.half_applied);
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
  EXPECT_GT(sum.killed_in_transition, 10U);
  EXPECT_GT(sum.suspended, 20U);
  EXPECT_GT(sum.stalled, 20U);
  EXPECT_GT(sum.partitions, 20U);
  EXPECT_GT(sum.second_coordinators, 10U);
  EXPECT_GT(sum.stood_down, 10U);
  EXPECT_GT(sum.commands, 100U);
  EXPECT_GT(sum.retunes, 20U);
  EXPECT_GT(sum.unflyable, 5U);
  EXPECT_GT(sum.losses_named, 5U);
  EXPECT_GT(sum.frozen_for_loss, 5U);
  EXPECT_GT(sum.turned_back, 0U);
  EXPECT_GT(instants, 100000U) << "the equilibrium has to be judged, not only excused";
  EXPECT_GT(half_applied, 0.01) << "no flight was ever in trouble";
}

TEST(Calm, NothingIsEverHalfAppliedAndNobodyMergesMeasurably) {
  int flights_with_merges = 0;
  for (std::size_t load = 0; load < loads().size(); ++load) {
    const FlightReport report = fly(calm_scenario(load + 1, load));
    EXPECT_TRUE(report.good()) << describe(report);
    // A go that is heard some milliseconds late is merged to: of 480 such flights in six, by up to 9 um.
    flights_with_merges += report.extremes.merging > 0 ? 1 : 0;
    EXPECT_LT(report.extremes.merging_m, 2e-5) << "load " << load;
    EXPECT_LT(report.extremes.half_applied, 1e-5) << "load " << load;
    EXPECT_LT(report.extremes.residual_share, 2e-3) << "load " << load;
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

/// A steady flight in which one agent dies at `at_s`; looked at until `until_s`.
FaultCounts lose_one(protocol::AgentLoss policy, double at_s, double until_s, std::size_t* transitions) {
  Scenario s = calm_scenario(5, 0);
  s.on_agent_loss = policy;
  const auto not_a_start = [](const Action& a) { return a.deed != Deed::kStart; };
  s.actions.erase(std::remove_if(s.actions.begin(), s.actions.end(), not_a_start), s.actions.end());
  Action kill;
  kill.at = TrueTime(from_seconds(at_s));
  kill.deed = Deed::kKill;
  kill.process = kCoordinators + 1;
  s.actions.push_back(kill);
  Swarm swarm(s, {}, {});
  swarm.run_until(TrueTime(from_seconds(until_s)));
  EXPECT_TRUE(swarm.checkers().findings().empty());
  *transitions = swarm.coordinator()->course().transitions.size();
  return swarm.faults();
}

TEST(AgentLoss, IsNamedWithinHalfASecondAndThePolicyActs) {
  for (double at_s = 10.0; at_s < 11.0; at_s += 0.05) {
    std::size_t transitions = 0;
    const FaultCounts frozen = lose_one(protocol::AgentLoss::kFreeze, at_s, at_s + 1.5, &transitions);
    EXPECT_EQ(frozen.losses_named, 1U);
    EXPECT_EQ(frozen.frozen_for_loss, 1U);
    EXPECT_EQ(transitions, 1U) << "the freeze is agreed";
    const FaultCounts continued = lose_one(protocol::AgentLoss::kContinue, at_s, at_s + 4.0, &transitions);
    EXPECT_EQ(continued.losses_named, 1U);
    EXPECT_EQ(continued.frozen_for_loss, 0U);
    EXPECT_EQ(transitions, 0U) << "the others fly on";
  }
}

}  // namespace
}  // namespace gyre::swarm
