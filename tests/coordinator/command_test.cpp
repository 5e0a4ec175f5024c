// What a person's command does: once, whenever it is said again; at whatever moment; and nobody undoes it by himself.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/text.hpp"
#include "common/mechanics/orbit_figures.hpp"
#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using protocol::Command;
using protocol::CommandKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::Flying;
using test::job;
using test::says;
using test::SwarmOfAgents;

Command of(CommandKind kind, std::uint64_t id = 0) {
  Command command;
  command.id = id;
  command.kind = kind;
  return command;
}

TEST(Command, IsDoneOnceHoweverOftenItIsSaid) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  const std::uint64_t revision = swarm.course().revision;
  for (int i = 0; i < 30; ++i) {
    swarm.tell(of(CommandKind::kEngage, 50));
    swarm.fly(milliseconds(100));
  }
  EXPECT_GT(swarm.replies.size(), 10U) << "the answer may be lost, too";
  for (const protocol::CommandReply& reply : swarm.replies) {
    EXPECT_EQ(reply.id, 50U);
    EXPECT_TRUE(reply.done) << reply.text;
    EXPECT_EQ(reply.text, swarm.replies.front().text);
  }
  EXPECT_EQ(swarm.course().revision, revision + 1);
}

TEST(Command, IsAnsweredTheSameWhenOthersWereDoneMeanwhile) {
  Flying swarm;
  swarm.replies.clear();
  swarm.tell(of(CommandKind::kRelease, 50));
  swarm.fly(seconds(10));
  swarm.tell(of(CommandKind::kEngage, 51));
  swarm.fly(seconds(10));
  swarm.tell(of(CommandKind::kRelease, 50));  // its answer was lost
  ASSERT_EQ(swarm.replies.size(), 3U);
  EXPECT_EQ(swarm.replies[2].id, 50U);
  EXPECT_TRUE(swarm.replies[2].done);
  EXPECT_EQ(swarm.replies[2].text, swarm.replies[0].text);
  swarm.fly(seconds(10));
  EXPECT_EQ(swarm.pace(), 1.0) << "it was done, and is not done again";
}

TEST(Command, IsRememberedOverSixtyThreeOthers) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  swarm.tell(of(CommandKind::kFreeze, 100));
  swarm.fly(milliseconds(200));
  const std::uint64_t revision = swarm.coordinator().course().revision;
  for (std::uint64_t id = 101; id < 164; ++id) swarm.tell(of(CommandKind::kFreeze, id));
  swarm.replies.clear();
  swarm.tell(of(CommandKind::kFreeze, 100));
  ASSERT_EQ(swarm.replies.size(), 1U);
  EXPECT_TRUE(says(swarm.replies[0].text, "at rest, and stays so")) << "as at first, and not as the others were";
  EXPECT_EQ(swarm.coordinator().course().revision, revision);
}

TEST(Command, IsAnsweredWhereItIsDoneAlready) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, {}), "refused: already in full motion"));
  EXPECT_TRUE(says(swarm.pace(1.0, {}), "refused: already at that pace"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease, seconds(2)), "done: the swarm comes to rest"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease, {}), "refused: already at rest, or on the way there"));
  swarm.fly(seconds(10));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease, {}), "refused: already at rest"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, {}), "refused: nothing moves"));
}

TEST(Command, IsDoneWhenTheAgentsHoldIt) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  swarm.deaf = {1, 2, 3, 4};
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, seconds(2)), "refused: not safe yet: no agent has said"));
  swarm.deaf.clear();
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, milliseconds(200)), "done: at rest, and stays so"));
  // One who is out of touch keeps nobody from it: his word counts less than that of those who hold the wish.
  swarm.deaf = {3};
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, seconds(1)), "refused: nothing moves"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(20)), "refused: carrier 3"));
}

