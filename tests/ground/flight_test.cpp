// The verdict on a flight: what is certified is confirmed, what is outside is found, wherever it happens.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "common/mechanics/reference.hpp"
#include "common/mission/mission.hpp"
#include "common/protocol/course.hpp"
#include "ground/flight/core/flight_certificate.hpp"
#include "ground/flight/core/flight_progress.hpp"
#include "ground/flight/core/flight_record.hpp"
#include "ground/flight/core/flight_report.hpp"
#include "ground/flight/core/flight_table.hpp"
#include "tests/places.hpp"

namespace gyre::ground {
namespace {

constexpr double kRamp_s = 10.0;
constexpr protocol::PlanNumber kMotion{5, 2};  // whatever it is called

mission::Mission paper() {
  const auto mission = mission::read_mission_file(test::source_directory() + "/deploy/missions/paper.textproto");
  EXPECT_TRUE(mission) << mission.error().text;
  return mission.value();
}

SwarmTime at(double time_s) {
  return SwarmTime(from_seconds(time_s));
}

/// At rest, and from 5 s on to full pace.
protocol::Course engaging() {
  protocol::Course course;
  course.revision = 3;
  course.base = {kMotion, PlanTime{}};
  course.pace = course.pace.with_ramp(at(5.0), from_seconds(kRamp_s), 1.0);
  return course;
}

/// Flies a mission's references through the record, as a perfect swarm would.
class PerfectFlight {
 public:
  explicit PerfectFlight(const mission::Mission& mission)
      : mission_(mission), motion_(mechanics::slices(mission.plan)), certificate(mission.plan), record(mission.plan) {
    certificate.see(word(kMotion));
  }

  /// The coordinator's, while the mission in force has this motion.
  static protocol::CoordinatorStatus word(const protocol::PlanNumber& motion) {
    protocol::CoordinatorStatus status;
    status.plan = motion;
    return status;
  }

  void fly(const protocol::Course& course, double begin_s, double end_s) {
    certificate.include(course);
    for (double t = begin_s; t < end_s; t += 0.05) {
      for (std::size_t i = 0; i < motion_.size(); ++i) record.see(state(course, i, t), at_full_pace(course, t));
      record.see(load(t), LocalTime(from_seconds(t)));
    }
  }

  [[nodiscard]] protocol::CarrierState state(const protocol::Course& course, std::size_t i, double t) const {
    const protocol::PlanMoment moment = course.moment(at(t));
    const mechanics::Reference r = mechanics::evaluate(motion_[i], seconds(moment.at.time_since_epoch()));
    protocol::CarrierState state;
    state.carrier = motion_[i].id;
    state.position_w_m = r.position_w_m.value;
    state.velocity_w_m_s = moment.pace * r.position_w_m.first;
    state.tension_n = r.tension_n.value;
    state.cable_length_m = r.length_m.value;
    state.winch_rate_m_s = moment.pace * r.length_m.first;
    return state;
  }

  [[nodiscard]] protocol::LoadState load(double t) const {
    protocol::LoadState state;
    state.stamp = LocalTime(from_seconds(t));
    state.position_w_m = mission_.plan.load.position_w_m;
    state.orientation_w_b = mission_.plan.load.orientation_w_b;
    return state;
  }

  [[nodiscard]] FlightReport report() const { return judge_flight(mission_, certificate, record, 60.0); }

 private:
  static bool at_full_pace(const protocol::Course& course, double t) { return course.moment(at(t)).pace == 1.0; }

  const mission::Mission& mission_;
  std::vector<mechanics::CarrierSlice> motion_;

 public:
  FlightCertificate certificate;
  FlightRecord record;
};

class FlightTest : public testing::Test {
 protected:
  mission::Mission mission = paper();
  PerfectFlight flight{mission};

  void SetUp() override { flight.fly(engaging(), 0.0, 100.0); }

