// A coordinator that starts a swarm, is told to change its plan and its pace, and sees an agent go: stepped through its
// journal again it decides as it did.

#include <gmock/gmock.h>

#include "coordinator/journal.hpp"
#include "coordinator/judged_job.hpp"
#include "tests/coordinator/swarm_of_agents.hpp"
#include "tests/places.hpp"
#include "tests/replay/journaled.hpp"

namespace gyre::coordinator::test {
namespace {

using ground::Replayed;
using testing::HasSubstr;

Job shipped(const std::string& name) {
  const auto mission =
      mission::read_mission_file(gyre::test::source_directory() + "/deploy/missions/" + name + ".textproto");
  EXPECT_TRUE(mission) << mission.error().text;
  auto job = judged_job(mission::to_text(mission.value()));
  EXPECT_TRUE(job) << job.error().text;
  return std::move(job).value();
}

class CoordinatorReplay : public testing::Test {
 protected:
  CoordinatorReplay() : swarm_(job_, options_) {}

  static CoordinatorOptions options() {
    CoordinatorOptions out;
    out.nonce = 77;
    out.engage_when_ready = true;
    return out;
  }
  void begin() {
    swarm_.stepped = [this](const Event& event, const Outputs& out) {
      kept_.keep(entry_of(swarm_.now, event, out));
      if (out.beacon) kept_.say(*out.beacon);
      if (out.time_reply) kept_.say(*out.time_reply);
      if (out.status) kept_.say(*out.status);
      if (out.mission) kept_.say(*out.mission);
      for (const auto& offer : out.offers) kept_.say(offer);
      for (const auto& reply : out.replies) kept_.say(reply);
    };
    swarm_.stop_coordinator();
    kept_.keep(beginning(swarm_.now, job_, options_));
    swarm_.start_coordinator(job_, options_);
  }
  [[nodiscard]] Replayed replayed() {
    auto lives = kept_.replay(std::nullopt);
    EXPECT_TRUE(lives) << lives.error().text;
    return std::move(lives).value().front();
  }

  Job job_ = shipped("paper");
  CoordinatorOptions options_ = options();
  SwarmOfAgents swarm_;
  gyre::test::Journaled kept_{"coordinator", 1};
};

TEST_F(CoordinatorReplay, DecidesAsItDidThen) {
  begin();
  swarm_.fly(std::chrono::seconds(10));
  EXPECT_THAT(swarm_.pace(0.5), HasSubstr("done"));
  EXPECT_THAT(swarm_.retune(shipped("paper-headings")), HasSubstr("done"));
  swarm_.tell(Retune{99, Error{"refused: too fast"}});
  swarm_.stop_agent(2);
  swarm_.fly(std::chrono::seconds(8));
  swarm_.tell(Shutdown{});
  swarm_.fly(std::chrono::seconds(5));
  const Replayed again = replayed();
  const std::string words = ground::replay_text(again, again.version);
  EXPECT_TRUE(again.same()) << words;
  EXPECT_EQ(again.cut, "");
  for (const char* kind : {"beacons", "time replies", "statuses", "plan offers", "missions", "answers"}) {
    const auto& count = again.comparison.counts().at(kind);
    EXPECT_GT(count.said, 0U) << kind;
    EXPECT_EQ(count.same, count.said) << kind;
  }
  EXPECT_EQ(again.heard.at("judged retunes"), 2U);
  EXPECT_THAT(words, HasSubstr("agent 2 is silent"));
}

TEST_F(CoordinatorReplay, WithAnotherMissionItDecidesOtherwise) {
  begin();
  swarm_.fly(std::chrono::seconds(5));
  kept_.entries.front() = beginning(kept_.entries.front().at, shipped("paper-fixed"), options_);
  const Replayed again = replayed();
  EXPECT_FALSE(again.same());
  EXPECT_THAT(ground::replay_text(again, again.version), HasSubstr("plan offers: slices[0].slice.law.kind is "));
}

TEST_F(CoordinatorReplay, ADamagedJournalIsStepped) {
  begin();
  swarm_.fly(std::chrono::seconds(3));
  RandomStream random(1, "damage");
  int otherwise = 0;
  for (int i = 0; i < 100; ++i) {
    gyre::test::Journaled damaged("coordinator", 1);
    damaged.entries = kept_.entries;
    damaged.damage(random);
    const auto lives = damaged.replay(std::nullopt);
    if (!lives || !lives.value().front().same() || !lives.value().front().cut.empty()) ++otherwise;
  }
  EXPECT_GT(otherwise, 30);
}

TEST_F(CoordinatorReplay, AMissionThatCannotBeFlownIsSaid) {
  begin();
  swarm_.fly(std::chrono::seconds(1));
  Job none = job_;
  none.mission_text = "nonsense";
  kept_.entries.front() = beginning(kept_.entries.front().at, none, options_);
  const auto lives = kept_.replay(std::nullopt);
  ASSERT_FALSE(lives);
  EXPECT_THAT(lives.error().text, HasSubstr("the mission in the journal's beginning: "));
}

}  // namespace
}  // namespace gyre::coordinator::test
