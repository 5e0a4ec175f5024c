// What an agent lets in, and what it lets out: no counter that leaps, and no setpoint that does.

#include <limits>

#include "agent/core/step_judge.hpp"
#include "tests/agent/one_agent.hpp"

namespace gyre::agent {
namespace {

constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();

class DoorTest : public AgentTest {
 protected:
  [[nodiscard]] Beacon last_beacon() const { return {term_, sequence_, swarm() + off_, *course_, proposal_, {}}; }
  void expect_it_still_hears() {
    const auto received = status_->beacons_received;
    ++course_->revision;
    fly(seconds(1));
    EXPECT_GT(status_->beacons_received, received + 90);
    EXPECT_EQ(status_->course.revision, course_->revision);
    EXPECT_EQ(status_->term, term_);
  }
};

TEST_F(DoorTest, ABeaconOfALargeCountMakesItDeafToNobody) {
  rest();
  for (const std::uint64_t count : {kLargest, kLargest / 2, std::uint64_t{1} << 40, std::uint64_t{100000000}}) {
    const auto tell_broken = [&](const std::function<void(Beacon&)>& breakage) {
      Beacon broken = last_beacon();
      ++broken.sequence;
      breakage(broken);
      const auto nonsense = agent_->dropped().nonsense;
      tell(broken);
      EXPECT_EQ(agent_->dropped().nonsense, nonsense + 1);
      expect_it_still_hears();
    };
    tell_broken([&](Beacon& b) { b.sequence = count; });
    tell_broken([&](Beacon& b) { b.term = b.course.term = count; });
    tell_broken([&](Beacon& b) { b.course.revision = count; });
  }
}

TEST_F(DoorTest, ABeaconOfALargeCountThatCameFirstIsGotOver) {
  offer({kMotion, kOther});
  course(kMotion);
  vehicle_at_rest();
  Beacon broken = last_beacon();
  broken.sequence = std::uint64_t{1} << 40;
  tell(broken);
  fly(seconds(3));
  expect_it_still_hears();
}

TEST_F(DoorTest, AnOfferOfALargeCountHidesNoneThatFollows) {
  rest();
  for (const std::uint64_t count : {kLargest, std::uint64_t{1} << 40}) {
    protocol::PlanOffer broken = plans({kMotion, kOther});
    broken.sequence = count;
    tell(broken);
    broken = plans({kMotion, kOther});
    broken.term = count;
    tell(broken);
    offer({kMotion});
    fly(milliseconds(200));
    EXPECT_EQ(status_->accepted, std::vector<PlanNumber>{kMotion}) << "the last one counts";
    offer({kMotion, kOther});
    fly(milliseconds(200));
    EXPECT_EQ(status_->accepted.size(), 2U);
    EXPECT_EQ(status_->term, kTerm);
  }
}

TEST_F(DoorTest, WhoWasAwayForANightHearsTheCoordinatorThatLeadsByThen) {
  rest();
  fly(std::chrono::hours(1) / 360, false);
  term_ = std::uint64_t{500} << protocol::kTermNonceBits;
  sequence_ = 1000000;
  course_->term = term_;
  course_->revision = 5000;
  // The plans come first, and once.
  offer({{term_, 7}, kMotion}, term_);
  fly(seconds(1));
  EXPECT_EQ(status_->term, term_);
  EXPECT_EQ(status_->course.revision, 5000U);
  EXPECT_EQ(status_->accepted.size(), 2U);
  expect_it_still_hears();
}

TEST_F(DoorTest, ItsOwnSetpointThatStepsIsWithheldAndItGoesOnFromItsVehicle) {
  engage();
  fly(seconds(3));
  vehicle_ = protocol::CarrierState{};
  vehicle_->carrier = 1;
  // Over to another plan within a nanosecond: nobody honest agrees that.
  transition(kOther, milliseconds(205), Duration(1));
  bool complained = false;
  LocalTime told = now_;
  visit_ = [this, &told](const protocol::Setpoint& s) {
    if (now_ - told < milliseconds(50)) {
      EXPECT_LT((s.position_w_m - vehicle_->position_w_m).norm(), 0.1);
    } else {
      // After its silence it begins where the vehicle says it is.
      EXPECT_LT((s.position_w_m - vehicle_->position_w_m).norm(), 1e-3);
    }
    told = now_;
    vehicle_->position_w_m = s.position_w_m;
    vehicle_->velocity_w_m_s = Eigen::Vector3d::Zero();
    vehicle_->winch_length_m = s.winch_length_m;
  };
  vehicle_->position_w_m = setpoint_->position_w_m;
  vehicle_->winch_length_m = setpoint_->winch_length_m;
  for (int i = 0; i < 100; ++i) {
    fly(milliseconds(10));
    const auto complaint = agent_->complaint(now_);
    complained = complained || (complaint && complaint->find("its own setpoint steps by") == 0);
  }
  EXPECT_TRUE(complained);
  EXPECT_NE(heard_.find("its own setpoint steps by"), std::string::npos) << heard_;
  fly(seconds(60));
  EXPECT_FALSE(agent_->complaint(now_)) << *agent_->complaint(now_);
  EXPECT_LT(off_the_plan_m(), 1e-6) << "it does not stay silent";
}

class StepJudgeTest : public testing::Test {
 protected:
  /// On a circle of 2 m, at 10 m/s.
  [[nodiscard]] static protocol::Setpoint at(Duration time) {
    const double phase = 5.0 * gyre::seconds(time);
    protocol::Setpoint s;
    s.swarm_time = SwarmTime(time);
    s.position_w_m = 2.0 * Eigen::Vector3d(std::cos(phase), std::sin(phase), 0.0);
    s.velocity_w_m_s = 10.0 * Eigen::Vector3d(-std::sin(phase), std::cos(phase), 0.0);
    s.acceleration_w_m_s2 = -25.0 * s.position_w_m;
    s.winch_length_m = 3.0;
    return s;
  }
  bool sends(Duration time, const std::function<void(protocol::Setpoint&)>& breakage = {}) {
    protocol::Setpoint s = at(time);
    if (breakage) breakage(s);
    return !judge_.objection(LocalTime(time), s);
  }
  [[nodiscard]] static mechanics::Limits limits() {
    mechanics::Limits limits;
    limits.speed_max_m_s = 12.0;
    return limits;
  }
  StepJudge judge_{limits(), milliseconds(500)};
};

TEST_F(StepJudgeTest, SendsAMotionWhateverIsLostOfIt) {
  for (int i = 0; i < 300; ++i) {
    EXPECT_TRUE(sends(milliseconds(10) * (i + (i / 7) * 20)));
  }
}

TEST_F(StepJudgeTest, WithholdsWhatLeapsOrIsNoNumberOrAbsurd) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(protocol::Setpoint&)>> breakages = {
      [](auto& s) { s.position_w_m.z() += 0.05; },    [](auto& s) { s.winch_length_m += 0.05; },
      [&](auto& s) { s.velocity_w_m_s.x() = nan; },   [&](auto& s) { s.tension_n = nan; },
      [](auto& s) { s.velocity_w_m_s.x() += 130.0; }, [](auto& s) { s.acceleration_w_m_s2.x() += 2000.0; },
      [](auto& s) { s.winch_rate_m_s = 400.0; },
  };
  Duration time{};
  for (const auto& breakage : breakages) {
    EXPECT_TRUE(sends(time += milliseconds(10)));
    EXPECT_FALSE(sends(time += milliseconds(10), breakage));
  }
  EXPECT_TRUE(sends(time += milliseconds(10)));
  EXPECT_TRUE(sends(time += milliseconds(600), [](auto& s) { s.position_w_m.z() += 5.0; })) << "it has gone on since";
  judge_.forget();
  EXPECT_TRUE(sends(time += milliseconds(10))) << "begun anew";
}

}  // namespace
}  // namespace gyre::agent