TEST(Command, WaitsForTheOneThatIsBeingAgreedUnlessItFreezes) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.pace(0.5), "done"));
  swarm.deaf = {3};  // so that it takes its time
  swarm.tell(of(CommandKind::kEngage, 50));
  swarm.fly(milliseconds(100));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease, {}), "a change is being agreed"));
  swarm.deaf.clear();
  swarm.tell(of(CommandKind::kFreeze, 51));
  ASSERT_EQ(swarm.replies.back().id, 50U);
  EXPECT_FALSE(swarm.replies.back().done);
  EXPECT_TRUE(says(swarm.replies.back().text, "overtaken by another command"));
  swarm.fly(seconds(3));
  EXPECT_EQ(swarm.replies.back().id, 51U);
  EXPECT_TRUE(swarm.replies.back().done);
  EXPECT_TRUE(swarm.rests());
}

// --------------------------------------------------------------------------------------------------------------- pace

TEST(Command, ToAPaceIsFlownAtIt) {
  Flying swarm;
  const double full_m_s = swarm.setpoints[1].velocity_w_m_s.norm();
  EXPECT_TRUE(says(swarm.pace(0.5), "done: the swarm goes to 50 % of its pace"));
  EXPECT_EQ(swarm.pace(), 0.5);
  const protocol::Setpoint s = swarm.setpoints[1];
  const auto r = mechanics::evaluate(mechanics::slices(job().plan).front(),
                                     gyre::seconds(swarm.course().moment(s.swarm_time).at - swarm.course().base.epoch));
  EXPECT_LT((s.velocity_w_m_s - 0.5 * r.position_w_m.first).norm(), 1e-6);
  EXPECT_GT(full_m_s, 0.0);
  swarm.expect_one_phase(seconds(5));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done")) << "half of the pace is not full motion";
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_TRUE(says(swarm.pace(0.0), "done"));
  EXPECT_TRUE(swarm.rests());
  EXPECT_TRUE(says(swarm.pace(0.25), "done")) << "from rest as well";
  EXPECT_EQ(swarm.pace(), 0.25);
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  EXPECT_TRUE(swarm.rests());
}

TEST(Command, ToAPaceThatThereIsNotIsRefused) {
  Flying swarm;
  for (const double none : {-0.1, 1.1, std::nan(""), HUGE_VAL}) {
    EXPECT_TRUE(says(swarm.pace(none, {}), "refused: a pace is from 0, at rest, to 1, full motion"));
  }
  EXPECT_EQ(swarm.coordinator().course().wish.pace, 1.0);
}

TEST(Command, ToAPaceAtWhichASwingGrowsIsRefusedAndTheWayThroughItIsNot) {
  Flying swarm(test::swinging(job()));  // engaging passed every pace
  for (const double grows : {0.6, 0.7, 0.8, 0.85}) {
    EXPECT_TRUE(says(swarm.pace(grows, {}), text("refused: at %.3g of full pace a swing of the load grows", grows)));
  }
  EXPECT_EQ(swarm.coordinator().course().wish.pace, 1.0);
  EXPECT_TRUE(says(swarm.pace(0.9), "done"));
  EXPECT_TRUE(says(swarm.pace(0.0), "done")) << "rest is on the other side of them";
  EXPECT_TRUE(swarm.rests());
  EXPECT_TRUE(says(swarm.pace(1.0), "done"));
}

TEST(Command, ToAPaceIsNotJudgedBySwingsOfAPlanThatIsNotFlown) {
  Flying swarm;
  swarm.stop_coordinator();
  Job another = test::swinging(test::faster());
  swarm.start_coordinator(another, {});
  swarm.fly(seconds(3));
  ASSERT_EQ(swarm.pace(), 1.0) << "what flew goes on";
  EXPECT_TRUE(says(swarm.pace(0.7), "done")) << "its certificate is not known here";
}

// -------------------------------------------------------------------------------------------------------------- freeze