  [[nodiscard]] std::string violations() const {
    std::string all;
    for (const std::string& violation : flight.report().violations) all += violation + "\n";
    return all;
  }
};

TEST_F(FlightTest, ReferencesFlownExactlyAreInsideTheirCertificate) {
  const FlightReport report = flight.report();
  EXPECT_TRUE(report.good()) << violations();
  ASSERT_EQ(report.carriers.size(), mission.plan.carriers.size());
  for (const CarrierReport& carrier : report.carriers) {
    // A whole period was flown: the certified extremes are attained, to what samples can show.
    EXPECT_NEAR(carrier.tension_n.flown.min, carrier.tension_n.certified.min, 1e-3);
    EXPECT_NEAR(carrier.length_m.flown.max, carrier.length_m.certified.max, 1e-3);
  }
}

TEST_F(FlightTest, EveryFigureIsJudged) {
  const protocol::CarrierState good = flight.state(engaging(), 1, 40.0);
  const auto with = [&](auto change) {
    PerfectFlight other = flight;
    protocol::CarrierState state = good;
    change(state);
    other.record.see(state, true);
    const auto report = other.report();
    EXPECT_EQ(report.violations.size(), 1U);
    return report.violations.empty() ? std::string() : report.violations.front();
  };
  EXPECT_EQ(with([](auto& s) { s.tension_n = 0.1; }).find("carrier 2: tension 0.1 N in the motion"), 0U);
  EXPECT_EQ(with([](auto& s) { s.cable_length_m = 9.0; }).find("carrier 2: cable length 9 m in the motion"), 0U);
  EXPECT_EQ(with([](auto& s) { s.velocity_w_m_s.setZero(); }).find("carrier 2: speed 0 m/s in the motion"), 0U);
  EXPECT_EQ(with([](auto& s) { s.winch_rate_m_s = -1.0; }).find("carrier 2: winch rate -1 m/s in the motion"), 0U);
  EXPECT_EQ(with([](auto& s) { s.position_w_m.z() += 0.1; }).find("carrier 2: altitude"), 0U);
}

TEST_F(FlightTest, StandingStillIsForTheWayOnly) {
  protocol::CarrierState still = flight.state(engaging(), 0, 40.0);
  still.velocity_w_m_s.setZero();
  flight.record.see(still, false);
  EXPECT_EQ(violations(), "");
}

TEST_F(FlightTest, TheWayToFullPaceIsJudgedToo) {
  protocol::CarrierState state = flight.state(engaging(), 0, 9.0);
  state.tension_n = 30.0;
  flight.record.see(state, false);
  EXPECT_EQ(violations().find("carrier 1: tension 30 N on the way"), 0U) << violations();
  EXPECT_FALSE(flight.report().carriers[0].tension_n.inside);
}

TEST_F(FlightTest, AReleaseHalfWayThroughTheEngagementIsEnclosed) {
  protocol::Course course = engaging();
  course.pace = course.pace.with_ramp(at(10.0), from_seconds(kRamp_s), 0.0);
  PerfectFlight other(mission);
  other.fly(engaging(), 0.0, 10.0);
  other.fly(course, 10.0, 25.0);
  // Nothing was flown of the motion proper: that much is missing, and nothing is outside.
  const FlightReport report = other.report();
  EXPECT_EQ(report.violations.size(), mission.plan.carriers.size());
  for (const std::string& text : report.violations) EXPECT_NE(text.find("never received in the motion"), text.npos);
  other.fly(engaging(), 20.0, 100.0);
  EXPECT_TRUE(other.report().good());
}

TEST_F(FlightTest, AtLowerPacesPlacesAreTheSameAndSpeedsReachDownToRest) {
  for (const auto& carrier : flight.certificate.bounds()) {
    EXPECT_EQ(carrier.whole.length_m.span(), carrier.motion.length_m.span());
    EXPECT_EQ(carrier.whole.tension_n.span(), carrier.motion.tension_n.span());
    EXPECT_EQ(carrier.whole.speed_m_s.min, 0.0);
    EXPECT_EQ(carrier.whole.speed_m_s.max, carrier.motion.speed_m_s.max);
  }
}

TEST_F(FlightTest, TooFastAPaceIsOutside) {
  protocol::CarrierState hasty = flight.state(engaging(), 0, 9.0);
  hasty.velocity_w_m_s *= 1.2 * flight.certificate.bounds()[0].motion.speed_m_s.max / hasty.velocity_w_m_s.norm();
  flight.record.see(hasty, false);
  EXPECT_NE(violations().find("m/s on the way"), std::string::npos) << violations();
}

TEST_F(FlightTest, APlanOfNobodysMissionCannotBeJudged) {
  protocol::Course strange = engaging();
  strange.transitions = {{{{7, 3}, PlanTime{}}, PlanTime{}, from_seconds(kRamp_s)}};
  flight.certificate.include(strange);
  EXPECT_EQ(violations().find("the swarm went to a plan that is not of this mission"), 0U);
}

TEST_F(FlightTest, AnothersMotionCannotBeJudgedWhateverTheCoordinatorCallsIt) {
  constexpr protocol::PlanNumber kRetuned{7, 11};
  flight.certificate.see(PerfectFlight::word(kRetuned));
  flight.certificate.include(engaging());
  EXPECT_TRUE(flight.report().good()) << violations();
  protocol::Course retuned = engaging();
  retuned.base.number = kRetuned;
  flight.certificate.include(retuned);
  EXPECT_EQ(violations().find("the swarm went to a plan that is not of this mission"), 0U);
}

TEST_F(FlightTest, WhatIsFlownBeforeItIsKnownWhatItIsIsNotHeldAgainstTheFlight) {
  FlightCertificate certificate(mission.plan);
  certificate.include(engaging());
  EXPECT_TRUE(certificate.knows_all_plans());
  certificate.see(PerfectFlight::word(kMotion));
  certificate.include(engaging());
  EXPECT_TRUE(certificate.knows_all_plans());
}

TEST_F(FlightTest, TheLoadIsHeldToTheMissionsTolerance) {
  mission.load_tolerance.displacement_max_m = 0.01;
  protocol::LoadState load = flight.load(50.0);
  load.position_w_m.x() += 0.5 * mission.load_tolerance.displacement_max_m;
  flight.record.see(load, LocalTime(from_seconds(50.0)));
  EXPECT_TRUE(flight.report().load_inside);
  load.position_w_m.x() += mission.load_tolerance.displacement_max_m;
  flight.record.see(load, LocalTime(from_seconds(50.0)));
  EXPECT_EQ(violations().find("load: displaced by 15 mm, the mission allows 10 mm"), 0U) << violations();
}

TEST_F(FlightTest, NonsenseConfirmsNothing) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  FlightRecord record(mission.plan);
  protocol::LoadState load = flight.load(50.0);
  load.position_w_m.x() = kNowhere;
  record.see(load, LocalTime(from_seconds(50.0)));
  protocol::CarrierState state = flight.state(engaging(), 0, 40.0);
  state.tension_n = kNowhere;
  record.see(state, true);
  EXPECT_EQ(record.load().samples, 0U);
  EXPECT_EQ(record.carriers()[0].motion.samples, 0U);
}

TEST_F(FlightTest, ATurnIsSeenWhicheverSignTheQuaternionHas) {
  protocol::LoadState load = flight.load(50.0);
  load.orientation_w_b.coeffs() *= -1.0;
  flight.record.see(load, LocalTime(from_seconds(50.0)));
  EXPECT_LT(flight.record.load().rotation_max_deg, 1e-6);
  load.orientation_w_b = load.orientation_w_b * Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitX());
  flight.record.see(load, LocalTime(from_seconds(50.0)));
  EXPECT_NEAR(flight.record.load().rotation_max_deg, 90.0, 1e-6);
}

