// The conductor with real agents, on virtual time: agreement, loss, recovery, and a person's commands.

#include "coordinator/core/coordinator.hpp"

#include <gtest/gtest.h>

#include "common/protocol/term.hpp"
#include "swarm_of_agents.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using protocol::Stage;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::says;
using test::SwarmOfAgents;

Job job(protocol::AgentLoss policy = protocol::AgentLoss::kFreeze) {
  Job j;
  j.name = "polygon";
  j.plan = mechanics::test::polygon_plan(4);
  j.on_agent_loss = policy;
  return j;
}

/// Everything that has to hold at every moment of every flight.
void watch(SwarmOfAgents& swarm) {
  swarm.visit = [&swarm, term = std::uint64_t{0}, sequence = std::uint64_t{0}]() mutable {
    if (!swarm.beacon) return;
    const protocol::Beacon& b = *swarm.beacon;
    EXPECT_LE(b.course.transitions.size(), protocol::kMaxTransitions);
    EXPECT_LE(swarm.most_offered, protocol::kMaxPlans);
    EXPECT_GE(b.term, term);
    EXPECT_TRUE(b.term > term || b.sequence >= sequence);
    term = b.term, sequence = b.sequence;
    for (const auto& [id, offer] : swarm.last_offers) {
      for (const protocol::PlanNumber& number : protocol::plans_of(b.course)) {
        const auto same = [&](const protocol::NumberedSlice& s) { return s.number == number; };
        EXPECT_TRUE(std::any_of(offer.slices.begin(), offer.slices.end(), same))
            << "a plan of the course is not offered";
      }
    }
  };
}

struct Flying : SwarmOfAgents {
  explicit Flying(const Job& j = job(), const CoordinatorOptions& options = {}) : SwarmOfAgents(j, options) {
    watch(*this);
    fly(seconds(2));
    EXPECT_TRUE(says(command(CommandKind::kEngage), "done")) << news;
    fly(seconds(60));
    EXPECT_TRUE(coordinator().course().transitions.empty());
  }
  [[nodiscard]] bool moves() const {
    double speed = 0.0;
    for (const auto& [id, s] : setpoints) speed = std::max(speed, s.velocity_w_m_s.norm());
    return speed > 1e-6;
  }
};

TEST(Coordinator, OpensAtOnceWhenAllAgentsAreFresh) {
  SwarmOfAgents swarm(job());
  swarm.fly(milliseconds(300));
  EXPECT_NE(swarm.coordinator().term(), 0U);
  EXPECT_TRUE(says(swarm.news, "held by the rest plan"));
}

TEST(Coordinator, BeginsAFlightOnlyWithAll) {
  SwarmOfAgents swarm(job());
  swarm.mute = {3};
  swarm.fly(milliseconds(1400));
  EXPECT_EQ(swarm.coordinator().term(), 0U);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(20)), "listening"));
  swarm.fly(std::chrono::seconds(10));
  EXPECT_EQ(swarm.coordinator().term(), 0U) << "the missing one may fly out there, by another swarm time";
  EXPECT_TRUE(says(swarm.news, "waiting for carrier 3"));
  swarm.mute.clear();
  swarm.fly(milliseconds(300));
  EXPECT_NE(swarm.coordinator().term(), 0U);
}

TEST(Coordinator, EngagesReleasesAndEndsAtRest) {
  Flying swarm;
  EXPECT_TRUE(swarm.moves());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "already there"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  swarm.fly(seconds(60));
  EXPECT_FALSE(swarm.moves());
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze), "nothing moves"));
  swarm.tell(Shutdown{});
  swarm.fly(seconds(5));
  ASSERT_TRUE(swarm.finished);
  EXPECT_TRUE(swarm.finished->clean);
}

TEST(Coordinator, EngagesByItselfWhenAsked) {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  SwarmOfAgents swarm(job(), options);
  watch(swarm);
  swarm.fly(seconds(60));
  EXPECT_STREQ("done", says(swarm.news, "held by the motion plan") ? "done" : swarm.news.c_str());
}

TEST(Coordinator, WhatIsNotConfirmedIsRevokedAndNothingHappened) {
  SwarmOfAgents swarm(job());
  watch(swarm);
  swarm.fly(seconds(2));
  swarm.deaf = {2};
  const std::string answer = swarm.command(CommandKind::kEngage);
  EXPECT_TRUE(says(answer, "not confirmed in time by carrier 2")) << answer;
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
  swarm.fly(seconds(10));
  for (const auto& [id, s] : swarm.setpoints) EXPECT_LT(s.velocity_w_m_s.norm(), 1e-9);
}

