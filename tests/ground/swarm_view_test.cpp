// One picture of a swarm: whom it believes, what it carries on, what it forgets.

#include "ground/swarm/core/swarm_view.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/ground/heard_swarm.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::HeardSwarm;
using test::kMotion;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class SwarmViewTest : public testing::Test {
 protected:
  bool tell(const SwarmMessage& message) { return view_.step(swarm_.now, message); }
  /// Everybody speaks, every ten milliseconds; `more` is called after each round.
  template <class More>
  void fly(Duration duration, More more) {
    for (const LocalTime end = swarm_.now + duration; swarm_.now < end; swarm_.pass(milliseconds(10))) {
      swarm_.tell_all(view_);
      more();
    }
  }
  void fly(Duration duration) {
    fly(duration, [] {});
  }

  HeardSwarm swarm_;
  SwarmView view_;
};

TEST_F(SwarmViewTest, KnowsNothingBeforeItIsTold) {
  EXPECT_FALSE(view_.swarm_time(swarm_.now));
  EXPECT_TRUE(view_.carrier_ids().empty());
  EXPECT_FALSE(view_.planned(1, swarm_.swarm_now));
  EXPECT_FALSE(view_.deviation_m(1));
  EXPECT_FALSE(view_.named_silent(1));
  EXPECT_TRUE(view_.beacon_heard().silent(swarm_.now));
  EXPECT_TRUE(view_.complaints(swarm_.now).empty());
}

TEST_F(SwarmViewTest, TakesWhatEverybodySaysAndRefusesNothingOfIt) {
  swarm_.tell_all(view_);
  EXPECT_EQ(view_.refused(), 0U);
  EXPECT_EQ(view_.carrier_ids(), (std::vector<CarrierId>{1, 2, 3, 4}));
  EXPECT_EQ(view_.mission()->text, swarm_.text.text);
  EXPECT_EQ(view_.carriers().at(3).agent->address, "here, pid 1003");
  EXPECT_TRUE(tell(protocol::Command{}));
  EXPECT_TRUE(tell(protocol::CommandReply{}));
}

TEST_F(SwarmViewTest, CarriesSwarmTimeOnByTheClockHere) {
  tell(swarm_.beacon);
  EXPECT_EQ(view_.swarm_time(swarm_.now), swarm_.swarm_now);
  EXPECT_EQ(view_.swarm_time(swarm_.now + seconds(7)), swarm_.swarm_now + seconds(7));
  swarm_.pass(seconds(2));
  swarm_.beacon.swarm_time += milliseconds(3);  // the coordinator's clock goes faster than this one
  tell(swarm_.beacon);
  EXPECT_EQ(view_.swarm_time(swarm_.now), swarm_.swarm_now + milliseconds(3));
}

TEST_F(SwarmViewTest, BelievesTheLaterTermWhileItIsHeardAndTheEarlierOneAfterThat) {
  tell(swarm_.beacon);
  tell(swarm_.status);
  protocol::Beacon older = swarm_.beacon;
  older.term = older.course.term = kMotion.term - 1;
  older.swarm_time += seconds(50);
  protocol::CoordinatorStatus old_word = swarm_.status;
  old_word.term = older.term;
  EXPECT_FALSE(tell(older));
  EXPECT_FALSE(tell(old_word));
  EXPECT_EQ(view_.swarm_time(swarm_.now), swarm_.swarm_now);
  swarm_.pass(kStreamSilence + milliseconds(1));
  EXPECT_TRUE(tell(older)) << "nobody else leads";
  EXPECT_FALSE(tell(old_word)) << "words come more seldom than beacons";
  swarm_.pass(kWordSilence);
  EXPECT_TRUE(tell(old_word));
}