TEST(Command, ToFreezeWithinAnEngageStopsAtOnceAndAgain) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, milliseconds(600 + 3000)), "done"));
  ASSERT_GT(swarm.pace(), 0.5);
  ASSERT_LT(swarm.pace(), 1.0);
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, milliseconds(600 + 500)), "done"));
  ASSERT_FALSE(swarm.rests());
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, milliseconds(300)), "done")) << "who is afraid asks again";
  swarm.fly(seconds(2));
  EXPECT_TRUE(swarm.rests());
  EXPECT_FALSE(swarm.moves());
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, {}), "nothing moves"));
  swarm.expect_one_phase(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Command, ToEngageWithinAFreezeDoesNotFlyBackwards) {
  Job slow = job();
  slow.transition = seconds(20);
  for (const Job& mission : {job(), slow}) {
    for (const Duration into_it : {milliseconds(300), milliseconds(500), milliseconds(700)}) {
      SwarmOfAgents swarm(mission);
      swarm.fly(seconds(1));
      EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(25)), "done"));
      EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, into_it), "done"));
      // A ramp of twenty seconds that began with a freeze's rate would run at seven times the pace, backwards.
      EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(25)), "done"));
      EXPECT_EQ(swarm.pace(), 1.0);
    }
  }
}

TEST(Command, ToFreezeTakesAsLongForAHundredCarriersAsForFour) {
  struct Times {
    Duration until_go{}, until_rest{};
  };
  const auto measure = [](std::size_t carriers) {
    SwarmOfAgents swarm(job(carriers));
    swarm.fly(seconds(1));
    EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(3)), "done"));
    const LocalTime asked = swarm.now;
    swarm.replies.clear();
    swarm.tell(of(CommandKind::kFreeze, 50));
    swarm.fly_until([&] { return !swarm.replies.empty(); });
    EXPECT_TRUE(swarm.replies.front().done) << swarm.replies.front().text;
    Times times;
    times.until_go = swarm.now - asked;
    swarm.fly_until([&] { return swarm.rests(); });
    times.until_rest = swarm.now - asked;
    return times;
  };
  const Times four = measure(4), hundred = measure(100);
  EXPECT_EQ(hundred.until_go, four.until_go);
  EXPECT_EQ(hundred.until_rest, four.until_rest);
  EXPECT_LE(four.until_go, milliseconds(100));
  EXPECT_LE(four.until_rest, milliseconds(600 + 1000 + 50));
}

// ------------------------------------------------------------------------------------------------------------- release

TEST(Command, ToReleaseAtAPhaseStopsAtThatPhase) {
  const double rate_rad_s = job().plan.cycle.rate_rad_s;
  for (const double pace : {1.0, 0.5}) {
    for (const double phase_rad : {0.0, 0.1, 3.0, 6.2, -1.0, 100.0}) {
      Flying swarm;
      if (pace < 1.0) {
        EXPECT_TRUE(says(swarm.pace(pace), "done"));
      }
      Command release = of(CommandKind::kRelease);
      release.phase_rad = phase_rad;
      const double turn_s = kTwoPi / rate_rad_s / pace;
      EXPECT_TRUE(says(swarm.command(release, from_seconds(turn_s + 8.0)), "done"));
      ASSERT_TRUE(swarm.rests());
      const double stopped_rad = rate_rad_s * gyre::seconds(swarm.moment().at - swarm.course().base.epoch);
      EXPECT_LT(std::abs(std::remainder(stopped_rad - phase_rad, kTwoPi)), 1e-6) << phase_rad << " at " << pace;
      EXPECT_FALSE(says(swarm.news, "turning back")) << swarm.news;
    }
  }
}

TEST(Command, ToReleaseAtAPhaseMayBeOvertakenWhileItWaitsForIt) {
  Flying swarm;
  const double now_rad = job().plan.cycle.rate_rad_s * gyre::seconds(swarm.moment().at - swarm.course().base.epoch);
  Command release = of(CommandKind::kRelease);
  release.phase_rad = now_rad;  // too late for this turn
  EXPECT_TRUE(says(swarm.command(release, seconds(2)), "done"));
  ASSERT_EQ(swarm.pace(), 1.0);
  ASSERT_EQ(swarm.course().wish.pace, 0.0);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.fly(seconds(20));
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_TRUE(says(swarm.command(release, seconds(2)), "done"));
  EXPECT_TRUE(says(swarm.command(CommandKind::kFreeze, seconds(3)), "done")) << "now, and not in ten seconds";
  EXPECT_TRUE(swarm.rests());
}

