// An agent on virtual time keeps its journal; stepped through it again it decides as it did, and where the journal, the
// vehicle or the words are others, it says where.

#include <gmock/gmock.h>

#include <algorithm>

#include "agent/journal.hpp"
#include "tests/agent/one_agent.hpp"
#include "tests/replay/journaled.hpp"

namespace gyre::agent {
namespace {

using ground::Replayed;
using testing::HasSubstr;

class ReplayTest : public AgentTest {
 protected:
  ReplayTest() {
    AgentOptions options;
    options.carrier = 1;
    options.incarnation = 1;
    options.address = "here";
    options_ = options;
    kept_.keep(beginning(now_, options));
    stepped_ = [this](const Event& event, const Outputs& out) {
      kept_.keep(entry_of(now_, event, out));
      if (out.setpoint && !loses_setpoints_) kept_.say(*out.setpoint);
      if (out.status) kept_.say(*out.status);
      if (out.time_request) kept_.say(*out.time_request);
    };
  }

  /// Everything that an agent may be told.
  void eventful_flight() {
    engage();
    transition(kOther, milliseconds(300), seconds(2));
    fly(seconds(4));
    fly(seconds(3), false);  // nobody leads
    fly(seconds(1));
    now_ += seconds(30);  // its clock leaps, or it slept
    vehicle_at_rest();
    fly(seconds(4));
  }
  [[nodiscard]] Replayed replayed() {
    auto lives = kept_.replay(1);
    EXPECT_TRUE(lives) << lives.error().text;
    EXPECT_EQ(lives.value().size(), 1U);
    return std::move(lives).value().front();
  }
  [[nodiscard]] std::size_t first_of(JournalKind kind) const {
    const auto found = std::find_if(kept_.entries.begin(), kept_.entries.end(),
                                    [&](const auto& entry) { return entry.kind == static_cast<std::uint8_t>(kind); });
    return static_cast<std::size_t>(found - kept_.entries.begin());
  }
  void forget(std::size_t entry) { kept_.entries.erase(kept_.entries.begin() + static_cast<std::ptrdiff_t>(entry)); }
  static std::string text_of(const Replayed& replayed) { return ground::replay_text(replayed, replayed.version); }

