// A judge that never finds anything proves nothing: every one of them is shown a swarm that is broken on purpose.

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include "common/mechanics/reference.hpp"
#include "tests/swarm/flight.hpp"

namespace gyre::swarm {
namespace {

// No core can be told a wall clock: its time is a type of its own, which no other clock converts to.
static_assert(!std::is_constructible_v<LocalTime, std::chrono::system_clock::time_point>);
static_assert(!std::is_constructible_v<SwarmTime, std::chrono::system_clock::time_point>);
static_assert(!std::is_constructible_v<LocalTime, SwarmTime> && !std::is_constructible_v<SwarmTime, LocalTime>);

bool at_or_after(TrueTime now, double at_s) {
  return now >= TrueTime(from_seconds(at_s));
}

Scenario calm() {
  return calm_scenario(7, 0);
}

/// A swarm that flies its motion, and nothing else happens.
Scenario steady() {
  Scenario s = calm();
  const auto order = [](const Action& a) { return a.deed == Deed::kRetune || a.deed == Deed::kCommand; };
  s.actions.erase(std::remove_if(s.actions.begin(), s.actions.end(), order), s.actions.end());
  return s;
}

testing::AssertionResult finds(const FlightReport& report, const std::string& rule) {
  for (const Finding& f : report.findings) {
    if (f.rule == rule) return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "nobody noticed; found instead:\n" << describe(report);
}

TEST(Judges, FindNothingInAGoodFlight) {
  const FlightReport report = fly(calm());
  EXPECT_TRUE(report.good()) << describe(report);
}

TEST(Judges, SeeAnAgentThatPullsTooHard) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime now, agent::Outputs& out) {
    if (agent == 2 && at_or_after(now, 8.0) && out.setpoint) out.setpoint->tension_n *= 1.02;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "equilibrium"));
}

TEST(Judges, SeeVehiclesThatLagByMoreThanTheirAgentsKnow) {
  Sabotage s;
  s.vehicles_lag_by_s = 0.5;
  EXPECT_TRUE(finds(fly(steady(), s), "equilibrium"));
}

TEST(Judges, SeeAnAgentThatFliesItsOwnCourse) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime now, agent::Outputs& out) {
    if (agent != 1 || !at_or_after(now, 10.0) || !out.setpoint) return;
    out.setpoint->position_w_m.x() += 0.02 * out.setpoint->cable_length_m;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "equilibrium"));
}

TEST(Judges, SeeAnAgentThatTakesAProposalForACourse) {
  Sabotage s;
  // Before the others begin: it is ahead of them by as much for good.
  s.agent_hears = [](std::size_t agent, TrueTime, agent::Event& event) {
    auto* heard = std::get_if<agent::Heard<protocol::Beacon>>(&event);
    if (agent != 0 || heard == nullptr || !heard->message.proposal) return;
    protocol::Beacon* beacon = &heard->message;
    for (protocol::Ramp& ramp : beacon->proposal->pace.ramps) ramp.start -= std::chrono::milliseconds(500);
    beacon->course = *beacon->proposal;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "equilibrium"));
}

TEST(Judges, SeeAnAgentThatStopsLaterThanTheOthers) {
  Scenario scenario = steady();
  Action kill;
  kill.at = TrueTime(from_seconds(12.0));
  kill.deed = Deed::kKill;
  kill.process = 0;
  scenario.actions.insert(std::prev(scenario.actions.end()), kill);
  EXPECT_TRUE(fly(scenario).good());
  Sabotage s;
  s.agent_hears = [](std::size_t agent, TrueTime, agent::Event& event) {
    auto* heard = std::get_if<agent::Heard<protocol::Beacon>>(&event);
    if (agent != 1 || heard == nullptr || !heard->message.course.lease) return;
    *heard->message.course.lease += std::chrono::seconds(2);
  };
  EXPECT_TRUE(finds(fly(scenario, s), "equilibrium"));
}

TEST(Judges, SeeASetpointThatStepsByAMillimetre) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime now, agent::Outputs& out) {
    if (agent == 3 && at_or_after(now, 9.0) && out.setpoint) out.setpoint->position_w_m.x() += 1e-3;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "continuity"));
}

TEST(Judges, SeeAVelocityThatSteps) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime now, agent::Outputs& out) {
    if (agent == 3 && at_or_after(now, 9.0) && out.setpoint) out.setpoint->velocity_w_m_s.y() += 0.2;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "continuity"));
}

