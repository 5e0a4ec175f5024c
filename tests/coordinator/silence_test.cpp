// Somebody falls silent: for a moment, for longer than the lease, in both directions or in one; and all stop together,
// or, where the mission says so, fly on.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/coordinator/flying.hpp"

namespace gyre::coordinator {
namespace {

using protocol::CommandKind;
using protocol::Wisher;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::engaging;
using test::flies_on;
using test::Flying;
using test::heal;
using test::job;
using test::says;
using test::SwarmOfAgents;

constexpr Duration kStopAfter = seconds(5);

/// A way in which carrier 3 is lost.
struct Cut {
  const char* name;
  bool hears, is_heard;
};
constexpr Cut kCuts[] = {
    {"both ways", false, false}, {"hears, is not heard", true, false}, {"is heard, does not hear", false, true}};
void cut(SwarmOfAgents& swarm, const Cut& how) {
  if (!how.hears) swarm.deaf = {3};
  if (!how.is_heard) swarm.mute = {3};
}
TEST(Lease, GrowsAsLongAsAllConfirmIt) {
  Flying swarm;
  swarm.visit = [&, last = *swarm.course().lease]() mutable {
    const SwarmTime lease = *swarm.course().lease;
    EXPECT_GE(lease, last);
    EXPECT_GT(lease - swarm.beacon->swarm_time, kStopAfter - milliseconds(160)) << "a step, and the way there and back";
    last = lease;
  };
  swarm.fly(seconds(20));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Lease, GrowsAtRestAsWell) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(20));
  ASSERT_TRUE(swarm.course().lease);
  EXPECT_GT(*swarm.course().lease - swarm.beacon->swarm_time, kStopAfter - milliseconds(160));
}

TEST(Lease, StandsWhileSomebodyDoesNotConfirmAndGoesBackToTheLeastConfirmed) {
  for (const Cut& how : kCuts) {
    SCOPED_TRACE(how.name);
    Flying swarm;
    cut(swarm, how);
    const SwarmTime at_cut = swarm.beacon->swarm_time;
    swarm.fly(milliseconds(200));
    const SwarmTime granted = *swarm.course().lease;
    EXPECT_LE(granted - at_cut, kStopAfter + milliseconds(100)) << "one step further, at most";
    swarm.fly(milliseconds(600));
    const SwarmTime least = *swarm.course().lease;
    EXPECT_LE(least, granted);
    EXPECT_EQ(least, *swarm.statuses[3].course.lease) << "what it told last";
    // And it is what everybody has, whoever does not hear it.
    for (const CarrierId id : {1U, 2U, 3U, 4U}) EXPECT_EQ(swarm.agent(id).course().lease, least) << id;
    swarm.fly(seconds(2));
    EXPECT_EQ(swarm.course().lease, least) << "and it stands";
    EXPECT_EQ(swarm.pace(), 1.0);
    heal(swarm);
    swarm.fly(seconds(1));
    EXPECT_GT(*swarm.course().lease, least + seconds(2)) << "and grows again";
    swarm.fly(seconds(10));
    EXPECT_EQ(swarm.pace(), 1.0);
    EXPECT_FALSE(says(swarm.news, "lease"));
  }
}

TEST(Lease, EndsAndAllStopOnOneProfileToTheNanosecond) {
  for (const Cut& how : kCuts) {
    SCOPED_TRACE(how.name);
    Flying swarm;
    const protocol::Pace moving = swarm.course().pace;
    cut(swarm, how);
    swarm.fly(seconds(1));
    const SwarmTime end = *swarm.course().lease;
    const protocol::Pace stop = moving.with_ramp(end, swarm.course().stopping, 0.0);
    swarm.expect_one_phase(seconds(10));
    swarm.visit = [&] {
      const SwarmTime time = swarm.beacon->swarm_time;
      EXPECT_LE(std::abs((swarm.moment().at - stop.at(time).at).count()), 1);
      for (const CarrierId id : {1U, 2U, 3U, 4U}) {
        EXPECT_LE(std::abs((swarm.agent(id).course().moment(time).at - stop.at(time).at).count()), 1) << id;
      }
    };
    swarm.fly_until([&] { return swarm.beacon->swarm_time > end + milliseconds(100); });
    EXPECT_TRUE(says(swarm.news, "the lease ended without a word of everybody: all stop together"));
    EXPECT_EQ(swarm.coordinator().course().pace.target(), 0.0) << "it is the course now";
    swarm.fly(seconds(5));
    EXPECT_TRUE(swarm.rests());
    EXPECT_FALSE(swarm.moves());
    EXPECT_EQ(swarm.course().wish.by, Wisher::kSilence);
    // Whoever comes back finds that course, which is what it flew.
    heal(swarm);
    swarm.fly(seconds(20));
    EXPECT_TRUE(swarm.rests());
    EXPECT_FALSE(swarm.moves());
  }
}

