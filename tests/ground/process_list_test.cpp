// Who takes part and how he is; what still has to come before a flight may begin.

#include "ground/swarm/core/process_list.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "tests/ground/heard_swarm.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::HeardSwarm;
using testing::ElementsAre;

class ProcessListTest : public testing::Test {
 protected:
  ProcessListTest() { swarm_.tell_all(view_); }
  bool tell(const SwarmMessage& message) { return view_.step(swarm_.now, message); }
  /// Everybody speaks, in time for nobody to be silent.
  void fly(Duration duration) {
    for (const LocalTime end = swarm_.now + duration; swarm_.now < end;) {
      swarm_.pass(milliseconds(100));
      swarm_.tell_all(view_);
    }
  }
  ProcessLine line(const std::string& name) {
    for (const ProcessLine& line : process_list(view_, swarm_.now)) {
      if (line.name == name) return line;
    }
    ADD_FAILURE() << "no line of " << name;
    return {};
  }
  std::string state(const std::string& name) { return line(name).state; }
  std::vector<std::string> missing() {
    std::vector<std::string> lines;
    for (const MissingThing& thing : ground::missing(view_, swarm_.now)) lines.push_back(thing.who + ": " + thing.what);
    return lines;
  }

  HeardSwarm swarm_{2};
  SwarmView view_;
};

TEST_F(ProcessListTest, NamesTheCoordinatorTheWorldTheAgentsAndWhoeverElseSpeaks) {
  const auto names = [this] {
    std::vector<std::string> all;
    for (const ProcessLine& line : process_list(view_, swarm_.now)) all.push_back(line.name);
    return all;
  };
  EXPECT_THAT(names(), ElementsAre("coordinator", "agent 1", "agent 2"));
  for (const char* name : {"simulator", "agent 1", "ground", "coordinator"}) tell(HeardSwarm::health(name));
  EXPECT_THAT(names(), ElementsAre("coordinator", "simulator", "agent 1", "agent 2", "ground"));
}

TEST_F(ProcessListTest, EveryStateOfAnAgentHasItsWord) {
  using protocol::AgentState;
  protocol::AgentStatus& agent = swarm_.agents.at(1);
  for (const auto& [state_of_it, word] : {std::pair{AgentState::kWaiting, "waiting"},
                                          {AgentState::kReady, "ready"},
                                          {AgentState::kFlying, "flying"},
                                          {AgentState::kAlone, "alone"}}) {
    agent.state = state_of_it;
    tell(agent);
    EXPECT_EQ(state("agent 1"), word);
    EXPECT_TRUE(line("agent 1").well);
  }
  tell(HeardSwarm::health("agent 1", "its vehicle is silent"));
  EXPECT_EQ(state("agent 1"), "alone") << "the complaint has a place of its own";
  EXPECT_EQ(line("agent 1").complaint, "its vehicle is silent");
  EXPECT_FALSE(line("agent 1").well);
  EXPECT_EQ(line("agent 1").address, "here, pid 1001");
  EXPECT_EQ(line("agent 1").carrier, 1U);
}

TEST_F(ProcessListTest, WhoIsSilentIsNotWellWhoeverNoticesIt) {
  swarm_.status.silent = {2};
  tell(swarm_.status);
  EXPECT_EQ(state("agent 2"), "silent") << "the coordinator hears nothing of it, and it is what counts";
  EXPECT_FALSE(line("agent 2").well);
  EXPECT_EQ(state("agent 1"), "flying");
  swarm_.pass(kStreamSilence + milliseconds(1));
  EXPECT_EQ(state("agent 1"), "silent");
  EXPECT_EQ(state("coordinator"), "silent");
  EXPECT_EQ(line("coordinator").age, kStreamSilence + milliseconds(1));
  EXPECT_FALSE(line("coordinator").well);
}

TEST_F(ProcessListTest, WhoWasNeverHeardIsNotHeard) {
  swarm_.status.carriers.push_back(7);
  tell(swarm_.status);
  EXPECT_EQ(state("agent 7"), "not heard");
  EXPECT_FALSE(line("agent 7").well);
  EXPECT_FALSE(line("agent 7").age);
  view_ = SwarmView();
  EXPECT_EQ(state("coordinator"), "not heard");
}