TEST(Coordinator, ARehearsalThatBreaksALimitIsTriedSlowerOrGivenUp) {
  Job fixed = job();
  fixed.plan.limits.acceleration_max_m_s2 = 1e-9;
  fixed.transition = seconds(5);
  SwarmOfAgents swarm(fixed);
  swarm.fly(seconds(2));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "it would break a limit"));
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
}

TEST(Coordinator, WhoDoesNotFollowAStartIsWaitedForByTurningBack) {
  SwarmOfAgents swarm(job());
  watch(swarm);
  swarm.fly(seconds(2));
  // Everybody confirms; carrier 2 never hears the go.
  const auto inner = swarm.visit;
  swarm.visit = [&, inner] {
    inner();
    if (swarm.statuses[2].confirmed > 0) swarm.deaf = {2};
  };
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(3)), "done"));
  EXPECT_TRUE(says(swarm.news, "carrier 2 does not follow the transition that began: turning back")) << swarm.news;
  swarm.fly(milliseconds(500));
  EXPECT_EQ(swarm.coordinator().course().base.number, swarm.last_offers.at(2).slices.front().number);
  // It was wanted, and still is.
  swarm.visit = inner;
  swarm.deaf = {};
  swarm.fly(seconds(80));
  const auto& course = swarm.coordinator().course();
  EXPECT_TRUE(course.transitions.empty());
  EXPECT_TRUE(says(swarm.news, "held by the motion plan"));
}

TEST(Coordinator, ATurnedBackStartIsNotTriedAgainWhenSomebodyReleased) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  swarm.visit = [&] {
    if (swarm.statuses[2].confirmed > 0) swarm.deaf = {2};
  };
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(3)), "done"));
  ASSERT_TRUE(says(swarm.news, "turning back"));
  static_cast<void>(swarm.command(CommandKind::kRelease));
  swarm.visit = nullptr;
  swarm.deaf = {};
  swarm.fly(seconds(60));
  EXPECT_FALSE(says(swarm.news, "held by the motion plan"));
}

TEST(Coordinator, FreezesOnCommand) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze), "done"));
  swarm.fly(seconds(10));
  EXPECT_FALSE(swarm.moves());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.fly(seconds(60));
  EXPECT_TRUE(swarm.moves());
}

TEST(Coordinator, NamesALostAgentAndFreezesWhereItStopped) {
  Flying swarm;
  const protocol::Course before = swarm.coordinator().course();
  swarm.stop_agent(2);
  const SwarmTime stopped = swarm.setpoints[2].swarm_time;
  swarm.fly(milliseconds(500));
  EXPECT_TRUE(says(swarm.news, "agent 2 is silent"));
  swarm.fly(seconds(10));
  EXPECT_TRUE(says(swarm.news, "lost carrier 2: freezing where it stopped"));
  // The static plan of the moment at which the vehicle comes to rest, two seconds on.
  const auto slices = mechanics::slices(job().plan);
  const double t_s = gyre::seconds(stopped + CoordinatorOptions{}.coasting - before.base.epoch);
  for (const mechanics::CarrierSlice& slice : slices) {
    if (slice.id == 2) continue;
    const auto expected = mechanics::evaluate(slice, t_s);
    EXPECT_LT((swarm.setpoints[slice.id].position_w_m - expected.position_w_m.value).norm(), 1e-2);
    EXPECT_LT(swarm.setpoints[slice.id].velocity_w_m_s.norm(), 1e-9);
  }
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "carrier 2 is lost"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  swarm.start_agent(2);
  swarm.fly(seconds(60));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.stop_agent(3);
  swarm.fly(seconds(5));
  EXPECT_TRUE(says(swarm.news, "lost carrier 3: freezing")) << "the second loss counts as the first did";
}

TEST(Coordinator, FliesOnWithoutTheLostIfTheMissionSaysSo) {
  Flying swarm(job(protocol::AgentLoss::kContinue));
  swarm.stop_agent(2);
  swarm.fly(seconds(10));
  EXPECT_FALSE(says(swarm.news, "freezing"));
  EXPECT_TRUE(swarm.moves());
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  EXPECT_FALSE(says(swarm.news, "turning back"));
}

TEST(Coordinator, AnEngageThatLosesAnAgentBeforeItIsGoDoesNotBegin) {
  SwarmOfAgents swarm(job());
  watch(swarm);
  swarm.fly(seconds(2));
  swarm.stop_agent(4);
  const std::string answer = swarm.command(CommandKind::kEngage);
  EXPECT_TRUE(says(answer, "refused:")) << answer;
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
}