  test::Journaled kept_{"agent 1", 1};
  AgentOptions options_;
  bool loses_setpoints_ = false;
};

TEST_F(ReplayTest, DecidesAsItDidThen) {
  eventful_flight();
  const Replayed again = replayed();
  EXPECT_TRUE(again.same()) << text_of(again);
  EXPECT_EQ(again.cut, "");
  EXPECT_EQ(again.comparison.steps() + 1, kept_.entries.size());
  for (const char* kind : {"setpoints", "statuses", "time requests"}) {
    const auto& count = again.comparison.counts().at(kind);
    EXPECT_GT(count.said, 50U) << kind;
    EXPECT_EQ(count.recorded, count.said) << kind;
    EXPECT_EQ(count.same, count.said) << kind;
  }
  for (const char* kind : {"ticks", "beacons", "plan offers", "time replies", "states of its vehicle"})
    EXPECT_GT(again.heard.at(kind), 0U) << kind;
  EXPECT_EQ(again.heard.at("verdicts on plans"), 2U);
  const std::string words = text_of(again);
  EXPECT_THAT(words, HasSubstr("agent 1, from its start for "));
  EXPECT_THAT(words, HasSubstr("the coordinator is silent: flying on alone"));
  EXPECT_THAT(words, HasSubstr("It decides as it did then.\n"));
}

TEST_F(ReplayTest, SaysWhereItDecidesOtherwise) {
  engage();
  const std::size_t reply = first_of(JournalKind::kTimeReply);
  forget(reply);
  const Replayed again = replayed();
  EXPECT_FALSE(again.same());
  EXPECT_FALSE(again.comparison.differences().empty());
  EXPECT_THAT(text_of(again), HasSubstr("It decides otherwise "));
}

TEST_F(ReplayTest, AnOfferThatItDidNotGetLeavesItWithoutAQuestion) {
  engage();
  forget(first_of(JournalKind::kPlanOffer));
  const Replayed again = replayed();
  EXPECT_THAT(text_of(again), HasSubstr("asks no question about a plan, and was told a verdict on one then"));
  EXPECT_THAT(text_of(again), HasSubstr("does not say a setpoint, did then"));
}

TEST_F(ReplayTest, AnotherVehicleRefusesThePlan) {
  engage();
  options_.vehicle.speed_max_m_s = 0.001;
  kept_.entries.front() = beginning(kept_.entries.front().at, options_);
  const Replayed again = replayed();
  EXPECT_FALSE(again.same());
  EXPECT_THAT(text_of(again), HasSubstr("plan refused: "));
}

TEST_F(ReplayTest, OtherWordsThanRecordedAreToldWithTheirFields) {
  engage();
  protocol::Setpoint lie;
  loses_setpoints_ = true;
  stepped_ = [this, step = stepped_](const Event& event, const Outputs& out) {
    step(event, out);
    if (!out.setpoint) return;
    protocol::Setpoint said = *out.setpoint;
    said.position_w_m.x() += 0.004;
    kept_.say(said);
  };
  fly(milliseconds(30));
  const Replayed again = replayed();
  EXPECT_EQ(again.comparison.different(), 3U);
  EXPECT_NEAR(again.comparison.apart_max_m(), 0.004, 1e-9);
  EXPECT_THAT(text_of(again), HasSubstr("It decides otherwise 3 times"));
  EXPECT_THAT(text_of(again), HasSubstr("setpoints: position_w_m.x is "));
  EXPECT_THAT(text_of(again), HasSubstr("up to 4 mm apart"));
}

TEST_F(ReplayTest, WhatWasNotRecordedIsCountedAndNoDifference) {
  loses_setpoints_ = true;
  engage();
  const Replayed again = replayed();
  EXPECT_TRUE(again.same());
  EXPECT_GT(again.comparison.counts().at("setpoints").said, 300U);
  EXPECT_EQ(again.comparison.counts().at("setpoints").recorded, 0U);
}

TEST_F(ReplayTest, EndsWhereAPieceIsMissing) {
  engage();
  const auto lives = kept_.replay(1, 20);
  ASSERT_TRUE(lives) << lives.error().text;
  const Replayed& again = lives.value().front();
  EXPECT_TRUE(again.same());
  EXPECT_LT(again.comparison.steps(), kept_.entries.size() / 2);
  EXPECT_THAT(text_of(again), HasSubstr("The journal ends there: a piece of it was not recorded."));
}

TEST_F(ReplayTest, AJournalWithoutItsBeginningIsNone) {
  engage();
  const auto lives = kept_.replay(1, 0);
  ASSERT_FALSE(lives);
  EXPECT_THAT(lives.error().text, HasSubstr("the journal of agent 1 does not begin with its process"));
}

TEST_F(ReplayTest, AnothersJournalIsNamed) {
  engage();
  const auto lives = kept_.replay(2);
  ASSERT_FALSE(lives);
  EXPECT_EQ(lives.error().text, "no journal of agent 2 is recorded in it, but of agent 1");
}

TEST_F(ReplayTest, NoJournalAtAllIsSaidWithTheCure) {
  engage();
  kept_.entries.clear();
  const auto lives = kept_.replay(1);
  ASSERT_FALSE(lives);
  EXPECT_THAT(lives.error().text, HasSubstr("no journal is recorded in it: begin to record before"));
}

TEST_F(ReplayTest, AnEntryOfAnotherVersionEndsIt) {
  engage();
  kept_.entries[10].kind = 99;
  const Replayed again = replayed();
  EXPECT_EQ(again.comparison.steps(), 9U);
  EXPECT_THAT(text_of(again), HasSubstr("The journal ends there: entry 10 is none of this version."));
}

// Whatever is in a file: it is stepped as far as it is a journal, and nothing falls over.
TEST_F(ReplayTest, ADamagedJournalIsStepped) {
  engage();
  RandomStream random(1, "damage");
  int otherwise = 0;
  for (int i = 0; i < 200; ++i) {
    test::Journaled damaged("agent 1", 1);
    damaged.entries = kept_.entries;
    damaged.damage(random);
    const auto lives = damaged.replay(1);
    if (!lives || !lives.value().front().same() || !lives.value().front().cut.empty()) ++otherwise;
  }
  EXPECT_GT(otherwise, 100);
}

TEST_F(ReplayTest, AnotherVersionIsSaid) {
  engage();
  EXPECT_THAT(ground::replay_text(replayed(), "9.9"), HasSubstr(" and is 9.9 now."));
}

}  // namespace
}  // namespace gyre::agent
