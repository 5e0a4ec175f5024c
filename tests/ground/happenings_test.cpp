// What is written into a swarm's log: each thing that happens once, and nothing else.

#include "ground/swarm/core/happenings.hpp"

#include <gmock/gmock.h>

#include "tests/ground/heard_swarm.hpp"

namespace gyre::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::HeardSwarm;
using testing::ElementsAre;
using Level = Notice::Level;

class HappeningsTest : public testing::Test {
 protected:
  void tell(const SwarmMessage& message) {
    if (view_.step(swarm_.now, message)) happenings_.look(swarm_.now, message);
  }
  void tell_all() {
    for (const SwarmMessage& message : swarm_.all()) tell(message);
    happenings_.look(swarm_.now);
  }
  /// The lines since the last call, as "who: text".
  std::vector<std::string> news() {
    std::vector<std::string> lines;
    for (const Happening& one : happenings_.all()) {
      if (one.number > read_) lines.push_back(one.who + ": " + one.text);
      if (one.number > read_) level_ = one.level;
      read_ = std::max(read_, one.number);
    }
    return lines;
  }
  static protocol::Command order(std::uint64_t id, protocol::CommandKind kind) {
    protocol::Command command;
    command.id = id;
    command.kind = kind;
    return command;
  }

  HeardSwarm swarm_{2};
  SwarmView view_;
  Happenings happenings_{view_};
  std::uint64_t read_ = 0;
  Level level_ = Level::kInfo;  ///< of the last line read
};

TEST_F(HappeningsTest, WhoComesIsToldOnceHoweverOftenItSpeaks) {
  tell_all();
  EXPECT_THAT(news(), ElementsAre("coordinator: leads \"polygon\" in term 1", "agent 1: is here: here, pid 1001",
                                  "agent 1: is flying", "agent 2: is here: here, pid 1002", "agent 2: is flying"));
  for (int i = 0; i < 50; ++i) {
    swarm_.pass(milliseconds(100));
    tell_all();
  }
  EXPECT_THAT(news(), ElementsAre());
}

TEST_F(HappeningsTest, LinesAreNumberedAndCarrySwarmTimeOnceThereIsOne) {
  tell(swarm_.status);
  tell(swarm_.beacon);
  tell(swarm_.agents.at(1));
  ASSERT_EQ(happenings_.all().size(), 3U);
  EXPECT_FALSE(happenings_.all()[0].at);
  EXPECT_EQ(happenings_.all()[1].at, swarm_.swarm_now);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(happenings_.all()[i].number, i + 1);
}

TEST_F(HappeningsTest, AnotherTermAndNewsOfTheCoordinator) {
  tell_all();
  news();
  swarm_.status.news = "all agents are ready";
  tell(swarm_.status);
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre("coordinator: all agents are ready"));
  swarm_.status.term += 0x10000;
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre("coordinator: leads \"polygon\" in term 2"));
}

TEST_F(HappeningsTest, AnAgentsStatesLivesAndRefusals) {
  tell_all();
  news();
  protocol::AgentStatus& agent = swarm_.agents.at(1);
  agent.state = protocol::AgentState::kAlone;
  tell(agent);
  EXPECT_THAT(news(), ElementsAre("agent 1: flies on alone"));
  EXPECT_EQ(level_, Level::kWarning);
  agent.state = protocol::AgentState::kReady;
  tell(agent);
  EXPECT_THAT(news(), ElementsAre("agent 1: is ready"));
  agent.refused = {0x10000, 3};
  agent.refusal = "too fast for this vehicle";
  tell(agent);
  tell(agent);
  EXPECT_THAT(news(), ElementsAre("agent 1: refuses a plan: too fast for this vehicle"));
  EXPECT_EQ(level_, Level::kError);
  swarm_.pass(seconds(2));
  agent.incarnation = 55;
  agent.address = "here, pid 55";
  agent.state = protocol::AgentState::kWaiting;
  for (int i = 0; i < 20; ++i) {
    tell(agent);
    swarm_.pass(milliseconds(100));
  }
  EXPECT_THAT(news(), ElementsAre("agent 1: began anew: here, pid 55"));
}

TEST_F(HappeningsTest, SilenceIsToldWhenItBeginsAndWhenItEnds) {
  tell(HeardSwarm::health("simulator"));
  tell_all();
  news();
  swarm_.status.silent = {2};
  tell(swarm_.status);
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre("agent 2: is silent"));
  EXPECT_EQ(level_, Level::kWarning);
  swarm_.status.silent.clear();
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre("agent 2: is heard again"));
  swarm_.pass(kStreamSilence + milliseconds(1));
  happenings_.look(swarm_.now);
  happenings_.look(swarm_.now);
  EXPECT_THAT(news(), ElementsAre("coordinator: is not heard"));
  EXPECT_EQ(level_, Level::kError);
  swarm_.pass(kWordSilence);
  happenings_.look(swarm_.now);
  EXPECT_THAT(news(), ElementsAre("simulator: is not heard"));
  tell(HeardSwarm::health("simulator"));
  tell_all();
  EXPECT_THAT(news(), ElementsAre("coordinator: is heard again", "simulator: is heard again"));
}