TEST(Judges, SeeAClockThatJumps) {
  for (const double by_s : {1e-3, -1e-3, 0.05, -0.05}) {
    Sabotage s;
    s.clock_error = [by_s](std::size_t process, TrueTime now) {
      return process == kCoordinators && at_or_after(now, 10.0) ? from_seconds(by_s) : Duration::zero();
    };
    EXPECT_TRUE(finds(fly(steady(), s), "swarm time")) << by_s;
  }
}

TEST(Judges, SeeAnAgentThatIsSurerOfItsClockThanItMayBe) {
  Sabotage s;
  s.agent_says = [](std::size_t /*agent*/, TrueTime, agent::Outputs& out) {
    if (out.status) out.status->clock_uncertainty = Duration::zero();
  };
  s.agent_hears = [](std::size_t agent, TrueTime, agent::Event& event) {
    auto* reply = std::get_if<agent::TimeReplyArrived>(&event);
    if (agent != 0 || reply == nullptr) return;
    reply->reply.request_received += std::chrono::microseconds(400);
    reply->reply.reply_sent += std::chrono::microseconds(400);
  };
  EXPECT_TRUE(finds(fly(steady(), s), "clocks"));
}

TEST(Judges, SeeATermThatGoesBack) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime now, agent::Outputs& out) {
    if (agent == 0 && at_or_after(now, 12.0) && out.status) --out.status->term;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "terms"));
}

TEST(Judges, SeeALossThatIsNotNamed) {
  Scenario scenario = steady();
  Action kill;
  kill.at = TrueTime(from_seconds(12.0));
  kill.deed = Deed::kKill;
  kill.process = kCoordinators;
  scenario.actions.insert(std::prev(scenario.actions.end()), kill);
  EXPECT_TRUE(fly(scenario).good());
  Sabotage s;
  s.coordinator_says = [](std::size_t, TrueTime now, coordinator::Outputs& out) {
    if (at_or_after(now, 12.0)) out.notices.clear();
  };
  EXPECT_TRUE(finds(fly(scenario, s), "loss"));
}

TEST(Judges, SeeTwoAgentsThatBothFlyOneCarrier) {
  Scenario scenario = steady();
  Action twin;
  twin.at = TrueTime(from_seconds(10.0));
  twin.deed = Deed::kTwin;
  twin.process = kCoordinators;
  twin.length = std::chrono::seconds(4);
  scenario.actions.insert(std::prev(scenario.actions.end()), twin);
  std::stable_sort(scenario.actions.begin(), scenario.actions.end(),
                   [](const Action& a, const Action& b) { return a.at < b.at; });
  EXPECT_TRUE(fly(scenario).good());
  Sabotage s;
  s.vehicles_follow_anybody = true;
  s.vehicles_do_not_tell_whom = true;
  EXPECT_TRUE(fly(scenario, s).good()) << "the second one knows that it is not believed";
  s.coordinator_says = [](std::size_t, TrueTime, coordinator::Outputs& out) {
    if (out.time_reply) out.time_reply->believed = 0;
  };
  EXPECT_FALSE(fly(scenario, s).good());
  s.vehicles_follow_anybody = false;
  const FlightReport kept = fly(scenario, s);
  EXPECT_TRUE(kept.good()) << "the vehicle follows one of them" << describe(kept);
  EXPECT_GT(kept.faults.rivals_unheard, 100U);
  s.vehicles_do_not_tell_whom = false;
  const FlightReport known = fly(scenario, s);
  EXPECT_TRUE(known.good()) << describe(known);
  EXPECT_EQ(known.faults.rivals_unheard, 0U) << "what would not be flown is not said";
}

TEST(Judges, SeeTwoCoordinatorsThatDoNotHearEachOther) {
  Scenario scenario = steady();
  Action second;
  second.at = TrueTime(from_seconds(12.0));
  second.deed = Deed::kStart;
  second.process = 1;
  scenario.actions.insert(std::prev(scenario.actions.end()), second);
  EXPECT_TRUE(fly(scenario).good()) << "the second one stands down";
  Sabotage s;
  s.coordinator_is_deaf = [](std::size_t) { return true; };
  // Deaf and blind: what the agents say of a newer term is kept from the older one.
  s.agent_says = [](std::size_t, TrueTime, agent::Outputs& out) {
    if (out.status) out.status->term = 1;
  };
  EXPECT_TRUE(finds(fly(scenario, s), "agreement"));
}