TEST(Coordinator, EndsAtRestWithDeadAgentsToo) {
  Flying swarm(job(protocol::AgentLoss::kContinue));
  swarm.stop_agent(2);
  swarm.tell(Shutdown{});
  swarm.fly(seconds(120));
  ASSERT_TRUE(swarm.finished) << swarm.news;
  EXPECT_TRUE(swarm.finished->clean);
  swarm.setpoints.erase(2);
  EXPECT_FALSE(swarm.moves());
}

TEST(Coordinator, RetunesInFlight) {
  Flying swarm;
  Job faster = job();
  faster.plan.cycle.rate_rad_s *= 1.2;
  const protocol::PlanNumber before = swarm.coordinator().course().base.number;
  EXPECT_TRUE(says(swarm.retune(faster), "done"));
  swarm.fly(seconds(60));
  EXPECT_NE(swarm.coordinator().course().base.number, before);
  EXPECT_TRUE(swarm.moves());
}

TEST(Coordinator, ItsStatusNamesThePlansOfTheMissionInForce) {
  CoordinatorOptions options;
  options.status_period = options.beacon_period;
  Flying swarm(job(), options);
  const std::string first = swarm.status->mission;
  const auto inner = swarm.visit;
  swarm.visit = [&, inner] {
    inner();
    const protocol::Course& course = swarm.coordinator().course();
    const auto& above = course.transitions;
    const bool going = !above.empty() && above.back().stage == Stage::kGo;
    EXPECT_EQ(swarm.status->motion, going ? above.back().to.number : course.base.number);
  };
  Job faster = job();
  faster.name = "faster";
  faster.plan.cycle.rate_rad_s *= 1.2;
  swarm.deaf = {1};
  EXPECT_TRUE(says(swarm.retune(faster), "given up"));
  EXPECT_EQ(swarm.status->mission, first);
  swarm.deaf.clear();
  EXPECT_TRUE(says(swarm.retune(faster), "done"));
  EXPECT_EQ(swarm.status->mission, "faster");
}

TEST(Coordinator, ARefusedRetuneLeavesTheFlightAndItsMission) {
  Flying swarm;
  const protocol::Course before = swarm.coordinator().course();
  Job other = job();
  other.plan.load.mass_kg *= 2.0;
  EXPECT_TRUE(says(swarm.retune(other), "weight differs"));
  other = job();
  other.plan.carriers[1].attachment_b_m.x() += 0.1;
  EXPECT_TRUE(says(swarm.retune(other), "carrier 2 is attached elsewhere"));
  other = job();
  other.plan.carriers.pop_back();
  EXPECT_TRUE(says(swarm.retune(other), "it has 3 carriers, 4 are flying"));
  EXPECT_TRUE(swarm.coordinator().course() == before);

  // Refused by an agent: the mission that is flown stays the mission.
  swarm.deaf = {1};
  Job faster = job();
  faster.plan.cycle.rate_rad_s *= 1.2;
  EXPECT_TRUE(says(swarm.retune(faster), "given up"));
  swarm.deaf.clear();
  EXPECT_EQ(swarm.coordinator().course().base.number, before.base.number);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "already there: the motion plan"));
}

TEST(Coordinator, HoldsTheEngageBackWhileClocksMayDisagreeTooMuchAndSaysSo) {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  SwarmOfAgents swarm(job(), options);
  swarm.change_status = [](protocol::AgentStatus& s) { s.clock_uncertainty = seconds(10); };
  swarm.fly(seconds(5));
  EXPECT_TRUE(says(swarm.news, "the motion does not begin: the clocks may disagree"));
  EXPECT_TRUE(swarm.coordinator().course().transitions.empty());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "clocks may disagree"));
  swarm.change_status = nullptr;
  swarm.fly(seconds(3));
  EXPECT_FALSE(swarm.coordinator().course().transitions.empty());
}