TEST_F(HappeningsTest, ASilenceThatShowsInSeveralPlacesIsToldOnce) {
  tell(HeardSwarm::health("agent 2"));
  tell_all();
  news();
  swarm_.status.silent = {2};
  swarm_.status.news = "agent 2 is silent";
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre("agent 2: is silent")) << "in the coordinator's list and its news";
  const auto pass = [this] {
    swarm_.pass(kWordSilence + milliseconds(1));
    tell(swarm_.beacon);
    tell(swarm_.status);
    happenings_.look(swarm_.now);
  };
  pass();
  EXPECT_THAT(news(), ElementsAre()) << "and then its word is missing, too";
  swarm_.status.silent.clear();
  swarm_.status.news = "agent 2 is here";
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre()) << "nor is it heard again before all hear it";
  tell(HeardSwarm::health("agent 2"));
  happenings_.look(swarm_.now);
  EXPECT_THAT(news(), ElementsAre("agent 2: is heard again"));
  pass();
  EXPECT_THAT(news(), ElementsAre("agent 2: is silent")) << "only here";
  swarm_.status.silent = {2};
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre());
}

TEST_F(HappeningsTest, AnAgentThatBeganAnewIsToldOnce) {
  tell_all();
  news();
  swarm_.pass(seconds(2));
  swarm_.agents.at(2).incarnation = 55;
  swarm_.status.news = "agent 2 was restarted";
  for (int i = 0; i < 20; ++i) {
    tell(swarm_.status);
    tell(swarm_.agents.at(2));
    swarm_.pass(milliseconds(100));
  }
  EXPECT_THAT(news(), ElementsAre("agent 2: began anew: here, pid 1002", "agent 2: is flying"));
  swarm_.status.news = "agent 7 was restarted";
  tell(swarm_.status);
  EXPECT_THAT(news(), ElementsAre("coordinator: agent 7 was restarted")) << "nobody whom it leads";
}

TEST_F(HappeningsTest, AComplaintThatComesUpAndIsSettled) {
  tell(HeardSwarm::health("agent 2"));
  EXPECT_THAT(news(), ElementsAre()) << "who has nothing to say is no news";
  for (int i = 0; i < 3; ++i) tell(HeardSwarm::health("agent 2", "its vehicle is silent"));
  EXPECT_THAT(news(), ElementsAre("agent 2: its vehicle is silent"));
  EXPECT_EQ(level_, Level::kWarning);
  for (int i = 0; i < 3; ++i) tell(HeardSwarm::health("agent 2"));
  EXPECT_THAT(news(), ElementsAre("agent 2: has nothing to complain of any more"));
}

TEST_F(HappeningsTest, WordsThatAreSaidAgainAreToldOnceAlsoOfTwoPersonsAtOnce) {
  protocol::CommandReply done, refused;
  done.id = 11, done.done = true, done.text = "the swarm moves";
  refused.id = 12, refused.text = "already at rest";
  for (int i = 0; i < 5; ++i) {
    tell(order(11, protocol::CommandKind::kEngage));
    tell(order(12, protocol::CommandKind::kFreeze));
  }
  EXPECT_THAT(news(), ElementsAre("a person: asks: engage", "a person: asks: freeze"));
  for (int i = 0; i < 5; ++i) {
    tell(done);
    tell(refused);
  }
  EXPECT_THAT(news(), ElementsAre("coordinator: answers: the swarm moves", "coordinator: answers: already at rest"));
  EXPECT_EQ(level_, Level::kWarning) << "of one that is not done";
  tell(order(13, protocol::CommandKind::kEngage));
  EXPECT_THAT(news(), ElementsAre("a person: asks: engage")) << "the same words, another time";
}

TEST_F(HappeningsTest, OrdersHaveWords) {
  using protocol::CommandKind;
  protocol::Command command;
  EXPECT_EQ(order_words(order(1, CommandKind::kRetune)), "retune to another motion");
  EXPECT_EQ(order_words(order(1, CommandKind::kRelease)), "release");
  command.kind = CommandKind::kRelease;
  command.phase_rad = kPi / 2.0;
  EXPECT_EQ(order_words(command), "release, to rest at 90 degrees");
  command.kind = CommandKind::kPace;
  command.pace = 0.25;
  EXPECT_EQ(order_words(command), "pace 0.25");
}

TEST_F(HappeningsTest, OnlyTheNewestAreKeptAndTheNumbersGoOn) {
  for (std::size_t i = 0; i < Happenings::kKept + 20; ++i) {
    happenings_.tell(swarm_.now, Level::kInfo, "a person", std::to_string(i));
  }
  EXPECT_EQ(happenings_.all().size(), Happenings::kKept);
  EXPECT_EQ(happenings_.all().front().number, 21U);
  EXPECT_EQ(happenings_.all().back().number, Happenings::kKept + 20);
}

TEST_F(HappeningsTest, ALiarsCarriersFillNoMemory) {
  tell_all();
  news();
  for (CarrierId id = 200; id < 400; ++id) {
    swarm_.status.carriers = {id};
    swarm_.status.silent = {id};
    tell(swarm_.status);
  }
  EXPECT_THAT(news(), ElementsAre());
}

}  // namespace
}  // namespace gyre::ground