TEST_F(SwarmViewTest, ASwarmThatBeginsAnewWithAnEarlierTermIsHeardWithItsMission) {
  swarm_.tell_all(view_);
  HeardSwarm next;
  next.status.term = next.beacon.term = next.beacon.course.term = next.text.term = kMotion.term - 5;
  next.text.plan = next.status.plan = next.beacon.course.base.number = {kMotion.term - 5, 1};
  next.text.text += " ";
  swarm_.pass(seconds(1));
  tell(next.text);  // once: it is retained, and not said again
  EXPECT_EQ(view_.mission()->plan, kMotion) << "the coordinator before may still be there";
  for (int i = 0; i < 8; ++i) {
    swarm_.pass(milliseconds(500));
    tell(next.status);
  }
  EXPECT_EQ(view_.coordinator()->term, next.status.term);
  EXPECT_EQ(view_.mission()->plan, next.text.plan);
  EXPECT_EQ(view_.mission()->text, next.text.text);
}

TEST_F(SwarmViewTest, KeepsToOneOfTwoWhoClaimAPlaceAndToTheOtherWhenThatFallsSilent) {
  fly(seconds(1));
  protocol::LoadState load = swarm_.load;
  protocol::AgentStatus agent = swarm_.agents.at(2);
  protocol::CarrierState vehicle = swarm_.vehicles.at(2);
  load.incarnation = agent.incarnation = vehicle.incarnation = 7;
  load.position_w_m.x() = vehicle.position_w_m.x() = 77.0;
  agent.address = "elsewhere";
  fly(seconds(2), [&] {
    EXPECT_FALSE(tell(load));
    EXPECT_FALSE(tell(agent));
    EXPECT_FALSE(tell(vehicle));
    EXPECT_EQ(view_.load()->incarnation, 900U);
    EXPECT_EQ(view_.carriers().at(2).agent->address, "here, pid 1002");
    EXPECT_EQ(view_.carriers().at(2).vehicle->incarnation, 900U);
  });
  EXPECT_EQ(view_.refused(), 3U * 200U);
  for (int i = 0; i < 100; ++i) {
    swarm_.pass(milliseconds(10));
    tell(load);
    tell(agent);
    tell(vehicle);
  }
  EXPECT_EQ(view_.load()->position_w_m.x(), 77.0);
  EXPECT_EQ(view_.carriers().at(2).agent->address, "elsewhere");
  EXPECT_EQ(view_.carriers().at(2).vehicle->position_w_m.x(), 77.0);
}

TEST_F(SwarmViewTest, NonsenseChangesNothing) {
  fly(seconds(1));
  protocol::Beacon beacon = swarm_.beacon;
  beacon.course.wish.pace = kNaN;
  protocol::LoadState load = swarm_.load;
  load.position_w_m.y() = kNaN;
  protocol::CarrierState nobody = swarm_.vehicles.at(1), nowhere = nobody;
  nobody.carrier = kMaxCarrierId + 1;
  nowhere.position_w_m.z() = 1e9;
  protocol::AgentStatus zero = swarm_.agents.at(1), drifting = zero;
  zero.carrier = 0;
  drifting.clock_drift_ppm = kNaN;
  protocol::HeldPlans held = swarm_.held.at(1);
  held.slices.front().slice.rate_rad_s = 0.0;
  for (const SwarmMessage& message : std::vector<SwarmMessage>{beacon, load, nobody, nowhere, zero, drifting, held}) {
    EXPECT_FALSE(tell(message)) << "message " << message.index();
  }
  EXPECT_EQ(view_.refused(), 7U);
  EXPECT_EQ(view_.carriers().size(), 4U);
  EXPECT_TRUE(view_.planned(1, swarm_.swarm_now));
  EXPECT_EQ(view_.beacon()->course.wish.pace, 1.0);
}

