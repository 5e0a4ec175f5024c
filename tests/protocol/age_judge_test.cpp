// The age of messages, from nothing but stamps and arrivals.

#include "common/protocol/age_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/random_stream.hpp"

namespace gyre::protocol {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr LocalTime kStart(std::chrono::hours(5));
constexpr Duration kPeriod = milliseconds(10);
constexpr Duration kShortestWay = microseconds(80);

struct Sent {
  Duration stamp;
  LocalTime arrived;
  Duration lateness;  // beyond the shortest way
};

/// A hundred setpoints per second from a clock of its own rate and zero; mostly prompt, sometimes milliseconds late.
std::vector<Sent> stream(int count, double drift = 0.0, Duration zero = {}) {
  RandomStream random(11, "lateness");
  std::vector<Sent> sent;
  for (int i = 0; i < count; ++i) {
    const Duration since = i * kPeriod;
    const Duration lateness = from_seconds(-200e-6 * std::log(random.uniform()));
    const Duration stamp = zero + since + from_seconds(drift * seconds(since));
    sent.push_back({stamp, kStart + since + kShortestWay + lateness, lateness});
  }
  return sent;
}

std::vector<Duration> ages(const std::vector<Sent>& sent) {
  AgeJudge judge;
  std::vector<Duration> out;
  for (const Sent& s : sent) out.push_back(judge.age(s.stamp, s.arrived));
  return out;
}

/// How much of the lateness the judge misses, as a spread: what is missed by all alike moves nothing.
double missed_s(const std::vector<Sent>& sent, const std::vector<Duration>& ages, std::size_t from) {
  double most = 0.0;
  for (std::size_t i = from; i < sent.size(); ++i) {
    most = std::max(most, std::abs(seconds(sent[i].lateness - ages[i])));
  }
  return most;
}

TEST(AgeJudge, FindsTheLatenessOfEachSetpoint) {
  const std::vector<Sent> sent = stream(2000);
  const Duration latest = std::max_element(sent.begin(), sent.end(), [](const Sent& a, const Sent& b) {
                            return a.lateness < b.lateness;
                          })->lateness;
  ASSERT_GT(latest, milliseconds(1)) << "the stream has to be late now and then";
  EXPECT_LT(missed_s(sent, ages(sent), 100), 25e-6);
}

TEST(AgeJudge, DoesNotCareWhereTheSwarmHasItsZero) {
  const std::vector<Duration> reference = ages(stream(500));
  for (const Duration zero : {Duration(milliseconds(50)), Duration(-std::chrono::hours(7)), kLongestStamp / 2}) {
    EXPECT_EQ(ages(stream(500, 0.0, zero)), reference) << "an offset is the carrier's own, not for the judge to cure";
  }
}

TEST(AgeJudge, FollowsAClockThatRunsFastOrSlow) {
  for (const double drift : {300e-6, -300e-6}) {
    const std::vector<Sent> sent = stream(6000, drift);
    EXPECT_LT(missed_s(sent, ages(sent), 100), 300e-6 * seconds(kAgeWindow) + 25e-6) << drift;
  }
}

TEST(AgeJudge, FollowsAnAgentThatStartsAgainWithAnotherClock) {
  for (const Duration jump :
       {Duration(milliseconds(30)), Duration(-milliseconds(30)), Duration(-std::chrono::hours(1))}) {
    AgeJudge judge;
    for (const Sent& s : stream(300)) static_cast<void>(judge.age(s.stamp, s.arrived));
    const Duration pause = 300 * kPeriod + kAgeWindow;
    std::vector<Sent> again = stream(300);
    std::vector<Duration> found;
    for (Sent& s : again) found.push_back(judge.age(s.stamp + pause + jump, s.arrived + pause));
    EXPECT_EQ(found, ages(again)) << "nothing of the first life may be left";
  }
}

TEST(AgeJudge, KnowsTheAgeOfWhatWaitedForAListenerThatWasStopped) {
  AgeJudge judge;
  const Duration gap = std::chrono::seconds(20);
  for (const Sent& s : stream(300)) static_cast<void>(judge.age(s.stamp, s.arrived));
  const LocalTime awake = kStart + 300 * kPeriod + gap;
  for (int i = 300; i < 500; ++i) {  // all that waited is read at once
    const auto age = judge.age_by_the_past(i * kPeriod, awake);
    ASSERT_TRUE(age);
    EXPECT_NEAR(seconds(*age), seconds(awake - kStart - i * kPeriod), 1e-3);
    judge.keep(awake);
  }
  std::vector<Sent> after = stream(100);
  for (Sent& s : after) {
    s.stamp += 300 * kPeriod + gap;
    s.arrived += 300 * kPeriod + gap;
    EXPECT_LT(std::abs(seconds(judge.age(s.stamp, s.arrived) - s.lateness)), 25e-6) << "from the first one on";
  }
  EXPECT_FALSE(AgeJudge().age_by_the_past({}, awake)) << "who never heard anything knows nothing";
}

TEST(AgeJudge, FollowsAClockThatIsWalkedBackWithoutSilence) {
  std::vector<Sent> sent = stream(500);
  for (std::size_t i = 200; i < sent.size(); ++i) sent[i].stamp -= milliseconds(5);
  const std::vector<Duration> found = ages(sent);
  EXPECT_GT(found[200], milliseconds(4)) << "cannot be known yet from an old setpoint";
  EXPECT_LT(missed_s(sent, found, 200 + kAgeWindow / kPeriod), 25e-6);
}

TEST(AgeJudge, AFewLyingStampsMoveNoOther) {
  for (const Duration lie : {Duration(milliseconds(40)), Duration(std::chrono::hours(1)), kLongestStamp / 2}) {
    for (const int sign : {1, -1}) {
      std::vector<Sent> sent = stream(500);
      const std::vector<Duration> honest = ages(sent);
      for (std::size_t i = 250; i < 250 + kLying; ++i) sent[i].stamp += sign * lie;
      const std::vector<Duration> found = ages(sent);
      for (std::size_t i = 0; i < sent.size(); ++i) {
        EXPECT_GE(found[i], Duration{});
        EXPECT_LE(found[i], lie + milliseconds(5)) << "nor is one older than it says";
        if (i >= 250 && i < 250 + kLying) continue;
        EXPECT_LT(std::abs(seconds(found[i] - honest[i])), 25e-6) << i;
      }
    }
  }
}

}  // namespace
}  // namespace gyre::protocol