TEST(Lease, EndsForAllAlikeWheneverTheLinkBreaksAndHowever) {
  for (Duration later{}; later <= milliseconds(120); later += milliseconds(10)) {
    Flying swarm;
    swarm.fly(later);
    swarm.deaf = {2, 4};
    swarm.mute = {3, 4};
    swarm.fly(seconds(12));
    EXPECT_TRUE(swarm.rests());
    EXPECT_FALSE(swarm.moves());
    swarm.expect_one_phase({});
  }
}

TEST(Lease, EndsForAllAlikeWhereALinkComesAndGoes) {
  for (const Duration heard : {milliseconds(30), milliseconds(130), milliseconds(250)}) {
    for (const Duration cut_off : {milliseconds(440), milliseconds(700), milliseconds(2100)}) {
      for (const Cut& how : kCuts) {
        Flying swarm;
        for (int i = 0; i < 7; ++i) {
          cut(swarm, how);
          swarm.fly(cut_off);
          heal(swarm);
          swarm.fly(heard);
        }
        cut(swarm, how);
        swarm.fly(seconds(12));
        EXPECT_TRUE(swarm.rests());
        EXPECT_FALSE(swarm.moves());
        swarm.expect_one_phase({});
      }
    }
  }
}

TEST(Silence, OfAnyoneAtAnyTimeWithAnyCommandsLeavesOnePhase) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    std::minstd_rand random(seed);
    const auto draw = [&random](unsigned below) { return static_cast<int>(random() / 7 % below); };
    SwarmOfAgents swarm(job());
    swarm.fly(seconds(1));
    for (int i = 0; i < 60; ++i) {
      const auto id = static_cast<CarrierId>(1 + draw(4));
      if (draw(3) == 0) swarm.deaf.insert(id);
      if (draw(3) == 0) swarm.mute.insert(id);
      if (draw(2) == 0) heal(swarm);
      protocol::Command command;
      command.kind = std::array{CommandKind::kEngage, CommandKind::kRelease, CommandKind::kFreeze,
                                CommandKind::kPace}[static_cast<std::size_t>(draw(4))];
      command.pace = 0.25 * draw(5);
      if (draw(3) == 0) command.phase_rad = draw(6);
      const Duration patience = milliseconds(10 * draw(200));
      (void)(draw(8) == 0 ? swarm.retune(draw(2) == 0 ? test::faster() : job(), patience)
                          : swarm.command(command, patience));
    }
    heal(swarm);
    swarm.fly(seconds(3));
    (void)swarm.command(CommandKind::kEngage, seconds(30));
    EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
    EXPECT_TRUE(swarm.course().transitions.empty());
    swarm.expect_one_phase(seconds(5));
  }
}

TEST(Silence, OfAMomentIsNoReasonToStop) {
  for (const Cut& how : kCuts) {
    SCOPED_TRACE(how.name);
    Flying swarm;
    for (int i = 0; i < 3; ++i) {
      cut(swarm, how);
      swarm.fly(seconds(4));
      heal(swarm);
      swarm.fly(seconds(2));  // a lease grows by steps
    }
    swarm.fly(seconds(10));
    EXPECT_EQ(swarm.pace(), 1.0) << swarm.news;
    EXPECT_EQ(swarm.course().wish.by, Wisher::kPerson);
  }
}

TEST(Silence, IsToldAndItsStopStaysUntilAPersonEngages) {
  Flying swarm(job(), engaging());
  swarm.stop_agent(3);
  swarm.fly(milliseconds(600));
  EXPECT_TRUE(says(swarm.news, "agent 3 is silent"));
  EXPECT_EQ(swarm.pace(), 1.0) << "silence is not loss";
  swarm.fly(seconds(10));
  ASSERT_TRUE(swarm.rests());
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage, seconds(1)), "refused: carrier 3 is silent"));
  swarm.start_agent(3);
  swarm.fly(seconds(30));
  EXPECT_TRUE(swarm.rests()) << "in spite of --engage";
  EXPECT_EQ(swarm.course().wish.by, Wisher::kSilence);
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
  swarm.stop_agent(4);
  swarm.fly(seconds(10));
  EXPECT_TRUE(swarm.rests()) << "the second silence counts as the first did";
}

