// An agent whose own clock leaps, or stands still, in full motion: what it says meanwhile, and how soon it is right
// again. And what only looks like a leap.

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "common/protocol/follow.hpp"
#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

/// What is said in true time, millisecond by millisecond; the agent sees it by its own clock.
class LeapTest : public AgentTest {
 protected:
  void SetUp() override { begin(); }
  void begin() {
    restart(1);
    under_way_.clear();
    inbox_.clear();
    offer({kMotion, kOther});
    course(kMotion, 1.0);
    vehicle_at_rest();
    vehicle_->incarnation = 7;
    live(seconds(6));
    ASSERT_GT(said_, 300);
    begin_counting();
  }

  void begin_counting() {
    said_ = wrong_ = 0;
    silent_since_ = true_now_;
    longest_silence_ = worst_ = Duration::zero();
    heard_.clear();
  }

  void leap(Duration by) {
    now_ += by;
    off_ -= by;
  }

  /// Ticks come when they are due by the clock here; what arrives waits for them, with its stamp.
  void live(Duration length) {
    for (const Duration end = true_now_ + length; true_now_ < end; true_now_ += milliseconds(1), pass()) {
      const auto ms = std::chrono::duration_cast<milliseconds>(true_now_).count();
      if ((ms + phase_ms_) % 10 == 3 && vehicle_tells_) send(on_board_, Heard<protocol::CarrierState>{there(), {}});
      if ((ms + phase_ms_) % 20 == 7) send(way_, Heard<Beacon>{said_by_the_coordinator(), {}});
      for (auto it = under_way_.begin(); it != under_way_.end();) {
        if (it->at > true_now_) {
          ++it;
          continue;
        }
        std::visit([this](auto& e) { stamp(e); }, it->event);
        inbox_.push_back(std::move(it->event));
        it = under_way_.erase(it);
      }
      if (now_ >= next_ && true_now_ >= runs_from_) beat();
    }
  }

  Duration true_now_{};
  Duration way_ = milliseconds(1);       ///< to and from the coordinator
  Duration on_board_ = milliseconds(1);  ///< from the vehicle
  Duration runs_from_{};                 ///< the process is not run before
  Duration stands_still_{};              ///< its clock, for so long
  Duration vehicle_ahead_{};             ///< the vehicle's clock
  int phase_ms_ = 0;                     ///< of all that is said, against the beat here
  bool vehicle_tells_ = true;
  bool answered_ = true;
  int said_ = 0;   ///< setpoints
  int wrong_ = 0;  ///< of them, for another time than it is
  Duration worst_{};
  Duration longest_silence_{};

 private:
  struct UnderWay {
    Duration at{};
    Event event;
  };

  void pass() {
    if (stands_still_ > Duration::zero()) {
      stands_still_ -= milliseconds(1);
      off_ += milliseconds(1);
    } else {
      now_ += milliseconds(1);
    }
  }
  void send(Duration way, Event event) { under_way_.push_back({true_now_ + way, std::move(event)}); }
  template <class T>
  void stamp(Heard<T>& heard) {
    heard.arrived = now_;
  }
  void stamp(TimeReplyArrived& reply) { reply.arrived = now_; }
  template <class T>
  void stamp(T& /*other*/) {}

  [[nodiscard]] SwarmTime truly() const { return swarm() + off_; }

  [[nodiscard]] Beacon said_by_the_coordinator() {
    course_->term = term_;
    return {term_, ++sequence_, truly(), *course_, proposal_, {}};
  }
  /// On its course, as a vehicle is that goes on along its path.
  [[nodiscard]] protocol::CarrierState there() {
    const mechanics::CarrierSlice s = slice(kMotion);
    const auto r = protocol::reference(*course_, truly(), [&s](const PlanNumber&) { return &s; });
    vehicle_->stamp = LocalTime(true_now_ + vehicle_ahead_);
    vehicle_->position_w_m = r->position_w_m.value;
    vehicle_->velocity_w_m_s = r->position_w_m.first;
    const auto winch = mechanics::paid_out(*r, s.cable_stiffness_n_m);
    vehicle_->winch_length_m = winch.value;
    vehicle_->winch_rate_m_s = winch.first;
    return *vehicle_;
  }

