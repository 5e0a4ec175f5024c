// An agent's journal: every event comes back as it was told, and the agent with what it can do.

#include "agent/journal.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/dds/random_messages.hpp"

namespace gyre::agent {
namespace {

using tests::bits_of;
using tests::holds;
using tests::random_message;

constexpr LocalTime kNow{std::chrono::seconds(5)};

template <class Message>
class EveryMessage : public testing::Test {};
using Messages = testing::Types<protocol::Beacon, protocol::PlanOffer, protocol::CarrierState>;
TYPED_TEST_SUITE(EveryMessage, Messages);

TYPED_TEST(EveryMessage, ComesBackBitForBit) {
  EXPECT_TRUE(holds([] {
    const auto message = random_message<TypeParam>();
    const auto back = event_of(entry_of(kNow, message, {}));
    RC_ASSERT(back && std::holds_alternative<TypeParam>(*back));
    RC_ASSERT(bits_of(std::get<TypeParam>(*back)) == bits_of(message));
  }));
}

TEST(AgentJournal, ATimeReplyComesBackWithItsArrival) {
  EXPECT_TRUE(holds([] {
    const TimeReplyArrived told{random_message<protocol::TimeReply>(), LocalTime(Duration(*rc::gen::inRange(-99, 99)))};
    const auto back = event_of(entry_of(kNow, told, {}));
    RC_ASSERT(back && std::holds_alternative<TimeReplyArrived>(*back));
    RC_ASSERT(bits_of(std::get<TimeReplyArrived>(*back).reply) == bits_of(told.reply));
    RC_ASSERT(std::get<TimeReplyArrived>(*back).arrived == told.arrived);
  }));
}

template <class Message>
void expect_it_comes_back_with_its_arrival() {
  EXPECT_TRUE(holds([] {
    const Heard<Message> told{random_message<Message>(), LocalTime(Duration(*rc::gen::inRange(-99, 99)))};
    const auto back = event_of(entry_of(kNow, told, {}));
    RC_ASSERT(back && std::holds_alternative<Heard<Message>>(*back));
    RC_ASSERT(bits_of(std::get<Heard<Message>>(*back).message) == bits_of(told.message));
    RC_ASSERT(std::get<Heard<Message>>(*back).arrived == told.arrived);
  }));
}

TEST(AgentJournal, WhatTheClockIsWatchedByComesBackWithItsArrival) {
  expect_it_comes_back_with_its_arrival<protocol::Beacon>();
  expect_it_comes_back_with_its_arrival<protocol::CarrierState>();
}

TEST(AgentJournal, ATickComesBackWithWhatCouldNotBeDecoded) {
  for (const std::uint64_t undecodable : {0UL, 1UL, 1UL << 40U}) {
    const auto back = event_of(entry_of(kNow, Tick{undecodable}, {}));
    ASSERT_TRUE(back && std::holds_alternative<Tick>(*back));
    EXPECT_EQ(std::get<Tick>(*back).undecodable, undecodable);
  }
}

TEST(AgentJournal, AVerdictIsOnlyThatThereWasOne) {
  const auto entry = entry_of(kNow, PlanVerdict{{1, 2}, Error{"too fast"}}, {});
  EXPECT_EQ(entry.kind, static_cast<std::uint8_t>(JournalKind::kVerdict));
  EXPECT_FALSE(event_of(entry)) << "the core's own question leads to it";
}

TEST(AgentJournal, SaysWhichOutputsThereWere) {
  Outputs out;
  EXPECT_EQ(said(out), 0);
  out.setpoint.emplace();
  out.held.emplace();
  EXPECT_EQ(said(out), Said::kSetpoint | Said::kHeldPlans);
  EXPECT_EQ(entry_of(kNow, Tick{}, out).said, said(out));
}

TEST(AgentJournal, BeginsWithWhatTheAgentIsAndCan) {
  AgentOptions options;
  options.carrier = 7;
  options.incarnation = 1ULL << 63U;
  options.address = "10.0.0.3 (\"va\x80g\", pid 1)";
  options.vehicle.speed_max_m_s = 1.0 / 3.0;
  options.vehicle.length_min_m = 1e-300;
  options.machines.winch.rate_max_m_s = 0.5;
  options.machines.vehicle.bank_max_rad = 0.6;
  const auto back = beginning_of(beginning(kNow, options));
  ASSERT_TRUE(back) << back.error().text;
  const AgentOptions& read = back.value().options;
  EXPECT_EQ(read.carrier, options.carrier);
  EXPECT_EQ(read.incarnation, options.incarnation);
  EXPECT_EQ(read.vehicle.speed_max_m_s, options.vehicle.speed_max_m_s);
  EXPECT_EQ(read.vehicle.length_min_m, options.vehicle.length_min_m);
  EXPECT_EQ(read.vehicle.tension_max_n, std::nullopt);
  EXPECT_EQ(read.machines.winch.rate_max_m_s, options.machines.winch.rate_max_m_s);
  EXPECT_EQ(read.machines.vehicle.bank_max_rad, options.machines.vehicle.bank_max_rad);
  EXPECT_FALSE(back.value().version.empty());
}

TEST(AgentJournal, WhatIsNoBeginningIsSaid) {
  const auto words_of = [](std::uint8_t kind, const std::string& words) {
    const auto back = beginning_of({kNow, kind, 0, Bytes(words.begin(), words.end())});
    return back ? "good" : back.error().text;
  };
  EXPECT_NE(words_of(1, "{}").find("does not begin with"), std::string::npos);
  EXPECT_NE(words_of(0, "{").find("does not begin with"), std::string::npos);
  EXPECT_NE(words_of(0, "[]").find("does not begin with"), std::string::npos);
  EXPECT_NE(words_of(0, "{}").find("names no options"), std::string::npos);
  EXPECT_NE(words_of(0, R"({"gyre":"1","carrier":"x","incarnation":1,"address":"","limits":{}})").find("names no"),
            std::string::npos);
}

TEST(AgentJournal, WhatIsNoEventIsNone) {
  EXPECT_TRUE(holds([] {
    const auto bytes = *rc::gen::container<Bytes>(rc::gen::arbitrary<std::uint8_t>());
    const protocol::JournalEntry entry{kNow, *rc::gen::arbitrary<std::uint8_t>(), 0, bytes};
    static_cast<void>(event_of(entry));  // whatever it is, it does not fall over it
    static_cast<void>(beginning_of(entry));
  }));
  EXPECT_FALSE(event_of({kNow, 200, 0, {}}));
  EXPECT_FALSE(event_of({kNow, static_cast<std::uint8_t>(JournalKind::kBeacon), 0, {0, 1, 0, 0}}));
  EXPECT_FALSE(event_of({kNow, static_cast<std::uint8_t>(JournalKind::kTick), 0, {1}}));
}

}  // namespace
}  // namespace gyre::agent