TEST_F(ProcessListTest, OthersAreHealthyOrComplainAndTheirComplaintGoesWithThem) {
  tell(HeardSwarm::health("ground"));
  EXPECT_EQ(state("ground"), "healthy");
  tell(HeardSwarm::health("ground", "came too late"));
  EXPECT_EQ(state("ground"), "complains");
  EXPECT_FALSE(line("ground").well);
  swarm_.pass(kWordSilence);
  EXPECT_EQ(state("ground"), "complains");
  swarm_.pass(milliseconds(1));
  EXPECT_EQ(state("ground"), "silent");
  EXPECT_EQ(line("ground").complaint, "");
}

TEST_F(ProcessListTest, TheSimulatorIsHeardByWhatItTellsOfTheWorld) {
  tell(HeardSwarm::health("simulator"));
  fly(seconds(2));  // without another word of its own: it speaks of itself once a second, and words get lost
  EXPECT_EQ(state("simulator"), "healthy");
  EXPECT_EQ(line("simulator").age, Duration::zero());
}

TEST_F(ProcessListTest, NothingIsMissingInASwarmThatFlies) {
  EXPECT_THAT(missing(), ElementsAre());
}

TEST_F(ProcessListTest, WithoutACoordinatorItIsWhatIsMissing) {
  view_ = SwarmView();
  EXPECT_THAT(missing(), ElementsAre("coordinator: is not heard yet"));
  tell(swarm_.beacon);
  EXPECT_THAT(missing(), ElementsAre("coordinator: has not said yet which mission it leads"));
  swarm_.pass(seconds(1));
  EXPECT_THAT(missing(), ElementsAre("coordinator: is not heard any more"));
}

TEST_F(ProcessListTest, EachAgentIsMissingByItsOwnReason) {
  protocol::AgentStatus agent = swarm_.agents.at(1);
  agent.accepted.clear();
  tell(agent);
  EXPECT_THAT(missing(), ElementsAre("agent 1: has not accepted the plan yet"));
  agent.clock_uncertainty = std::chrono::hours(10);
  tell(agent);
  EXPECT_THAT(missing(), ElementsAre("agent 1: does not know swarm time yet"));
  agent.refused = test::kMotion;
  agent.refusal = "too fast for this vehicle";
  tell(agent);
  EXPECT_THAT(missing(), ElementsAre("agent 1: refuses the plan: too fast for this vehicle"));
  agent = swarm_.agents.at(1);
  agent.refused = {0x10000, 9};
  tell(agent);
  EXPECT_THAT(missing(), ElementsAre()) << "another plan is nothing that is missing";
}

TEST_F(ProcessListTest, WhoIsNotHeardIsMissing) {
  swarm_.agents.erase(2);
  fly(seconds(1));
  EXPECT_THAT(missing(), ElementsAre("agent 2: is not heard"));
}

TEST_F(ProcessListTest, VehiclesTheLoadAndClocksAreMissing) {
  swarm_.vehicles.at(2).carrier = 9;  // none of this mission's
  swarm_.status.skew = milliseconds(20);
  for (int i = 0; i < 10; ++i) {
    swarm_.pass(milliseconds(100));
    swarm_.load.position_w_m.x() = std::numeric_limits<double>::quiet_NaN();
    swarm_.tell_all(view_);
  }
  EXPECT_THAT(missing(), ElementsAre("vehicle 2: does not tell where it is", "load: nobody tells where it is",
                                     "clocks: may disagree by 20 ms, the plan allows 10 ms"));
  swarm_.status.skew = std::chrono::hours(24);
  tell(swarm_.status);
  EXPECT_EQ(missing().back(), "clocks: nobody knows yet how far they disagree");
  swarm_.status.skew_budget = Duration::zero();
  tell(swarm_.status);
  EXPECT_EQ(missing().back(), "load: nobody tells where it is") << "any disagreement will do";
}

TEST_F(ProcessListTest, AComplaintHoldsAFlightBack) {
  tell(HeardSwarm::health("agent 2", "its vehicle is silent"));
  EXPECT_THAT(missing(), ElementsAre("agent 2: its vehicle is silent"));
}

}  // namespace
}  // namespace gyre::ground
