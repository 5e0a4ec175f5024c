// What becomes of a wish to hurt a flight: the deed and its words, the same bounds as the processes have, and nothing
// that is said to be done and is not.

#include "ground/flight/core/hurt_judge.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace gyre::ground {
namespace {

using protocol::Disturbance;
using protocol::DisturbanceKind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::HasSubstr;
using Kind = SignalDeed::Kind;

constexpr double kWeight_n = 0.3 * 9.81;  // the paper's load

class HurtJudgeTest : public testing::Test {
 protected:
  HurtVerdict judge(const HurtRequest& wish) { return judge_.judge(now_, wish, seen_); }
  HurtVerdict judge(HurtKind kind, const std::string& process, double amount = 0.0) {
    return judge(HurtRequest{kind, process, amount, Eigen::Vector3d::Zero(), 0.0});
  }
  HurtVerdict push(double force_n, double duration_s) {
    return judge(HurtRequest{HurtKind::kPush, "", 0.0, {0.0, force_n, 0.0}, duration_s});
  }
  static void is_refused(const HurtVerdict& verdict, const std::string& words) {
    EXPECT_FALSE(verdict.answer.done) << verdict.answer.text;
    EXPECT_THAT(verdict.answer.text, HasSubstr(words));
    EXPECT_TRUE(std::holds_alternative<std::monostate>(verdict.deed)) << "nothing is done";
  }
  static void is_signal(const HurtVerdict& verdict, Kind kind, const std::string& process, const std::string& words) {
    EXPECT_TRUE(verdict.answer.done);
    EXPECT_EQ(verdict.answer.text, words);
    const auto* signal = std::get_if<SignalDeed>(&verdict.deed);
    ASSERT_NE(signal, nullptr);
    EXPECT_EQ(signal->kind, kind);
    EXPECT_EQ(signal->process, process);
  }
  /// Fails where it is none.
  static Disturbance disturbance(const HurtVerdict& verdict) {
    EXPECT_TRUE(verdict.answer.done) << verdict.answer.text;
    const auto* deed = std::get_if<Disturbance>(&verdict.deed);
    EXPECT_NE(deed, nullptr);
    return deed ? *deed : Disturbance{};
  }
  void end(const std::string& process) { seen_.running.erase(process); }

