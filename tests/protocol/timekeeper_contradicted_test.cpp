// What contradicts a timekeeper: lies, which change nothing, and clocks that jumped, whose time is found anew.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "clocks.hpp"
#include "common/protocol/timekeeper.hpp"

namespace gyre::protocol {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the rig of this room
using Verdict = Timekeeper::Verdict;

TEST(TimekeeperContradicted, OneLieIsAContradictionAndChangesNothing) {
  Settled s;
  const Duration before = magnitude(error(s.keeper, s.clock, s.now));
  EXPECT_EQ(s.lie(std::chrono::seconds(5)), Verdict::kContradiction);
  EXPECT_LT(magnitude(error(s.keeper, s.clock, s.now)), before + microseconds(1));
}

TEST(TimekeeperContradicted, LiesThatDisagreeAreNeverBelieved) {
  Settled s;
  for (int i = 1; i <= 100; ++i) {
    s.now += kPeriod;
    EXPECT_EQ(s.lie(i % 2 == 0 ? std::chrono::seconds(i) : -std::chrono::seconds(i)), Verdict::kContradiction);
  }
  EXPECT_LE(magnitude(error(s.keeper, s.clock, s.now)), s.keeper.uncertainty(s.clock.show(s.now)));
}

TEST(TimekeeperContradicted, TooFewLiesThatAgreeChangeNothing) {
  Settled s;
  for (const Duration by : {milliseconds(3), milliseconds(-300), milliseconds(30'000)}) {
    for (const Duration period : {milliseconds(20), milliseconds(125), milliseconds(1000)}) {
      for (int i = 1; i < TimekeeperOptions{}.contradictions_to_find_anew; ++i) {
        s.now += period;
        EXPECT_EQ(s.lie(by), Verdict::kContradiction);
      }
      EXPECT_LE(magnitude(s.error()), s.uncertainty());
      s.now += period;
      EXPECT_EQ(s.lie({}), Verdict::kTaken);
    }
  }
  EXPECT_LT(magnitude(s.error()), microseconds(30));
}

TEST(TimekeeperContradicted, ABurstOfLiesThatAgreeChangesNothing) {
  Settled s;
  for (int i = 0; i < 100; ++i) {
    s.now += milliseconds(7);
    EXPECT_EQ(s.lie(milliseconds(30)), Verdict::kContradiction);
  }
  EXPECT_LE(magnitude(s.error()), s.uncertainty());
  EXPECT_EQ(s.lie({}), Verdict::kTaken);
}

TEST(TimekeeperContradicted, CopiesOfALieAreOneLie) {
  Settled s;
  Exchange lie = shifted(s.exchanges.at(s.now), milliseconds(30));
  EXPECT_EQ(s.keeper.observe(lie, lie.reply_received), Verdict::kContradiction);
  for (int i = 0; i < 9; ++i) {
    lie.reply_received += milliseconds(100);
    EXPECT_EQ(s.keeper.observe(lie, lie.reply_received), Verdict::kNonsense);
  }
}

// The truth between them is what keeps them from being believed, however many they are.
TEST(TimekeeperContradicted, LiesThatAgreeAmongTruthsAreNeverBelieved) {
  for (std::size_t n = 0; n < kNetworks.size(); ++n) {
    const WrongClock clock{hours(3), 80e-6};
    Exchanges exchanges(clock, kNetworks[n], 1);
    Timekeeper keeper;
    RandomStream random(1, "lies");
    run(keeper, exchanges, kBegin, kBegin + std::chrono::seconds(10));
    for (int i = 1; i <= 10'000; ++i) {
      Exchange e = exchanges.at(kBegin + std::chrono::seconds(10) + i * kPeriod);
      if (i % 4 != 0 && random.uniform() < 0.8) {
        e = shifted(e, std::chrono::seconds(5));
      }
      EXPECT_NE(keeper.observe(e, e.reply_received), Verdict::kFoundAnew);
      const SwarmTime t = exchanges.complete();
      EXPECT_LE(magnitude(error(keeper, clock, t)), keeper.uncertainty(clock.show(t))) << "network " << n;
    }
    if (HasFailure()) return;
  }
}

// A machine that slept, a virtual one that was paused, a clock that leapt: soon found out, and at once made good.
TEST(TimekeeperContradicted, FindsTimeAnewAfterAJumpOfItsClock) {
  double slowest_s = 0.0;
  for (const double jump_s : {-1e4, -20.0, -1.0, -0.1, 0.1, 1.0, 20.0, 1e4}) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      RandomStream random(seed, "loss");
      const double loss = seed % 2 == 0 ? 0.3 : 0.0;
      const SwarmTime jumps = kBegin + from_seconds(5.0 + 10.0 * random.uniform());
      const SwarmTime awake = jumps + from_seconds(std::max(0.0, -jump_s));
      const WrongClock clock{hours(3), 400e-6 * (random.uniform() - 0.5), 0.0, jumps, from_seconds(jump_s)};
      Exchanges exchanges(clock, kNetworks[seed % kNetworks.size()], seed);
      Timekeeper keeper;
      std::optional<SwarmTime> contradicted, found;
      for (SwarmTime t = kBegin; t < awake + std::chrono::seconds(20); t += kPeriod) {
        if (t >= jumps && t < awake) t = awake;
        const Exchange e = exchanges.at(t);
        const SwarmTime complete = exchanges.complete();
        if (random.uniform() < loss || (complete >= jumps && complete < awake)) continue;
        const Verdict verdict = keeper.observe(e, e.reply_received);
        if (verdict == Verdict::kContradiction && !contradicted) contradicted = complete;
        if (verdict == Verdict::kFoundAnew) {
          EXPECT_FALSE(found) << "it was found already";
          found = complete;
        }
        for (SwarmTime seen = complete; seen < t + kPeriod && (found || seen < jumps); seen += milliseconds(25)) {
          EXPECT_LE(magnitude(error(keeper, clock, seen)), keeper.uncertainty(clock.show(seen)))
              << seconds(seen - jumps) << " s after a jump of " << jump_s << " s, seed " << seed;
        }
      }
      ASSERT_TRUE(contradicted && found) << "jump of " << jump_s << " s, seed " << seed;
      EXPECT_GE(*contradicted, awake) << "jump of " << jump_s << " s, seed " << seed;
      EXPECT_LT(*found - *contradicted, std::chrono::seconds(2)) << "jump of " << jump_s << " s, seed " << seed;
      EXPECT_FALSE(keeper.complaint());
      slowest_s = std::max(slowest_s, seconds(*found - awake));
      if (HasFailure()) return;
    }
  }
  std::printf("time is found anew at most %.2f s after a jump, with every third exchange lost\n", slowest_s);
}

// For an agent it is the same: all of the swarm sees it at once.
TEST(TimekeeperContradicted, FindsTimeAnewAfterAJumpOfTheCoordinatorsClock) {
  for (const Duration by : {milliseconds(-20'000), milliseconds(-100), milliseconds(100), milliseconds(20'000)}) {
    Settled s;
    Verdict verdict = Verdict::kContradiction;
    for (int i = 0; i < 8 && verdict == Verdict::kContradiction; ++i) {
      s.now += kPeriod;
      EXPECT_LT(magnitude(s.error()), microseconds(50)) << "nothing moves before";
      verdict = s.lie(by);
    }
    EXPECT_EQ(verdict, Verdict::kFoundAnew);
    EXPECT_LE(magnitude(s.error() - by), s.uncertainty());
    EXPECT_LT(s.uncertainty(), microseconds(200)) << "it knows as much as the exchanges told it";
    for (int i = 0; i < 100; ++i) {
      s.now += kPeriod;
      EXPECT_EQ(s.lie(by), Verdict::kTaken);
    }
    EXPECT_LT(magnitude(s.error() - by), microseconds(50));
  }
}

// What is slower than twice the jump agrees with the time before it as well as with the time after it.
TEST(TimekeeperContradicted, ASlowExchangeSpeaksForNeitherTime) {
  Settled s;
  const Duration jump = milliseconds(100);
  int slow = 0;
  Verdict verdict = Verdict::kContradiction;
  for (int i = 0; i < 12 && verdict != Verdict::kFoundAnew; ++i) {
    s.now += kPeriod;
    Exchange e = shifted(s.exchanges.at(s.now), jump);
    if (i % 3 == 2) {
      ++slow;
      e.request_sent -= milliseconds(110);
      e.reply_received += milliseconds(110);
    }
    verdict = s.keeper.observe(e, e.reply_received);
    EXPECT_EQ(verdict == Verdict::kTaken, i % 3 == 2) << i;
  }
  EXPECT_EQ(verdict, Verdict::kFoundAnew);
  EXPECT_GE(slow, 2);
}

// The slow way changes sides: as far as two measurements can be apart and both be right.
TEST(TimekeeperContradicted, AnHonestExchangeIsNoContradiction) {
  const WrongClock clock{hours(3), 80e-6};
  Exchanges before(clock, {milliseconds(10), {}, microseconds(30), {}}, 1);
  Exchanges after(clock, {microseconds(30), {}, milliseconds(10), {}}, 1);
  Timekeeper keeper;
  for (int i = 0; i < 1000; ++i) {
    const Exchange e = (i < 500 ? before : after).at(kBegin + i * kPeriod);
    EXPECT_EQ(keeper.observe(e, e.reply_received), Verdict::kTaken) << i;
  }
}

TEST(TimekeeperContradicted, ALieAtTheStartIsSeenThroughBeforeAnybodyReadsIt) {
  const WrongClock clock{hours(3), 80e-6};
  Exchanges exchanges(clock, kNetworks[0], 1);
  Timekeeper keeper;
  for (int i = 0; i < 100; ++i) {
    const Exchange e = shifted(exchanges.at(kBegin + i * milliseconds(20)), i == 0 ? hours(1) : hours(0));
    EXPECT_NE(keeper.observe(e, e.reply_received), Verdict::kFoundAnew) << "nobody had it before";
  }
  ASSERT_TRUE(keeper.synchronised());
  EXPECT_LE(magnitude(error(keeper, clock, exchanges.complete())),
            keeper.uncertainty(clock.show(exchanges.complete())));
}

// -------------------------------------------------------------------------- a leap of the own clock that others saw,
// too

TEST(TimekeeperContradicted, ALeapThatWasSeenIsFoundByOneExchange) {
  for (const Duration leap : {milliseconds(5), milliseconds(300), milliseconds(-20), milliseconds(5000)}) {
    Settled s;
    // Ahead of the swarm's by so much is the same as the swarm behind.
    EXPECT_EQ(s.lie(-leap, leap + milliseconds(2)), Verdict::kLeapt);
    EXPECT_LT(magnitude(s.error() + leap), microseconds(60)) << "seen to milliseconds, found to microseconds";
    EXPECT_LT(s.uncertainty(), milliseconds(1));
    const double drift_ppm = s.keeper.drift_ppm();
    EXPECT_NEAR(drift_ppm, -80.0, 5.0) << "a leap says nothing of how fast it runs";
  }
}

TEST(TimekeeperContradicted, ALeapThatIsNotTheOneSeenIsALie) {
  Settled s;
  EXPECT_EQ(s.lie(milliseconds(-50), milliseconds(20)), Verdict::kContradiction);
  EXPECT_EQ(s.lie(milliseconds(-50), milliseconds(-50)), Verdict::kContradiction);
  EXPECT_LE(magnitude(s.error()), s.uncertainty());
}

TEST(TimekeeperContradicted, ANetworkThatGotSlowerIsNoLeap) {
  Settled s;
  Exchange e = s.exchanges.at(s.now);
  // All of it on the way back: half of it is how wrong an exchange can be.
  e.reply_received += milliseconds(20);
  EXPECT_EQ(s.keeper.observe(e, e.reply_received, milliseconds(12)), Verdict::kTaken);
  s.now += kPeriod;
  EXPECT_EQ(s.lie({}, milliseconds(20)), Verdict::kTaken);
  EXPECT_LE(magnitude(s.error()), s.uncertainty());
}

}  // namespace
}  // namespace gyre::protocol