  void beat() {
    for (const Event& event : inbox_) tell(event);
    inbox_.clear();
    const Outputs out = tell(Tick{});
    next_ = out.next_tick;
    if (out.time_request && answered_) {
      const SwarmTime then = truly() + way_;
      const protocol::TimeRequest& asked = *out.time_request;
      send(2 * way_,
           TimeReplyArrived{{1, asked.incarnation, asked.sequence, term_, asked.sent, then, then, 0, ""}, {}});
    }
    if (!out.setpoint) return;
    const Duration off = out.setpoint->swarm_time - truly();
    worst_ = std::max({worst_, off, -off});
    if (off > milliseconds(1) || off < milliseconds(-1)) ++wrong_;
    ++said_;
    longest_silence_ = std::max(longest_silence_, true_now_ - silent_since_);
    silent_since_ = true_now_;
  }

  LocalTime next_ = LocalTime::min();
  Duration silent_since_{};
  std::deque<UnderWay> under_way_;
  std::deque<Event> inbox_;
};

TEST_F(LeapTest, IsNotFlownButForABeatOrTwoAndOverWithinSixOfThem) {
  for (const int by_ms : {5, 8, 12, 20, 50, 300, -5, -20, -50}) {
    for (const int phase_ms : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}) {
      live(seconds(1) + milliseconds(phase_ms));
      begin_counting();
      if (by_ms > 0) leap(milliseconds(by_ms));
      if (by_ms < 0) stands_still_ = milliseconds(-by_ms);
      live(seconds(1));
      EXPECT_LE(wrong_, 2) << by_ms << " ms at " << phase_ms;
      EXPECT_LE(longest_silence_, milliseconds(60 + std::max(0, -by_ms))) << by_ms << " ms at " << phase_ms;
      EXPECT_NE(heard_.find("this clock leapt by"), std::string::npos) << by_ms << " ms at " << phase_ms;
    }
  }
  live(seconds(2));
  EXPECT_LT(off_the_plan_m(), 1e-4) << "and nothing of it is left";
}

TEST_F(LeapTest, OfSecondsIsFoundOutAtOnceToo) {
  leap(seconds(5));
  live(seconds(1));
  EXPECT_EQ(wrong_, 0);
  EXPECT_LT(longest_silence_, milliseconds(250)) << "it begins where its vehicle has got to";
  EXPECT_EQ(heard_.find("alone"), std::string::npos) << "nobody was silent";
}

// What it flies by a clock that leapt is not what it forgets by it: a ramp that would have passed by then has not.
TEST_F(LeapTest, OfSecondsWhileThePaceChangesDoesNotForgetTheChange) {
  for (const bool answered : {true, false}) {
    ramp(milliseconds(100), seconds(2), course_->pace.target() > 0.7 ? 0.5 : 1.0);
    live(seconds(1));
    answered_ = answered;
    leap(seconds(5));
    live(milliseconds(200));
    answered_ = true;
    live(seconds(8));
    EXPECT_LT(off_the_plan_m(), 1e-4) << answered;
  }
}

TEST_F(LeapTest, IsFoundOutWithoutAVehicleThatTellsWhereABeatShowsIt) {
  vehicle_tells_ = false;
  live(seconds(3));
  begin_counting();
  leap(milliseconds(50));
  live(seconds(1));
  EXPECT_EQ(wrong_, 0);
  EXPECT_LE(longest_silence_, milliseconds(70));
}

TEST_F(LeapTest, IsFoundOutWhereMessagesAreLateBySometimesMore) {
  for (int i = 0; i < 100; ++i) {
    on_board_ = milliseconds(i % 5 == 0 ? 9 : 1);
    live(milliseconds(10));
  }
  begin_counting();
  leap(milliseconds(50));
  live(milliseconds(500));
  EXPECT_EQ(wrong_, 0);
  EXPECT_LE(longest_silence_, milliseconds(80));
}

// Too little to be seen at once there; the first exchange that contradicts is not alone all the same.
TEST_F(LeapTest, SmallerThanMessagesAreLateIsFoundOutByOneExchangeOrTwo) {
  const auto vary = [this](int beats) {
    for (int i = 0; i < beats; ++i) {
      on_board_ = milliseconds(i % 3 == 0 ? 8 : 1);
      live(milliseconds(10));
    }
  };
  for (int phase = 0; phase < 13; ++phase) {
    vary(100 + phase);
    begin_counting();
    leap(milliseconds(5));
    vary(100);
    EXPECT_LE(wrong_, 14) << phase;
  }
}