TEST_F(FlightTest, LatenessIsAgainstTheEarliest) {
  // Clocks of two machines: what they differ by says nothing.
  FlightRecord record(mission.plan);
  for (const double late_s : {1000.0, 1000.02, 1000.005}) {
    record.see(flight.load(7.0), LocalTime(from_seconds(7.0 + late_s)));
  }
  EXPECT_NEAR(seconds(record.timing().simulator_lag_max), 0.02, 1e-9);
}

TEST_F(FlightTest, WhoWokeTheLatestIsNamed) {
  EXPECT_EQ(flight_table(flight.report()).find("woke"), std::string::npos) << "nobody has told";
  protocol::Health health;
  for (const auto& [process, late_s] : {std::pair{"agent 1", 0.001}, {"agent 2", 0.4}, {"simulator", 0.01}}) {
    health.process = process;
    health.late_max = from_seconds(late_s);
    flight.record.see(health);
  }
  const std::string table = flight_table(flight.report());
  EXPECT_NE(table.find("agent 2 woke at most 400.0 ms late"), std::string::npos) << table;
}

TEST_F(FlightTest, BeaconsMissedBeforeTheFlightDoNotCount) {
  protocol::AgentStatus status;
  for (const auto& [carrier, missed] : {std::pair{1U, 40U}, {1U, 43U}, {2U, 5U}, {1U, 44U}}) {
    status.carrier = carrier;
    status.beacons_missed = missed;
    flight.record.see(status);
  }
  EXPECT_EQ(flight.record.timing().beacons_missed, 4U);
}