TEST_F(SwarmViewTest, CarriersThatThereCannotBeAreNobodys) {
  swarm_.status.carriers = {1, 0, 3, kMaxCarrierId + 1, 4'000'000'000U, 3};
  tell(swarm_.status);
  EXPECT_EQ(view_.carrier_ids(), (std::vector<CarrierId>{1, 3}));
}

TEST_F(SwarmViewTest, PlansWhereEachCarrierShouldBeAndSeesHowFarItIs) {
  swarm_.tell_all(view_);
  for (const CarrierId id : view_.carrier_ids()) {
    const auto planned = view_.planned(id, swarm_.swarm_now);
    ASSERT_TRUE(planned);
    EXPECT_LT((planned->position_w_m.value - swarm_.vehicles.at(id).position_w_m).norm(), 1e-12);
    EXPECT_LT(view_.deviation_m(id).value_or(1.0), 1e-12);
  }
  EXPECT_FALSE(view_.planned(1, swarm_.swarm_now) && view_.planned(9, swarm_.swarm_now));
}

TEST_F(SwarmViewTest, AHundredthOfASecondAlongThePathIsNoDeviationAndAcrossItIs) {
  const Eigen::Vector3d along = swarm_.vehicles.at(1).velocity_w_m_s;
  ASSERT_GT(along.norm(), 0.1);
  const Eigen::Vector3d across = along.unitOrthogonal();
  const Eigen::Vector3d at = swarm_.vehicles.at(1).position_w_m;
  const auto deviation_m = [&](const Eigen::Vector3d& off) {
    swarm_.vehicles.at(1).position_w_m = at + off;
    swarm_.tell_all(view_);
    return view_.deviation_m(1).value_or(-1.0);
  };
  EXPECT_NEAR(deviation_m(0.009 * along), 0.0, 1e-12);
  EXPECT_NEAR(deviation_m(-0.009 * along), 0.0, 1e-12);
  EXPECT_NEAR(deviation_m(0.05 * along), 0.04 * along.norm(), 1e-12);
  EXPECT_NEAR(deviation_m(0.02 * across), 0.02, 1e-12);
  swarm_.beacon.course.pace = HeardSwarm::at_pace(0.0);  // at rest nothing is along
  const Eigen::Vector3d place = swarm_.planned(1).position_w_m.value;
  swarm_.vehicles.at(1).position_w_m = place + 0.003 * across;
  swarm_.tell_all(view_);
  EXPECT_NEAR(view_.deviation_m(1).value_or(-1.0), 0.003, 1e-12);
}

TEST_F(SwarmViewTest, WithoutTheSliceOfAPlanNobodyKnowsWhereACarrierShouldBe) {
  swarm_.tell_all(view_);
  swarm_.held.at(2).slices.front().number.revision = 9;
  tell(swarm_.held.at(2));
  EXPECT_FALSE(view_.planned(2, swarm_.swarm_now));
  EXPECT_FALSE(view_.deviation_m(2));
  EXPECT_TRUE(view_.planned(1, swarm_.swarm_now));
}

TEST_F(SwarmViewTest, SilentIsWhomTheCoordinatorNames) {
  swarm_.status.silent = {3};
  tell(swarm_.status);
  EXPECT_TRUE(view_.named_silent(3));
  EXPECT_FALSE(view_.named_silent(1));
}

TEST_F(SwarmViewTest, AComplaintIsNotOlderThanWhoMakesIt) {
  tell(HeardSwarm::health("agent 2", "its vehicle is silent"));
  tell(HeardSwarm::health("agent 3"));
  EXPECT_EQ(view_.complaints(swarm_.now), (std::map<std::string, std::string>{{"agent 2", "its vehicle is silent"}}));
  EXPECT_EQ(view_.complaints(swarm_.now + kWordSilence).size(), 1U);
  EXPECT_TRUE(view_.complaints(swarm_.now + kWordSilence + milliseconds(1)).empty());
  tell(HeardSwarm::health("agent 2"));
  EXPECT_TRUE(view_.complaints(swarm_.now).empty());
}

TEST_F(SwarmViewTest, ALiarDoesNotFillTheMemory) {
  for (int i = 0; i < 1000; ++i) tell(HeardSwarm::health("agent " + std::to_string(i), "no"));
  EXPECT_LE(view_.processes().size(), 128U);
  EXPECT_EQ(view_.refused(), 1000U - view_.processes().size());
  EXPECT_TRUE(tell(HeardSwarm::health("agent 0"))) << "who is known already is still heard";
}

}  // namespace
}  // namespace gyre::ground
