// How a swarm is judged from outside: when it is calm, what it is told to be wrong, and how far the load moved.

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "ground/swarm/account_text.hpp"
#include "ground/swarm/core/swarm_watch.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr protocol::PlanNumber kMotion{0x10000, 2}, kOther{0x10000, 3};
constexpr double kGravity = 10.0;

mission::Mission mission() {
  mission::Mission m;
  m.plan.load.mass_kg = 2.0;
  m.plan.load.inertia_b_kg_m2 = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
  m.plan.load.position_w_m = {1.0, 2.0, 3.0};
  m.plan.gravity_m_s2 = kGravity;
  mechanics::Carrier carrier;
  carrier.id = 1;
  carrier.attachment_b_m = {0.0, 0.5, 0.0};
  m.plan.carriers = {carrier};
  m.load_tolerance = {0.001, 0.1};
  return m;
}

class WatchTest : public testing::Test {
 protected:
  WatchTest() {
    beacon_.term = status_.term = kMotion.term;
    beacon_.course.term = beacon_.term;
    beacon_.swarm_time = kNow;
    beacon_.course.base.number = kMotion;
    beacon_.course.pace = at_pace(1.0);
    beacon_.course.wish = {1.0, false, protocol::Wisher::kPerson};
    beacon_.course.lease = kNow + seconds(5);
    status_.plan = kMotion;
    status_.skew_budget = milliseconds(10);
    status_.skew = milliseconds(1);
    load_.position_w_m = {1.0, 2.0, 3.0};
  }

  void hear_all() {
    watch_.see(now_, beacon_);
    watch_.see(now_, status_);
    see_load();
  }
  void see_load() {
    load_.stamp = now_;
    watch_.see(now_, load_);
  }
  [[nodiscard]] Account account() { return watch_.account(now_); }
  [[nodiscard]] std::string complaint() { return account().complaint; }

  static protocol::Pace at_pace(double pace) {
    return {{{SwarmTime{}, Duration{}, {PlanTime{}, pace, 0.0, 0.0}, pace}}};
  }

  static constexpr SwarmTime kNow{seconds(5000)};
  LocalTime now_{seconds(100)};
  SwarmWatch watch_{mission(), now_};
  protocol::Beacon beacon_;
  protocol::CoordinatorStatus status_;
  protocol::LoadState load_;
};

TEST_F(WatchTest, ASecondSimulatorThatComesAndGoesIsNotTheLoad) {
  for (int i = 0; i < 200; ++i) {
    hear_all();
    if (i > 50 && i < 150) {
      protocol::LoadState other = load_;
      other.incarnation = 5;
      other.position_w_m.x() += 0.5;
      watch_.see(now_ + milliseconds(3), other);
    }
    now_ += milliseconds(10);
  }
  EXPECT_LT(account().load.displacement_max_m, 1e-9);
}

TEST_F(WatchTest, IsCalmOnlyWhenEverythingIsHeardAndAsItShouldBe) {
  EXPECT_EQ(complaint(), "the coordinator is not heard");
  watch_.see(now_, beacon_);
  EXPECT_EQ(complaint(), "nobody tells where the load is");
  EXPECT_EQ(watch_.out_of_contact(now_), "nobody tells where the load is");
  see_load();
  EXPECT_EQ(complaint(), "the coordinator beacons, but does not say how it is");
  EXPECT_FALSE(watch_.out_of_contact(now_));
  watch_.see(now_, status_);
  EXPECT_TRUE(account().calm());
  EXPECT_EQ(account().course, "motion");
  now_ += milliseconds(501);
  EXPECT_EQ(complaint(), "the coordinator is not heard");
  hear_all();
  EXPECT_TRUE(account().calm());
}

TEST_F(WatchTest, SaysWhatIsWrong) {
  hear_all();
  const auto with = [this](auto change) {
    auto status = status_;
    auto beacon = beacon_;
    change(status, beacon);
    watch_.see(now_, status);
    watch_.see(now_, beacon);
    const std::string words = complaint();
    hear_all();
    EXPECT_TRUE(account().calm());
    return words;
  };
  using Status = protocol::CoordinatorStatus;
  using Beacon = protocol::Beacon;
  EXPECT_EQ(with([](Status& s, Beacon&) { s.silent = {3}; }), "carrier 3 is silent");
  EXPECT_EQ(with([](Status&, Beacon& b) {
              b.course.transitions = {{{kOther, {}}, {}, seconds(1)}};
            }),
            "a transition is under way");
  EXPECT_EQ(with([](Status&, Beacon& b) { b.course.base.number = kOther; }),
            "the load is not held by the mission's plan");
  EXPECT_EQ(
      with([](Status&, Beacon& b) { b.course.pace = at_pace(1.0).with_ramp(kNow + seconds(1), seconds(2), 1.0); }),
      "the pace is changing");
  EXPECT_EQ(with([](Status&, Beacon& b) { b.course.lease = kNow - seconds(1); }), "the pace is changing");
  EXPECT_EQ(with([](Status&, Beacon& b) { b.proposal = b.course; }), "a change is proposed");
  EXPECT_EQ(with([](Status&, Beacon& b) { b.course.wish.pace = 0.0; }), "rest is wished, and not agreed yet");
  EXPECT_EQ(with([](Status&, Beacon& b) {
              b.course.pace = at_pace(0.0);
              b.course.wish = {0.0, false, protocol::Wisher::kSilence};
            }),
            "all have stopped, because somebody fell silent");
  EXPECT_EQ(with([](Status& s, Beacon&) { s.skew = milliseconds(11); }),
            "the clocks may disagree by 11 ms, the plan in force allows 10 ms");
  EXPECT_EQ(with([](Status& s, Beacon&) { s.skew_budget = Duration::zero(), s.skew = seconds(9); }), "");
  watch_.see(now_, protocol::Health{"agent 2", "its vehicle is silent", {}, 0, 0, 0});
  EXPECT_EQ(complaint(), "agent 2: its vehicle is silent");
  watch_.see(now_, protocol::Health{"agent 2", "", {}, 0, 0, 0});
  EXPECT_TRUE(account().calm());
  load_.position_w_m.z() += 0.0015;
  see_load();
  EXPECT_EQ(complaint(), "the load is 1.5 mm away, the mission allows 1 mm");
  load_.position_w_m.z() -= 0.0015;
  load_.orientation_w_b = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX());
  see_load();
  EXPECT_EQ(complaint(), "the load is turned by 0.573 degrees, the mission allows 0.1");
}