TEST_F(FlightTest, TheTableShowsEveryCarrierAndMarksWhatIsOutside) {
  const std::string good = flight_table(flight.report());
  for (const char* words : {"certified", "flown", "carrier 4", "altitude swing", "GOOD"}) {
    EXPECT_NE(good.find(words), std::string::npos) << good;
  }
  EXPECT_EQ(good.find('!'), std::string::npos) << good;

  protocol::CarrierState state = flight.state(engaging(), 3, 40.0);
  state.tension_n = 30.0;
  flight.record.see(state, true);
  const std::string bad = flight_table(flight.report());
  EXPECT_NE(bad.find("30 !"), std::string::npos) << bad;
  EXPECT_NE(bad.find("OUTSIDE"), std::string::npos) << bad;
  EXPECT_NE(bad.find("carrier 4: tension 30 N"), std::string::npos) << bad;
}

TEST(FlightProgress, LinesAreForNewsOnly) {
  ProgressLines lines;
  FlightProgress progress;
  progress.duration_s = 100.0;
  EXPECT_TRUE(lines.worth_a_line(progress));
  EXPECT_FALSE(lines.worth_a_line(progress));
  progress.phase = FlightPhase::kMatching;
  EXPECT_TRUE(lines.worth_a_line(progress));
  progress.agents_ready = 1;
  EXPECT_TRUE(lines.worth_a_line(progress));
  progress.phase = FlightPhase::kFlying;
  int count = 0;
  for (int i = 0; i <= 1000; ++i) {
    progress.flown_s = i * 0.1;
    count += lines.worth_a_line(progress) ? 1 : 0;
  }
  EXPECT_EQ(count, 11);  // the phase, and ten tenths
}

TEST(FlightProgress, TheBarFillsWithTheMotion) {
  FlightProgress progress;
  progress.phase = FlightPhase::kFlying;
  progress.duration_s = 10.0;
  const auto full = [&] {
    const std::string bar = progress_bar(progress);
    return std::count(bar.begin(), bar.end(), '#');
  };
  EXPECT_EQ(full(), 0);
  progress.flown_s = 5.0;
  EXPECT_EQ(full(), 12);
  progress.flown_s = 11.0;
  EXPECT_EQ(full(), 24);
}

}  // namespace
}  // namespace gyre::ground