TEST(Judges, SeeASwarmThatDoesNotFindTogether) {
  Sabotage s;
  s.agent_hears = [](std::size_t agent, TrueTime now, agent::Event& event) {
    auto* heard = std::get_if<agent::Heard<protocol::Beacon>>(&event);
    if (agent == 2 && at_or_after(now, 14.0) && heard != nullptr) heard->message.sequence = 0;
  };
  EXPECT_TRUE(finds(fly(calm(), s), "agreement"));
}

TEST(Judges, SeeAFlightThatDoesNotEnd) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime now, agent::Outputs& out) {
    if (agent == 2 && at_or_after(now, 26.0) && out.status) out.status->confirmed = 0;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "rest"));
}

TEST(Judges, SeeAnAgentThatNeverMergesBack) {
  Sabotage s;
  s.agent_says = [](std::size_t agent, TrueTime, agent::Outputs& out) {
    if (agent == 1 && out.setpoint) out.setpoint->position_w_m.z() += 0.5;
  };
  EXPECT_TRUE(finds(fly(steady(), s), "merging"));
}

TEST(EquilibriumJudge, KnowsForcesAndTheWeightAndNothingElse) {
  const LoadWithMotions& load = loads().front();
  EquilibriumJudge judge(load);
  const auto slices = mechanics::slices(load.motions.front());
  const auto command = [&](std::size_t i, double at_s, double plan_s, double tension_share) {
    const mechanics::Reference r = mechanics::evaluate(slices[i], plan_s);
    protocol::Setpoint s;
    s.position_w_m = r.position_w_m.value;
    s.tension_n = tension_share * r.tension_n.value;
    judge.commanded(i, TrueTime(from_seconds(at_s)), s);
  };
  for (std::size_t i = 0; i < load.size(); ++i) command(i, 1.0, 7.0, 1.0);
  EXPECT_FALSE(judge.residual_share()) << "a line takes two points";
  for (std::size_t i = 0; i < load.size(); ++i) command(i, 1.01, 7.01, 1.0);
  EXPECT_LT(judge.residual_share().value(), 1e-6);
  for (std::size_t i = 0; i < load.size(); ++i) command(i, 1.02, i == 0 ? 17.02 : 7.02, 1.0);
  EXPECT_GT(judge.residual_share().value(), 0.05) << "one is ten seconds ahead";
  for (std::size_t i = 0; i < load.size(); ++i) command(i, 1.03, 7.03, i == 0 ? 1.02 : 1.0);
  EXPECT_GT(judge.residual_share().value(), 4e-3) << "one pulls too hard";
}

TEST(VirtualClock, ShowsItsDriftAndFindsBack) {
  VirtualClock clock(RandomStream(1, "clock"), -std::chrono::hours(3), 150e-6, 0.0);
  const TrueTime later(std::chrono::seconds(1000));
  const LocalTime shown = clock.at(later);
  EXPECT_NEAR(seconds(shown.time_since_epoch()) + 3 * 3600.0, 1000.0 * (1.0 + 150e-6), 1e-6);
  const TrueTime when = clock.when(shown + std::chrono::milliseconds(10));
  EXPECT_GE(clock.at(when), shown + std::chrono::milliseconds(10));
  EXPECT_LT(clock.at(when), shown + std::chrono::milliseconds(10) + std::chrono::microseconds(1));
}

TEST(Network, LosesWhatItIsToldToLose) {
  Network network(1, 4);
  network.weather.loss = 0.9;
  int arrived = 0;
  constexpr int kPackets = 20000;
  for (int i = 0; i < kPackets; ++i) arrived += network.send(TrueTime(std::chrono::milliseconds(i)), 0, 1).copies;
  EXPECT_NEAR(arrived, 0.1 * kPackets, 0.01 * kPackets);
  network.weather = Weather{};
  network.groups = {0, 0, 1, 1};
  EXPECT_EQ(network.send(TrueTime{}, 0, 2).copies, 0);
  EXPECT_EQ(network.send(TrueTime{}, 0, 1).copies, 1);
}

}  // namespace
}  // namespace gyre::swarm
