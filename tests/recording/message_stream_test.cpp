// A file as what was heard of a swarm: in order, whatever else is in it, and however its clock was set.

#include "ground/recording/message_stream.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <variant>

#include "common/dds/payload.hpp"
#include "tests/recording/mcap_files.hpp"

namespace gyre::tests {
namespace {

using ground::MessageStream;
using ground::SwarmStream;
using Heard = SwarmStream::Item;

class MessageStreamTest : public testing::Test {
 protected:
  std::uint16_t channel(const std::string& topic, const std::string& type, const std::string& encoding = "cdr") {
    return *file_.writer.channel(file_.writer.schema(type, "ros2msg", "uint8 any\n"), topic, encoding, {});
  }
  void add(std::uint16_t channel, Bytes payload, std::uint64_t log_ns) {
    file_.add({channel, ++number_, log_ns, log_ns, std::move(payload)});
  }
  /// The carrier is what a test knows it by.
  static Bytes state(CarrierId carrier) {
    protocol::CarrierState message;
    message.carrier = carrier;
    message.incarnation = 1;
    return *dds::encode_payload(message);
  }
  static Bytes mission(const std::string& text) {
    protocol::MissionText message;
    message.term = 1;
    message.text = text;
    return *dds::encode_payload(message);
  }
  std::uint16_t states() { return channel("/gyre/carrier_1/state", "gyre_msgs/msg/CarrierState"); }

  struct Read {
    std::vector<Heard> heard;
    std::uint64_t undecodable = 0;
    bool whole = false;
    [[nodiscard]] std::vector<CarrierId> carriers() const {
      std::vector<CarrierId> ids;
      for (const Heard& one : heard) {
        const auto* told = std::get_if<protocol::CarrierState>(&one.message);
        ids.push_back(told ? told->carrier : 0);
      }
      return ids;
    }
    [[nodiscard]] std::vector<std::int64_t> times_ns() const {
      std::vector<std::int64_t> times;
      for (const Heard& one : heard) times.push_back(one.arrived.time_since_epoch().count());
      return times;
    }
  };
  Read read() {
    const BytesSource source(file_.finish());
    auto opened = SwarmStream::open(source);
    EXPECT_TRUE(opened.ok());
    Read all;
    if (!opened) return all;
    SwarmStream stream = std::move(opened).value();
    while (auto heard = stream.next()) all.heard.push_back(std::move(*heard));
    all.undecodable = stream.undecodable();
    all.whole = stream.file().whole();
    return all;
  }