  LocalTime now_{std::chrono::hours(1)};
  HurtJudge judge_{{"coordinator", "simulator", "agent 1", "agent 2"}, kWeight_n};
  FlightSeen seen_{{"coordinator", "simulator", "agent 1", "agent 2"}, true};
};

// ------------------------------------------------------------------------------------------------- signals

TEST_F(HurtJudgeTest, WhoIsKilledIsMeantAndIsNotKilledAgain) {
  EXPECT_FALSE(judge_.meant("agent 1"));
  is_signal(judge(HurtKind::kKill, "agent 1"), Kind::kKill, "agent 1", "agent 1 was killed");
  EXPECT_TRUE(judge_.meant("agent 1"));
  EXPECT_FALSE(judge_.meant("agent 2"));
  is_refused(judge(HurtKind::kKill, "agent 1"),
             "agent 1 has ended: restart it first");  // it is still seen, for a moment
  end("agent 1");
  for (const HurtKind kind : {HurtKind::kKill, HurtKind::kStop, HurtKind::kContinue, HurtKind::kLose}) {
    is_refused(judge(kind, "agent 1"), "agent 1 has ended: restart it first");
  }
}

TEST_F(HurtJudgeTest, WhoEndedByItselfIsNotMeant) {
  end("agent 2");
  is_refused(judge(HurtKind::kKill, "agent 2"), "has ended");
  EXPECT_FALSE(judge_.meant("agent 2"));
}

TEST_F(HurtJudgeTest, WhoHangsGoesOnAndWhatChangesNothingIsSaidToChangeNothing) {
  is_refused(judge(HurtKind::kContinue, "agent 1"), "agent 1 runs as it is: nothing changed");
  is_signal(judge(HurtKind::kStop, "agent 1"), Kind::kStop, "agent 1", "agent 1 hangs");
  EXPECT_TRUE(judge_.hangs("agent 1"));
  EXPECT_FALSE(judge_.hangs("agent 2"));
  is_refused(judge(HurtKind::kStop, "agent 1"), "agent 1 hangs as it is: nothing changed");
  is_signal(judge(HurtKind::kContinue, "agent 1"), Kind::kContinue, "agent 1", "agent 1 goes on");
  EXPECT_FALSE(judge_.hangs("agent 1"));
  is_refused(judge(HurtKind::kContinue, "agent 1"), "nothing changed");
}

TEST_F(HurtJudgeTest, WhoHangsIsKilledButHearsNothing) {
  (void)judge(HurtKind::kStop, "agent 1");
  is_refused(judge(HurtKind::kLose, "agent 1", 30), "agent 1 hangs, and hears nothing");
  is_refused(judge(HurtKind::kShiftClock, "agent 1", 3), "let it go on first");
  (void)judge(HurtKind::kStop, "simulator");
  is_refused(push(1.0, 0.5), "simulator hangs");
  is_signal(judge(HurtKind::kKill, "agent 1"), Kind::kKill, "agent 1", "agent 1 was killed");
  EXPECT_FALSE(judge_.hangs("agent 1"));
}

TEST_F(HurtJudgeTest, NobodyElsesProcessesAreHurtAndTheAnswerNamesThose) {
  for (const HurtKind kind : {HurtKind::kKill, HurtKind::kRestart, HurtKind::kLose}) {
    is_refused(judge(kind, "agent 3"), "no process called \"agent 3\"");
    is_refused(judge(kind, "ground"), "it has coordinator, simulator, agent 1, agent 2");
  }
}

// ------------------------------------------------------------------------------------------------- restarts

TEST_F(HurtJudgeTest, ARestartForgetsWhatWasDone) {
  (void)judge(HurtKind::kLose, "agent 1", 50);
  (void)judge(HurtKind::kStop, "agent 1");
  const HurtVerdict verdict = judge(HurtKind::kRestart, "agent 1");
  const auto* deed = std::get_if<RestartDeed>(&verdict.deed);
  ASSERT_NE(deed, nullptr);
  EXPECT_EQ(deed->process, "agent 1");
  EXPECT_TRUE(judge_.meant("agent 1")) << "the former one ends";
  const Answer answer = judge_.restarted("agent 1", std::nullopt);
  EXPECT_TRUE(answer.done);
  EXPECT_EQ(answer.text, "agent 1 was started anew");
  EXPECT_FALSE(judge_.meant("agent 1")) << "if this one ends, it does so by itself";
  EXPECT_FALSE(judge_.hangs("agent 1"));
  is_refused(judge(HurtKind::kLose, "agent 1", 0), "loses no packet on purpose");
}

TEST_F(HurtJudgeTest, ARestartThatFailsIsSaidAndMayBeAskedForAgain) {
  (void)judge(HurtKind::kRestart, "agent 1");
  end("agent 1");
  const Answer failed = judge_.restarted("agent 1", "agent 1: gyre-agent cannot be run");
  EXPECT_FALSE(failed.done);
  EXPECT_THAT(failed.text, AllOf(HasSubstr("gyre-agent cannot be run"), HasSubstr("agent 1 has ended")));
  EXPECT_TRUE(judge_.meant("agent 1")) << "the former one was ended on purpose: the flight has not failed";
  is_refused(judge(HurtKind::kStop, "agent 1"), "restart it first");
  EXPECT_TRUE(std::holds_alternative<RestartDeed>(judge(HurtKind::kRestart, "agent 1").deed));
}

// ------------------------------------------------------------------------------------------------- packets

TEST_F(HurtJudgeTest, LossIsForGoodUnlessNearlyAllIsLost) {
  HurtVerdict verdict = judge(HurtKind::kLose, "agent 1", 30);
  EXPECT_EQ(verdict.answer.text, "agent 1 loses 30 % of its packets");
  Disturbance loss = disturbance(verdict);
  EXPECT_EQ(loss.kind, DisturbanceKind::kLosePackets);
  EXPECT_EQ(loss.process, "agent 1");
  EXPECT_DOUBLE_EQ(loss.share, 0.3);
  EXPECT_EQ(loss.duration, Duration::zero());
  is_refused(judge(HurtKind::kLose, "agent 1", 30), "agent 1 loses 30 % of its packets as it is: nothing changed");
  verdict = judge(HurtKind::kLose, "agent 1", 100);
  EXPECT_EQ(verdict.answer.text, "agent 1 loses 100 % of its packets for 10 s");
  loss = disturbance(verdict);
  EXPECT_EQ(loss.duration, seconds(10));
  EXPECT_FALSE(protocol::objection(loss, {}));
  EXPECT_EQ(disturbance(judge(HurtKind::kLose, "agent 1", 100)).duration, seconds(10)) << "for longer, then";
}

TEST_F(HurtJudgeTest, LossEndsWhenItIsAskedForAndNotTwice) {
  is_refused(judge(HurtKind::kLose, "agent 1", 0), "agent 1 loses no packet on purpose: nothing changed");
  (void)judge(HurtKind::kLose, "agent 1", 60);
  const HurtVerdict verdict = judge(HurtKind::kLose, "agent 1", 0);
  EXPECT_EQ(disturbance(verdict).share, 0.0);
  EXPECT_EQ(verdict.answer.text, "agent 1 loses no packet on purpose any more");
  (void)judge(HurtKind::kLose, "agent 1", 100);
  now_ += seconds(9);
  EXPECT_TRUE(judge(HurtKind::kLose, "agent 1", 0).answer.done);
  (void)judge(HurtKind::kLose, "agent 1", 100);
  now_ += seconds(10);
  is_refused(judge(HurtKind::kLose, "agent 1", 0), "nothing changed");
}

TEST_F(HurtJudgeTest, WhereNobodyListensNothingIsPromised) {
  seen_.laboratory_listens = false;
  is_refused(judge(HurtKind::kLose, "agent 1", 30), "ask again");
  is_refused(push(1.0, 0.5), "ask again");
  EXPECT_TRUE(judge(HurtKind::kStop, "agent 1").answer.done) << "a signal needs no listener";
}

// ------------------------------------------------------------------------------------------------- clocks

TEST_F(HurtJudgeTest, AClockIsShiftedWithinTheBoundsOfTheProcessesInWordsThatSayThem) {
  const HurtVerdict verdict = judge(HurtKind::kShiftClock, "agent 1", 3600);
  EXPECT_EQ(verdict.answer.text, "the clock of agent 1 was shifted by +3600 s");
  EXPECT_EQ(disturbance(verdict).shift, std::chrono::hours(1));
  for (const double wrong : {-100.0, 0.0, 3601.0, -5.1}) {
    is_refused(judge(HurtKind::kShiftClock, "agent 2", wrong),
               "a clock is shifted by 5 s back to 3600 s on, and not by nothing");
  }
  is_refused(judge(HurtKind::kShiftClock, "simulator", 1), "the simulator's clock is the world's time");
}

TEST_F(HurtJudgeTest, AClockThatStandsStillIsShiftedBackWhenItGoesAgain) {
  EXPECT_EQ(disturbance(judge(HurtKind::kShiftClock, "agent 1", -3)).shift, -seconds(3));
  now_ += milliseconds(3900);  // it stood still for 3 s, and has gone on for less than one
  is_refused(judge(HurtKind::kShiftClock, "agent 1", -3), "stands still as it is");
  EXPECT_TRUE(judge(HurtKind::kShiftClock, "agent 1", 1).answer.done) << "forwards it may be shifted";
  EXPECT_TRUE(judge(HurtKind::kShiftClock, "agent 2", -3).answer.done) << "another one's";
  now_ += milliseconds(200);
  EXPECT_TRUE(judge(HurtKind::kShiftClock, "agent 1", -3).answer.done);
}

TEST_F(HurtJudgeTest, AllShiftsTogetherAreBoundedUntilTheProcessBeginsAnew) {
  int done = 0;
  while (done < 200 && judge(HurtKind::kShiftClock, "agent 1", 3600).answer.done) ++done;
  EXPECT_EQ(done, 100);
  is_refused(judge(HurtKind::kShiftClock, "agent 1", 3600), "has been shifted by 360000 s already");
  (void)judge(HurtKind::kRestart, "agent 1");
  (void)judge_.restarted("agent 1", std::nullopt);
  EXPECT_TRUE(judge(HurtKind::kShiftClock, "agent 1", 3600).answer.done);
}

// ------------------------------------------------------------------------------------------------- pushes

TEST_F(HurtJudgeTest, APushIsTheSimulators) {
  const HurtVerdict verdict = push(-1.5, 0.5);
  EXPECT_EQ(verdict.answer.text, "the load was pushed with 1.5 N for 0.5 s");
  const Disturbance deed = disturbance(verdict);
  EXPECT_EQ(deed.process, "simulator");
  EXPECT_EQ(deed.kind, DisturbanceKind::kPushLoad);
  EXPECT_EQ(deed.force_w_n, Eigen::Vector3d(0.0, -1.5, 0.0));
  EXPECT_EQ(deed.duration, milliseconds(500));
  (void)judge(HurtKind::kKill, "simulator");
  is_refused(push(1.0, 0.5), "simulator has ended");
}

TEST_F(HurtJudgeTest, APushBeyondTheWeightIsRefusedWithTheWeight) {
  EXPECT_TRUE(push(kWeight_n, 10.0).answer.done);
  is_refused(push(1.001 * kWeight_n, 0.5), "the load weighs 2.943 N, and is pushed by no more");
  is_refused(push(-1e6, 0.5), "a push of 1e+06 N");
  is_refused(push(1.0, 0.0), "for more than 0 and at most 10 s");
  is_refused(push(1.0, 10.5), "for more than 0 and at most 10 s");
  is_refused(push(std::numeric_limits<double>::quiet_NaN(), 0.5), "nothing can be");
}

}  // namespace
}  // namespace gyre::ground