TEST(Silence, AtRestEndsNothing) {
  SwarmOfAgents swarm(job());
  swarm.fly(seconds(2));
  swarm.stop_agent(3);
  swarm.fly(seconds(20));
  EXPECT_FALSE(says(swarm.news, "lease")) << swarm.news;
  EXPECT_EQ(swarm.course().wish.by, Wisher::kNobody);
  swarm.start_agent(3);
  swarm.fly(seconds(2));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Silence, OfWhoIsToBeReleasedSetsTheWishAndAllStopAtTheEndOfTheLease) {
  for (const CommandKind kind : {CommandKind::kRelease, CommandKind::kFreeze}) {
    Flying swarm;
    swarm.deaf = swarm.mute = {3};
    swarm.fly(seconds(1));
    const SwarmTime end = *swarm.course().lease;
    const std::string answer = swarm.command(kind, milliseconds(200));
    EXPECT_TRUE(says(answer, "done: carrier 3 is silent: all stop together, 3.9 s from now")) << answer;
    EXPECT_EQ(swarm.course().wish.pace, 0.0);
    EXPECT_EQ(swarm.course().wish.by, Wisher::kPerson);
    swarm.visit = [&] { EXPECT_FALSE(swarm.beacon->proposal) << "whoever is silent could not confirm it"; };
    swarm.fly(seconds(3));
    EXPECT_EQ(swarm.pace(), 1.0);
    EXPECT_EQ(swarm.course().lease, end);
    swarm.expect_one_phase(seconds(5));
    swarm.fly(seconds(4));
    EXPECT_TRUE(swarm.rests());
    EXPECT_FALSE(swarm.moves());
    EXPECT_EQ(swarm.course().wish.by, Wisher::kPerson) << "who had wished it before it came about";
    heal(swarm);
    swarm.fly(seconds(5));
    EXPECT_TRUE(swarm.rests());
  }
}

TEST(Silence, OfWhoComesBackInTimeLetsTheReleaseBeAgreed) {
  Flying swarm;
  swarm.deaf = swarm.mute = {3};
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease, seconds(1)), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
  heal(swarm);
  swarm.fly(seconds(8));
  EXPECT_TRUE(swarm.rests());
  EXPECT_FALSE(swarm.moves());
  EXPECT_FALSE(says(swarm.news, "lease")) << swarm.news;
}

TEST(Silence, LetsNothingElseBeAgreed) {
  Flying swarm;
  swarm.mute = {3};
  swarm.fly(seconds(1));
  EXPECT_TRUE(says(swarm.pace(0.5, milliseconds(20)), "refused: carrier 3 is silent"));
  EXPECT_TRUE(says(swarm.retune(test::faster(), milliseconds(20)), "cannot retune: carrier 3 is silent"));
  EXPECT_EQ(swarm.status->mission, "polygon");
}

TEST(Silence, OfTheCoordinatorStopsAllAlikeAndTheNextOneLeavesItSo) {
  Flying swarm(job(), engaging());
  const SwarmTime end = *swarm.course().lease;
  const protocol::Pace stop = swarm.course().pace.with_ramp(end, swarm.course().stopping, 0.0);
  swarm.stop_coordinator();
  swarm.fly(milliseconds(5500));
  EXPECT_TRUE(swarm.moves()) << "on the way to rest";
  swarm.fly(seconds(20));
  EXPECT_FALSE(swarm.moves());
  for (const CarrierId id : {1U, 2U, 3U, 4U}) {
    for (SwarmTime t = end; t < end + seconds(3); t += milliseconds(10)) {
      EXPECT_LE(std::abs((swarm.agent(id).course().moment(t).at - stop.at(t).at).count()), 1);
    }
  }
  swarm.start_coordinator();
  swarm.fly(seconds(20));
  EXPECT_TRUE(swarm.rests()) << swarm.news;
  EXPECT_EQ(swarm.course().wish.by, Wisher::kSilence);
  EXPECT_FALSE(swarm.moves());
  EXPECT_GT(*swarm.course().lease, swarm.beacon->swarm_time);
  swarm.expect_one_phase(seconds(1));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  EXPECT_EQ(swarm.pace(), 1.0);
}