  FileInMemory file_;
  std::uint32_t number_ = 0;
};

using Carriers = std::vector<CarrierId>;
using Times = std::vector<std::int64_t>;

TEST_F(MessageStreamTest, GivesWhatWasHeardInTheOrderOfTheFileWithItsTime) {
  const std::uint16_t on_states = states();
  const std::uint16_t on_load = channel("/gyre/load/state", "gyre_msgs/msg/LoadState");
  add(on_states, state(1), 1000);
  protocol::LoadState load;
  load.position_w_m.x() = 7.0;
  load.incarnation = 1;
  add(on_load, *dds::encode_payload(load), 2000);
  add(on_states, state(2), 2000);
  const Read all = read();
  EXPECT_EQ(all.carriers(), (Carriers{1, 0, 2}));
  EXPECT_EQ(all.times_ns(), (Times{1000, 2000, 2000}));
  ASSERT_EQ(all.heard.size(), 3U);
  EXPECT_EQ(std::get<protocol::LoadState>(all.heard[1].message).position_w_m.x(), 7.0);
  EXPECT_EQ(all.undecodable, 0U);
  EXPECT_TRUE(all.whole);
}

TEST_F(MessageStreamTest, WhatIsNoWordOfASwarmIsPassedOverAndNotCounted) {
  const std::uint16_t pictures = channel("/tf", "tf2_msgs/msg/TFMessage");
  const std::uint16_t texts = file_.channel("/somebody/else");
  const std::uint16_t json = channel("/gyre/carrier_2/state", "gyre_msgs/msg/CarrierState", "json");
  const std::uint16_t setpoints = channel("/gyre/carrier_1/unknown", "gyre_msgs/msg/NobodyKnowsThis");
  const std::uint16_t on_states = states();
  for (const std::uint16_t foreign : {pictures, texts, json, setpoints}) add(foreign, state(9), 1000);
  add(on_states, state(1), 2000);
  add(texts, Bytes(3, 0xff), 3000);
  const Read all = read();
  EXPECT_EQ(all.carriers(), Carriers{1});
  EXPECT_EQ(all.undecodable, 0U);
  EXPECT_TRUE(all.whole);
}

TEST_F(MessageStreamTest, BytesThatAreNoSuchMessageAreCountedAndTheOthersAreRead) {
  const std::uint16_t on_states = states();
  add(on_states, state(1), 1000);
  Bytes longer = state(2), shorter = state(3);
  longer.resize(longer.size() + 64, 0);
  shorter.resize(shorter.size() / 2);
  add(on_states, std::move(longer), 2000);
  add(on_states, std::move(shorter), 3000);
  add(on_states, {}, 4000);
  add(on_states, state(4), 5000);
  const Read all = read();
  EXPECT_EQ(all.carriers(), (Carriers{1, 4}));
  EXPECT_EQ(all.undecodable, 3U);
  EXPECT_TRUE(all.whole) << "the file is, whatever is in it";
}

TEST_F(MessageStreamTest, TimeDoesNotGoBackWithTheLogs) {
  const std::uint16_t on_states = states();
  for (const std::uint64_t log_ns : {5000ULL, 3000ULL, 0ULL, 5001ULL, 9000ULL, 8999ULL})
    add(on_states, state(1), log_ns);
  EXPECT_EQ(read().times_ns(), (Times{5000, 5000, 5000, 5001, 9000, 9000}));
}

TEST_F(MessageStreamTest, ATimeThatNoClockHasIsCountedAndMovesNothing) {
  const std::uint16_t on_states = states();
  add(on_states, state(1), 1000);
  add(on_states, state(2), std::numeric_limits<std::uint64_t>::max());
  add(on_states, state(3), static_cast<std::uint64_t>(kLongest.count()) + 1);
  add(on_states, state(4), 2000);
  const Read all = read();
  EXPECT_EQ(all.carriers(), (Carriers{1, 4}));
  EXPECT_EQ(all.times_ns(), (Times{1000, 2000}));
  EXPECT_EQ(all.undecodable, 2U);
}

TEST_F(MessageStreamTest, OnlyWhatIsWantedIsDecoded) {
  const std::uint16_t on_states = states();
  const std::uint16_t missions = channel("/gyre/mission", "gyre_msgs/msg/MissionText");
  for (int i = 0; i < 20; ++i) add(on_states, state(1), 1000);
  add(missions, Bytes(2, 0), 1500);  // no such message
  add(missions, mission("name: \"first\""), 2000);
  add(on_states, state(2), 2500);
  add(missions, mission("name: \"second\""), 3000);
  const BytesSource source(file_.finish());
  using Missions = MessageStream<std::variant<protocol::MissionText>>;
  Missions stream = Missions::open(source).value();
  EXPECT_EQ(std::get<0>(stream.next().value().message).text, "name: \"first\"");
  EXPECT_EQ(std::get<0>(stream.next().value().message).text, "name: \"second\"");
  EXPECT_FALSE(stream.next());
  EXPECT_EQ(stream.undecodable(), 1U);
}

TEST_F(MessageStreamTest, AFileThatIsCutOffGivesWhatIsWholeAndSaysSo) {
  const std::uint16_t on_states = states();
  for (std::uint64_t i = 0; i < 50; ++i) add(on_states, state(1), 1000 * i);
  Bytes bytes = file_.finish();
  bytes.resize(bytes.size() / 2);
  const BytesSource source(bytes);
  SwarmStream stream = SwarmStream::open(source).value();
  std::size_t heard = 0;
  while (stream.next()) ++heard;
  EXPECT_GT(heard, 0U);
  EXPECT_LT(heard, 50U);
  EXPECT_FALSE(stream.file().whole());
  EXPECT_FALSE(SwarmStream::open(BytesSource(Bytes(100, 7))).ok()) << "no recording";
}

}  // namespace
}  // namespace gyre::tests