TEST(Command, ToReleaseAtAPhaseThatIsNoAngleIsRefused) {
  Flying swarm;
  for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Command release = of(CommandKind::kRelease);
    release.phase_rad = none;
    EXPECT_TRUE(says(swarm.command(release, seconds(1)), "refused: "));
    EXPECT_EQ(swarm.course().pace.target(), 1.0);
  }
}

TEST(Command, ToRestIsDoneWithClocksThatAreTooFarApartForTheMotion) {
  Flying swarm;
  swarm.change_status = [](protocol::AgentStatus& s) { s.clock_uncertainty = seconds(10); };
  swarm.fly(seconds(1));
  const std::string answer = swarm.command(CommandKind::kRelease);
  EXPECT_TRUE(says(answer, "done")) << answer;
}

// --------------------------------------------------------------------------------------------------------- all of them

TEST(Command, ToRetuneIsRehearsedOverWhatIsStillUnderWay) {
  Job fast = job();
  fast.transition = seconds(20);
  Job slow = fast;
  slow.plan.cycle.rate_rad_s *= 0.5;
  Job slower = slow;
  slower.plan.cycle.rate_rad_s *= 0.9;
  slower.plan.limits.speed_max_m_s = 0.7 * mechanics::orbit_figures(mechanics::slices(fast.plan).front()).speed_m_s.max;
  Job at_rest = slow;
  SwarmOfAgents from_slow(at_rest);
  from_slow.fly(seconds(1));
  EXPECT_TRUE(says(from_slow.command(CommandKind::kEngage, seconds(30)), "done"));
  EXPECT_TRUE(says(from_slow.retune(slower), "done"));
  SwarmOfAgents swarm(fast);
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(30)), "done"));
  EXPECT_TRUE(says(swarm.retune(slow, seconds(5)), "done"));
  ASSERT_EQ(swarm.course().transitions.size(), 1U);
  const std::string answer = swarm.retune(slower, seconds(5));
  EXPECT_TRUE(says(answer, "it would break a limit")) << answer;
}

TEST(Command, IsNotUndoneByACoordinatorThatHearsNobodyForAMoment) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(1));
  swarm.tell(of(CommandKind::kEngage, 50));
  while (swarm.replies.empty()) swarm.fly(milliseconds(10));
  const SwarmTime start = swarm.coordinator().course().pace.ramps.back().start;
  // Cut off when it wants to see that all have begun, and later for nearly as long as the lease.
  while (swarm.beacon->swarm_time < start - milliseconds(300)) swarm.fly(milliseconds(10));
  for (const Duration cut : {Duration(milliseconds(900)), Duration(seconds(4))}) {
    swarm.mute = swarm.deaf = {1, 2, 3, 4};
    swarm.fly(cut);
    swarm.mute.clear();
    swarm.deaf.clear();
    swarm.fly(seconds(3));
  }
  EXPECT_FALSE(says(swarm.news, "turning back")) << swarm.news;
  EXPECT_FALSE(says(swarm.news, "lease")) << swarm.news;
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Command, ManyInARowNeverOverflowACourse) {
  Flying swarm;
  const CommandKind kinds[] = {CommandKind::kRelease, CommandKind::kEngage, CommandKind::kFreeze, CommandKind::kPace};
  int done = 0;
  for (int i = 0; i < 120; ++i) {
    Command command = of(kinds[i * 7 % 4]);
    command.pace = 0.1 * (i % 10);
    const std::string answer = i % 13 == 5 ? swarm.retune(i % 2 == 0 ? job() : test::faster(), milliseconds(900))
                                           : swarm.command(command, milliseconds(40 + i * 97 % 1300));
    EXPECT_FALSE(says(answer, "answered 2")) << answer;
    if (says(answer, "done")) ++done;
  }
  EXPECT_GT(done, 60);
  (void)swarm.command(CommandKind::kRelease, seconds(30));
  swarm.fly(seconds(60));
  EXPECT_TRUE(swarm.course().transitions.empty());
  EXPECT_EQ(swarm.course().pace.ramps.size(), 1U);
}

}  // namespace
}  // namespace gyre::coordinator