TEST_F(LeapTest, WhileAnExchangeIsOnItsWayIsJudgedByTheNext) {
  way_ = milliseconds(15);
  for (int phase = 0; phase < 13; ++phase) {
    live(seconds(1) + phase * milliseconds(10));
    begin_counting();
    leap(milliseconds(50));
    live(milliseconds(500));
    EXPECT_EQ(wrong_, 0) << phase;
  }
}

TEST_F(LeapTest, OneMoreRightAfterItIsSeenAsWell) {
  for (int i = 0; i < 3; ++i) {
    leap(milliseconds(30));
    live(milliseconds(100));
  }
  EXPECT_EQ(wrong_, 0);
}

// Nor is anything taken over by it: a course that is heard meanwhile begins at its own time.
TEST_F(LeapTest, DoesNotBeginACourseAtAnotherTime) {
  const mechanics::CarrierSlice s = slice(kMotion);
  for (phase_ms_ = 0; phase_ms_ < 10; ++phase_ms_) {
    begin();
    ramp(milliseconds(60), milliseconds(500), 0.2);
    leap(milliseconds(280));
    live(milliseconds(600));
    EXPECT_EQ(status_->course.revision, course_->revision);
    const auto r = protocol::reference(*course_, setpoint_->swarm_time, [&s](const PlanNumber&) { return &s; });
    EXPECT_LT((setpoint_->position_w_m - r->position_w_m.value).norm(), 1e-6) << phase_ms_;
  }
}

TEST_F(LeapTest, IsWaitedForNoLongerThanItHasTo) {
  answered_ = false;
  leap(milliseconds(50));
  live(seconds(1));
  EXPECT_LT(longest_silence_, milliseconds(350));
}

// ------------------------------------------------------------------------------------------- what only looks like one

TEST_F(LeapTest, ANetworkThatGetsSlowerIsNone) {
  way_ = milliseconds(21);
  live(seconds(1));
  EXPECT_EQ(longest_silence_, milliseconds(10)) << "the vehicle's word is as young as ever";
  on_board_ = milliseconds(21);
  live(seconds(2));
  EXPECT_EQ(wrong_, 0);
  EXPECT_LE(longest_silence_, milliseconds(80)) << "until an exchange has told";
  EXPECT_EQ(heard_, "");
  begin_counting();
  way_ = on_board_ = milliseconds(1);
  live(seconds(2));
  EXPECT_EQ(wrong_, 0);
  EXPECT_LE(longest_silence_, milliseconds(80)) << "and back";
  EXPECT_EQ(heard_, "");
}

TEST_F(LeapTest, TheCoordinatorsClockIsNotTakenForTheOwn) {
  for (phase_ms_ = 0; phase_ms_ < 10; ++phase_ms_) {
    begin();
    off_ -= milliseconds(50);
    live(milliseconds(500));
    EXPECT_EQ(longest_silence_, milliseconds(10)) << phase_ms_;
    EXPECT_EQ(heard_, "") << phase_ms_;
  }
}

TEST_F(LeapTest, AProcessThatWasNotRunSaysWhatItHasToAtOnce) {
  runs_from_ = true_now_ + milliseconds(100);
  live(seconds(1));
  EXPECT_LE(longest_silence_, milliseconds(110)) << "what arrived meanwhile shows that its clock went on";
  EXPECT_EQ(wrong_, 0);
  EXPECT_EQ(heard_, "");
}

TEST_F(LeapTest, AVehicleThatIsLateByTurnsFromNowOnIsSoonUsual) {
  for (phase_ms_ = 0; phase_ms_ < 10; ++phase_ms_) {
    begin();
    for (int i = 0; i < 200; ++i) {
      on_board_ = milliseconds(i % 2 == 0 ? 6 : 1);
      live(milliseconds(10));
    }
    EXPECT_GE(said_, 190) << phase_ms_;
    EXPECT_EQ(wrong_, 0) << phase_ms_;
  }
}

TEST_F(LeapTest, AVehicleWhoseClockLeapsIsBelievedByNobody) {
  vehicle_ahead_ = milliseconds(-40);
  live(seconds(1));
  EXPECT_EQ(wrong_, 0);
  EXPECT_LE(longest_silence_, milliseconds(90));
  EXPECT_EQ(heard_, "");
}

}  // namespace
}  // namespace gyre::agent