TEST(Coordinator, RestartedItGoesOnAndTheFlightDoesNotNotice) {
  for (const int after_ms : {0, 700, 1200, 3000, 20'000}) {  // before, while and after a transition
    Flying swarm;
    (void)swarm.command(CommandKind::kRelease, milliseconds(after_ms));
    const protocol::CoordinatorStatus told = *swarm.status;
    const protocol::Course before = swarm.coordinator().course();
    const std::uint64_t term = swarm.coordinator().term();
    const Duration offset = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
    swarm.stop_coordinator();
    swarm.fly(seconds(3));
    std::map<CarrierId, protocol::Setpoint> last = swarm.setpoints;
    auto inner = swarm.visit;
    swarm.visit = [&, inner] {
      inner();
      for (const auto& [id, s] : swarm.setpoints) {
        const double dt = gyre::seconds(s.swarm_time - last[id].swarm_time);
        EXPECT_LT((s.position_w_m - last[id].position_w_m - dt * s.velocity_w_m_s).norm(), 1e-3);
        last[id] = s;
      }
    };
    swarm.start_coordinator();
    swarm.fly(seconds(3));
    EXPECT_GT(protocol::generation(swarm.coordinator().term()), protocol::generation(term));
    EXPECT_TRUE(says(swarm.news, "took over a swarm that flies"));
    protocol::Course expected = before;  // proposals are dropped: nobody may have been told to go
    if (!expected.transitions.empty() && expected.transitions.back().stage == Stage::kProposed) {
      expected.transitions.pop_back();
    }
    (void)protocol::settle(expected, swarm.beacon->swarm_time);
    EXPECT_TRUE(swarm.coordinator().course().base == expected.base) << after_ms;
    EXPECT_TRUE(swarm.coordinator().course().transitions == expected.transitions) << after_ms;
    const Duration now = swarm.beacon->swarm_time.time_since_epoch() - swarm.now.time_since_epoch();
    EXPECT_LT(std::abs(gyre::seconds(now - offset)), 0.011 + 1e-3);  // a beacon is up to two steps of the rig old
    // The plans are known again by what they are.
    EXPECT_EQ(swarm.status->term, swarm.coordinator().term());
    EXPECT_EQ(swarm.status->rest, told.rest);
    EXPECT_EQ(swarm.status->motion, told.motion);
    EXPECT_TRUE(
        says(swarm.command(expected.base.number == told.rest ? CommandKind::kEngage : CommandKind::kRelease), "done") ||
        !expected.transitions.empty());
  }
}

TEST(Coordinator, StandsDownForAHigherTermAndAnswersWhoWaits) {
  Flying swarm;
  swarm.tell(protocol::Command{99, CommandKind::kRelease, ""});
  protocol::Beacon other = *swarm.beacon;
  other.term += 0x10000;
  swarm.tell(other);
  ASSERT_TRUE(swarm.finished);
  EXPECT_FALSE(swarm.finished->clean);
  EXPECT_TRUE(says(swarm.finished->text, "standing down"));
  ASSERT_FALSE(swarm.replies.empty());
  EXPECT_EQ(swarm.replies.back().id, 99U);
  EXPECT_FALSE(swarm.replies.back().done);
}

TEST(Coordinator, CountsStrangersDuplicatesLateOnesAndNonsense) {
  Flying swarm;
  const auto before = swarm.coordinator().dropped();
  protocol::AgentStatus s = swarm.statuses[1];
  swarm.tell(s);
  EXPECT_EQ(swarm.coordinator().dropped().duplicate, before.duplicate + 1);
  --s.sequence;
  swarm.tell(s);
  EXPECT_EQ(swarm.coordinator().dropped().late, before.late + 1);
  s.carrier = 9;
  swarm.tell(s);
  s.carrier = 1;
  s.clock_drift_ppm = std::numeric_limits<double>::quiet_NaN();
  swarm.tell(s);
  swarm.tell(protocol::HeldPlans{9, 1, {}});
  swarm.tell(TimeRequestArrived{protocol::TimeRequest{9, 1, 1, swarm.now}, swarm.now});
  swarm.tell(TimeRequestArrived{protocol::TimeRequest{1, 1, 1, swarm.now}, swarm.now + seconds(1)});
  EXPECT_EQ(swarm.coordinator().dropped().nonsense, before.nonsense + 5);
  protocol::Beacon former = *swarm.beacon;
  former.term = 1;
  swarm.tell(former);
  EXPECT_EQ(swarm.coordinator().dropped().wrong_term, before.wrong_term + 1);
}

TEST(Coordinator, AStallIsNotMadeUpFor) {
  Flying swarm;
  const std::uint64_t before = swarm.beacon->sequence;
  swarm.now += seconds(2);
  for (int i = 0; i < 50; ++i) swarm.tell(Tick{});
  EXPECT_EQ(swarm.beacon->sequence, before + 1);
}

TEST(Coordinator, ManyCommandsInARowNeverOverflowACourse) {
  Flying swarm;
  const CommandKind kinds[] = {CommandKind::kRelease, CommandKind::kEngage, CommandKind::kFreeze};
  for (int i = 0; i < 40; ++i) {
    const std::string answer = swarm.command(kinds[i % 3], milliseconds(1300));
    EXPECT_FALSE(says(answer, "answered 2")) << answer;
  }
  swarm.fly(seconds(60));
  EXPECT_LE(swarm.coordinator().course().transitions.size(), 1U);
}

}  // namespace
}  // namespace gyre::coordinator