TEST_F(WatchTest, IsCalmAtEveryPaceThatWasWished) {
  for (const auto& [pace, words] : {std::pair{0.0, "rest"}, {0.5, "motion at 50 %"}, {1.0, "motion"}}) {
    beacon_.course.pace = at_pace(pace);
    beacon_.course.wish.pace = pace;
    hear_all();
    const Account a = account();
    EXPECT_TRUE(a.calm()) << a.complaint;
    EXPECT_EQ(a.course, words);
  }
}

TEST_F(WatchTest, ALoadThatIsNowhereIsNotCalm) {
  hear_all();
  load_.position_w_m.x() = std::numeric_limits<double>::quiet_NaN();
  now_ += milliseconds(501);
  hear_all();
  EXPECT_EQ(complaint(), "nobody tells where the load is");
  EXPECT_EQ(account().load.samples, 0U);
}

TEST_F(WatchTest, KeepsEveryPeakForOneAccount) {
  hear_all();
  load_.position_w_m.x() += 0.004;
  see_load();
  load_.position_w_m.x() -= 0.003;
  see_load();
  const Account peak = account();
  EXPECT_NEAR(peak.load.displacement_max_m, 0.004, 1e-12);
  EXPECT_EQ(peak.load.samples, 3U);
  see_load();
  EXPECT_NEAR(account().load.displacement_max_m, 0.001, 1e-12) << "the next window begins afresh";
  EXPECT_EQ(account().load.samples, 0U);
}

TEST_F(WatchTest, TakesTheResidualFromHowTheLoadIsAccelerated) {
  hear_all();
  (void)account();
  load_.velocity_w_m_s.x() = 0.02;
  now_ += milliseconds(10);
  see_load();  // 2 m/s2 of 2 kg against 20 N
  EXPECT_NEAR(account().load.residual_max, 0.2, 1e-9);
  now_ += milliseconds(10);
  see_load();
  EXPECT_NEAR(account().load.residual_max, 0.0, 1e-12) << "a steady drift leaves nothing unbalanced";
  load_.angular_velocity_b_rad_s.z() = 0.01;
  now_ += milliseconds(10);
  see_load();  // 3 kg m2 by 1 rad/s2, at 0.5 m, against 20 N
  EXPECT_NEAR(account().load.residual_max, 0.3, 1e-9);
  now_ -= milliseconds(20);
  load_.velocity_w_m_s.x() = 9.0;
  see_load();
  EXPECT_EQ(account().load.residual_max, 0.0) << "out of order: no rate of change in it";
}

TEST_F(WatchTest, BelievesTheNewerOfTwoCoordinatorsAndALaterOneWhenThatIsSilent) {
  hear_all();
  auto older = beacon_;
  older.term = 7;
  older.course.base.number = kOther;
  watch_.see(now_, older);
  EXPECT_TRUE(account().calm()) << "one that is being fenced off";
  now_ += seconds(4);
  hear_all();
  EXPECT_TRUE(account().calm());
}

TEST_F(WatchTest, KeepsForOneAccountHowLateEachProcessWoke) {
  hear_all();
  for (const int late_ms : {3, 250, 7}) {
    watch_.see(now_, protocol::Health{"agent 2", "", {}, 0, 0, 0, milliseconds(late_ms)});
    watch_.see(now_, protocol::Health{"simulator", "", {}, 0, 0, 0, milliseconds(1)});
  }
  const Account a = account();
  const auto json = nlohmann::json::parse(account_json(a));
  EXPECT_EQ(json["late_s"], nlohmann::json({{"agent 2", 0.25}, {"simulator", 0.001}}));
  EXPECT_NE(account_line(a).find("; agent 2 woke at most 250.0 ms late;"), std::string::npos) << account_line(a);
  EXPECT_TRUE(account().late_max.empty());
}

TEST_F(WatchTest, SpeaksToPeopleAndToPrograms) {
  hear_all();
  watch_.see(now_, protocol::Health{"agent \"2\"", "line\nbreak", {}, 0, 0, 0});
  const Account a = account();
  const auto json = nlohmann::json::parse(account_json(a));
  EXPECT_EQ(account_json(a).find('\n'), std::string::npos) << "one line";
  EXPECT_EQ(json["calm"], false);
  EXPECT_EQ(json["course"], "motion");
  EXPECT_EQ(json["term"], 1);
  EXPECT_EQ(json["complaints"]["agent \"2\""], "line\nbreak");
  EXPECT_EQ(json["load"]["displacement_allowed_m"], 0.001);
  EXPECT_EQ(json["skew_s"], 0.001);
  EXPECT_EQ(json["skew_budget_s"], 0.01);
  EXPECT_NE(account_line(a).find("clocks within 1 ms of 10"), std::string::npos) << account_line(a);
  EXPECT_TRUE(nlohmann::json::parse(account_json(Account{}))["skew_budget_s"].is_null()) << "any";
}

}  // namespace
}  // namespace gyre::ground
