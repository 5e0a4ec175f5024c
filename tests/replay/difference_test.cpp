#include "ground/replay/core/difference.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/protocol/messages.hpp"

namespace gyre::ground {
namespace {

TEST(Difference, NoneOfWhatIsTheSameToTheBit) {
  protocol::Beacon beacon;
  beacon.course.transitions.resize(2);
  beacon.course.lease = SwarmTime(std::chrono::seconds(3));
  beacon.proposal = beacon.course;
  EXPECT_TRUE(differences(beacon, beacon).empty());
  protocol::Setpoint setpoint;
  setpoint.tension_n = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(differences(setpoint, setpoint).empty());
}

TEST(Difference, NamesTheFieldAndBothOfItsValues) {
  protocol::Setpoint then;
  protocol::Setpoint now;
  now.position_w_m.y() = 1.5;
  now.swarm_time = SwarmTime(std::chrono::milliseconds(20));
  const auto found = differences(then, now);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(told(found), "swarm_time is 0.020000000 s, was 0.000000000 s; position_w_m.y is 1.5, was 0");
}

TEST(Difference, GoesIntoWhatIsNested) {
  protocol::Beacon then;
  protocol::Beacon now;
  now.course.pace.ramps.front().from.pace = 0.5;
  now.course.wish.rest_when_changed = true;
  now.course.wish.by = protocol::Wisher::kPerson;
  EXPECT_EQ(told(differences(then, now)), "course.wish.rest_when_changed is yes, was no; course.wish.by is " +
                                              std::to_string(static_cast<int>(protocol::Wisher::kPerson)) + ", was " +
                                              std::to_string(static_cast<int>(protocol::Wisher::kNobody)) +
                                              "; course.pace.ramps[0].from.pace is 0.5, was 0");
}

TEST(Difference, OfListsOfOtherLengthsAndWhatIsThereOrNot) {
  protocol::Beacon then;
  protocol::Beacon now;
  now.proposal.emplace();
  now.course.transitions.resize(1);
  EXPECT_EQ(told(differences(then, now)), "course.transitions is 1 long, was 0 long; proposal is there, was none");
  protocol::AgentStatus said;
  protocol::AgentStatus says;
  says.refusal = "too fast";
  says.state = protocol::AgentState::kAlone;
  EXPECT_EQ(told(differences(said, says)), "state is 4, was 1; refusal is \"too fast\", was \"\"");
}

TEST(Difference, OfManyTheFirstAreTold) {
  protocol::Setpoint now;
  now.position_w_m = now.velocity_w_m_s = {1.0, 2.0, 3.0};
  EXPECT_EQ(told(differences(protocol::Setpoint{}, now)),
            "position_w_m.x is 1, was 0; position_w_m.y is 2, was 0; position_w_m.z is 3, was 0; and 3 more");
}

TEST(Difference, TheSmallestThereIsIsOne) {
  protocol::Setpoint then;
  protocol::Setpoint now;
  then.tension_n = 1.0;
  now.tension_n = std::nextafter(1.0, 2.0);
  EXPECT_EQ(differences(then, now).size(), 1U);
}

}  // namespace
}  // namespace gyre::ground