TEST(Silence, OfTheCoordinatorWhileAllStopIsTakenOverInTheMidstOfIt) {
  Flying swarm;
  swarm.stop_coordinator();
  swarm.fly(milliseconds(5200));
  swarm.start_coordinator();
  swarm.fly(seconds(1));
  EXPECT_EQ(swarm.course().pace.target(), 0.0);
  EXPECT_GT(swarm.pace(), 0.0);
  swarm.expect_one_phase(seconds(3));
  swarm.fly(seconds(10));
  EXPECT_TRUE(swarm.rests());
  EXPECT_EQ(swarm.course().wish.by, Wisher::kSilence);
}

TEST(Silence, ThatEndsWhileAllStopLeavesThemStopping) {
  Flying swarm;
  swarm.deaf = swarm.mute = {3};
  swarm.fly_until([&] { return swarm.course().wish.by == Wisher::kSilence; });
  swarm.fly(milliseconds(500));
  ASSERT_FALSE(swarm.rests());
  heal(swarm);
  swarm.fly(milliseconds(300));
  swarm.expect_one_phase(seconds(3));
  swarm.fly(seconds(5));
  EXPECT_TRUE(swarm.rests());
  EXPECT_FALSE(swarm.moves());
}

TEST(Silence, OfAChangeThatIsUnderWayStopsItWhereItIs) {
  Flying swarm;
  EXPECT_TRUE(says(swarm.retune(test::faster(), milliseconds(1200)), "done"));
  swarm.deaf = swarm.mute = {3};
  swarm.fly(seconds(10));
  EXPECT_TRUE(swarm.rests());
  swarm.expect_one_phase(seconds(1));
  heal(swarm);
  swarm.fly(seconds(2));
  EXPECT_TRUE(says(swarm.command(CommandKind::kEngage), "done"));
  swarm.fly(seconds(10));
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_TRUE(swarm.course().transitions.empty());
}

// ---------------------------------------------------------------------------------------------------------- to fly on

TEST(FlyOn, HasNoLeaseAndNoSilenceStopsIt) {
  Flying swarm(flies_on());
  EXPECT_FALSE(swarm.course().lease);
  swarm.stop_agent(2);
  swarm.fly(seconds(60));
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_TRUE(says(swarm.news, "agent 2 is silent"));
  swarm.stop_coordinator();
  swarm.fly(seconds(60));
  EXPECT_TRUE(swarm.moves());
  for (const CarrierId id : {1U, 3U, 4U})
    EXPECT_EQ(swarm.agent(id).course().moment(swarm.setpoints[id].swarm_time).pace, 1.0);
}

TEST(FlyOn, LetsNothingBeAgreedWhileSomebodyIsSilent) {
  Flying swarm(flies_on());
  swarm.deaf = swarm.mute = {3};
  swarm.fly(seconds(1));
  for (const CommandKind kind : {CommandKind::kRelease, CommandKind::kFreeze}) {
    const std::string answer = swarm.command(kind, seconds(1));
    EXPECT_TRUE(says(answer, "refused: carrier 3 is silent, and whoever does not hear of a change flies on")) << answer;
  }
  EXPECT_EQ(swarm.course().wish.pace, 1.0) << "refused is not wished";
  heal(swarm);
  swarm.fly(seconds(10));
  EXPECT_EQ(swarm.pace(), 1.0);
  EXPECT_TRUE(says(swarm.command(CommandKind::kRelease), "done"));
  EXPECT_TRUE(swarm.rests());
}

TEST(FlyOn, IsLeftAndGoneOverToByTakingOver) {
  Flying swarm(flies_on());
  for (const Job& mission : {job(), flies_on()}) {
    swarm.stop_coordinator();
    swarm.fly(milliseconds(500));
    swarm.start_coordinator(mission, {});
    swarm.fly(seconds(2));
    EXPECT_EQ(swarm.course().lease.has_value(), mission.silence.stop_after.has_value());
    for (const CarrierId id : {1U, 2U, 3U, 4U}) EXPECT_EQ(swarm.agent(id).course().lease, swarm.course().lease);
    EXPECT_EQ(swarm.pace(), 1.0);
  }
}

}  // namespace
}  // namespace gyre::coordinator
