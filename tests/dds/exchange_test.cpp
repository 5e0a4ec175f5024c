// Real samples over real loopback sockets: every message between two nodes, and what strangers may send.

#include <dirent.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "common/dds/health_reporter.hpp"
#include "common/dds/inbox.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/topics.hpp"
#include "tests/dds/any_bytes.hpp"
#include "tests/dds/free_domain.hpp"
#include "tests/dds/random_messages.hpp"

namespace gyre {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace): the messages are the subject
using namespace std::chrono_literals;

constexpr CarrierId kCarrier = 3;

// Nodes of one process would hand samples over in memory; here they are to use the sockets, as processes do.
class Sockets : public testing::Environment {
 public:
  void SetUp() override {
    // Profiles are the one way to say so that every release of Fast DDS understands.
    const std::string profile =
        "<dds><library_settings><intraprocess_delivery>OFF</intraprocess_delivery></library_settings></dds>";
    auto* const factory = dds::fast::api::DomainParticipantFactory::get_instance();
    ASSERT_TRUE(factory->load_XML_profiles_string(profile.data(), profile.size()) == dds::fast::kOk);
  }
};
// NOLINTNEXTLINE(cert-err58-cpp): GoogleTest takes environments at static time when it brings its own main
const auto* const kSockets = testing::AddGlobalTestEnvironment(new Sockets);

template <class Message>
std::optional<CarrierId> carrier_of_topic() {
  return dds::kTopic<Message>.per_carrier ? std::optional<CarrierId>(kCarrier) : std::nullopt;
}

/// Waits until `done(arrived messages)` or ten seconds are over; `again` is called every 20 ms.
template <class Message, class Done, class Again>
std::optional<Message> wait_for(dds::Inbox<Message>& inbox, Done done, Again again) {
  const LocalTime deadline = dds::now() + 10s;
  while (dds::now() < deadline) {
    again();
    for (Message& message : inbox.wait_until(dds::now() + 20ms)) {
      if (done(message)) return message;
    }
  }
  return std::nullopt;
}

template <class Message>
class EveryMessage : public testing::Test {};

using Messages =
    testing::Types<Beacon, PlanOffer, HeldPlans, TimeRequest, TimeReply, AgentStatus, Setpoint, CarrierState, LoadState,
                   Command, CommandReply, CoordinatorStatus, MissionText, Health, Disturbance, JournalPiece>;
TYPED_TEST_SUITE(EveryMessage, Messages);

TYPED_TEST(EveryMessage, ArrivesBitForBit) {
  dds::NodeOptions options;
  dds::Inbox<TypeParam> inbox;
  const auto sender = tests::open_coordinator(options);
  const auto receiver = tests::open(options, {std::nullopt, kCarrier});
  ASSERT_TRUE(sender && receiver);
  const auto writer = sender->template writer<TypeParam>(carrier_of_topic<TypeParam>());
  receiver->template read<TypeParam>(
      [&](TypeParam message, LocalTime arrived) {
        EXPECT_LE(arrived, dds::now());
        inbox.push(std::move(message));
      },
      carrier_of_topic<TypeParam>());

  EXPECT_TRUE(tests::holds([&] {
    const auto message = tests::random_message<TypeParam>();
    const auto same = [&](const TypeParam& arrived) { return tests::bits_of(arrived) == tests::bits_of(message); };
    RC_ASSERT(wait_for(inbox, same, [&] { writer.write(message); }).has_value());
  }));
  EXPECT_EQ(writer.readers(), 1);
  EXPECT_EQ(sender->counters().unsendable, 0U);
  EXPECT_EQ(receiver->counters().undecodable, 0U);
}

TEST(Plan, ReachesWhoComesLate) {
  dds::NodeOptions options;
  dds::Inbox<PlanOffer> inbox;
  const auto coordinator = tests::open_coordinator(options);
  ASSERT_TRUE(coordinator);
  const auto writer = coordinator->writer<PlanOffer>(kCarrier);
  writer.write({kCarrier, 1, 1, {}, {}});
  writer.write({kCarrier, 2, 1, {}, {}});
  const auto agent = tests::open(options, {std::nullopt, kCarrier});
  ASSERT_TRUE(agent);
  agent->read<PlanOffer>([&](PlanOffer offer, LocalTime) { inbox.push(std::move(offer)); }, kCarrier);
  const auto first = wait_for(
      inbox, [](const PlanOffer&) { return true; }, [] {});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->term, 2U) << "the newest, and only that";
}

// A flight begins when all were heard: with the word that was said before somebody came, not with the next one.
TEST(AgentStatus, IsHeardByWhoComesLate) {
  dds::NodeOptions options;
  dds::Inbox<AgentStatus> inbox;
  tests::open_coordinator(options).reset();
  const auto agent = tests::open(options, {std::nullopt, kCarrier});
  ASSERT_TRUE(agent);
  AgentStatus said;
  said.sequence = 7;
  agent->writer<AgentStatus>(kCarrier).write(said);
  const auto coordinator = tests::open(options, {dds::Hub::kCoordinator, std::nullopt});
  ASSERT_TRUE(coordinator);
  coordinator->read<AgentStatus>([&](AgentStatus status, LocalTime) { inbox.push(std::move(status)); }, kCarrier);
  const auto heard = wait_for(
      inbox, [](const AgentStatus&) { return true; }, [] {});
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->sequence, 7U);
}

TEST(HeldPlans, ReachARestartedCoordinator) {
  dds::NodeOptions options;
  dds::Inbox<protocol::HeldPlans> inbox;
  auto coordinator = tests::open_coordinator(options);
  const auto agent = tests::open(options, {std::nullopt, kCarrier});
  ASSERT_TRUE(coordinator && agent);
  agent->writer<protocol::HeldPlans>(kCarrier).write({kCarrier, 7, {{{1, 2}, {}}}, {}});
  coordinator.reset();
  coordinator = tests::open(options, {dds::Hub::kCoordinator, std::nullopt});
  ASSERT_TRUE(coordinator);
  coordinator->read<protocol::HeldPlans>([&](protocol::HeldPlans held, LocalTime) { inbox.push(std::move(held)); },
                                         kCarrier);
  const auto held = wait_for(
      inbox, [](const protocol::HeldPlans&) { return true; }, [] {});
  ASSERT_TRUE(held);
  EXPECT_EQ(held->incarnation, 7U);
  ASSERT_EQ(held->slices.size(), 1U);
  EXPECT_EQ(held->slices.front().number, (PlanNumber{1, 2}));
}

TEST(Health, IsHeardOfManyProcessesOnOneTopic) {
  constexpr std::size_t kProcesses = 64;
  EXPECT_GE(static_cast<std::size_t>(dds::reader_depth(dds::kTopic<protocol::Health>.delivery)), kProcesses);
  dds::NodeOptions options;
  dds::Inbox<protocol::Health> inbox;
  const auto ground = tests::open_coordinator(options);
  const auto swarm = tests::open(options, {std::nullopt, kCarrier});
  ASSERT_TRUE(ground && swarm);
  ground->read<protocol::Health>([&](protocol::Health health, LocalTime) { inbox.push(std::move(health)); });
  std::vector<dds::Writer<protocol::Health>> processes(kProcesses);
  for (auto& writer : processes) writer = swarm->writer<protocol::Health>();
  std::set<std::string> heard;
  EXPECT_TRUE(wait_for(
      inbox,
      [&](const protocol::Health& health) { return heard.insert(health.process).second && heard.size() == kProcesses; },
      [&] {
        for (std::size_t i = 0; i < kProcesses; ++i) {
          protocol::Health health;
          health.process = "agent " + std::to_string(i + 1);
          processes[i].write(health);
        }
      }))
      << heard.size() << " heard";
}

TEST(Health, IsReportedOncePerPeriodWithEveryCount) {
  dds::NodeOptions options;
  dds::Inbox<protocol::Health> inbox;
  const auto ground = tests::open_coordinator(options);
  const auto node = tests::open(options, {std::nullopt, kCarrier});
  ASSERT_TRUE(ground && node);
  ground->read<protocol::Health>([&](protocol::Health health, LocalTime) { inbox.push(std::move(health)); });
  Beacon unsendable;
  unsendable.course.transitions.resize(kMaxTransitions + 1);
  node->writer<Beacon>().write(unsendable);

  // The steps are half a period apart: the even ones are due, the odd ones are not. `overrun` tells them apart. Each is
  // less late than the one before: the worst since the last report is always the odd one's.
  dds::HealthReporter reporter(*node, "agent 3");
  std::uint64_t step = 0;
  std::set<std::uint64_t> arrived;
  const auto last = wait_for(
      inbox,
      [&](const protocol::Health& health) { return arrived.insert(health.overrun).second && arrived.size() == 5; },
      [&] {
        for (int i = 0; i < 2; ++i, ++step) {
          reporter.step(LocalTime(step * dds::HealthReporter::kPeriod / 2), "its vehicle is silent", {1, 2, 3, 4}, step,
                        1s - Duration(step));
        }
      });
  ASSERT_TRUE(last);
  for (const std::uint64_t overrun : arrived) EXPECT_EQ(overrun % 2, 0U) << "was not due";
  const protocol::Health expected{"agent 3",     "its vehicle is silent",         {1, 2, 3, 4}, 0, 1,
                                  last->overrun, 1s - Duration(last->overrun - 1)};
  EXPECT_EQ(tests::bits_of(*last), tests::bits_of(expected));
}

TEST(Visitor, FindsAnAgentWhereThereIsNoHub) {
  dds::NodeOptions options;
  dds::Inbox<AgentStatus> inbox;
  tests::open_coordinator(options).reset();
  const auto agent = tests::open(options, {std::nullopt, kMaxCarrierId});
  const auto visitor = tests::open(options, {});
  ASSERT_TRUE(agent && visitor);
  const auto writer = agent->writer<AgentStatus>(kMaxCarrierId);
  visitor->read<AgentStatus>([&](AgentStatus status, LocalTime) { inbox.push(std::move(status)); }, kMaxCarrierId);
  EXPECT_TRUE(wait_for(
      inbox, [](const AgentStatus&) { return true; }, [&] { writer.write({}); }));
}

TEST(Node, CountsWhatCannotBeSentAndSendsNothing) {
  dds::NodeOptions options;
  const auto node = tests::open_coordinator(options);
  ASSERT_TRUE(node);
  Beacon beacon;
  beacon.course.transitions.resize(kMaxTransitions + 1);
  node->writer<Beacon>().write(beacon);
  node->writer<Command>().write({1, CommandKind::kRetune, 1.0, std::nullopt, std::string(kMaxMissionBytes + 1, 'm')});
  EXPECT_EQ(node->counters().unsendable, 2U);
}

TEST(Node, LeavesItsWritersHarmless) {
  dds::NodeOptions options;
  auto node = tests::open_coordinator(options);
  ASSERT_TRUE(node);
  const auto writer = node->writer<Beacon>();
  node.reset();
  writer.write({});
  EXPECT_EQ(writer.readers(), 0);
  dds::Writer<Beacon>().write({});
}

TEST(Node, CountsAStrangersBytesAndGoesOnListening) {
  dds::NodeOptions options;
  dds::Inbox<Beacon> inbox;
  const auto node = tests::open_coordinator(options);
  ASSERT_TRUE(node);
  node->read<Beacon>([&](Beacon beacon, LocalTime) { inbox.push(std::move(beacon)); });

  options.seat = {dds::Hub::kGround, std::nullopt};
  auto opened = dds::Participant::open(options);
  ASSERT_TRUE(opened);
  dds::Participant stranger = std::move(opened).value();
  const dds::fast::api::TypeSupport type(new tests::AnyBytes);
  type.register_type(stranger.get(), dds::kTopic<Beacon>.type);
  auto* topic = stranger->create_topic("rt/gyre/phase", dds::kTopic<Beacon>.type, dds::fast::api::TOPIC_QOS_DEFAULT);
  dds::fast::api::DataWriterQos qos = dds::fast::api::DATAWRITER_QOS_DEFAULT;
  qos.data_sharing().off();
  auto* writer = stranger.publisher().create_datawriter(topic, qos);

  // term, sequence, time, revision, base plan: 56 bytes, then a list of four thousand million transitions.
  tests::AnyBytes::Bytes endless(4 + 56, 0);
  endless[1] = 1;
  endless.insert(endless.end(), 4, 0xFF);
  const std::vector<tests::AnyBytes::Bytes> nonsense = {
      {},
      {0},
      {0, 1, 0, 0},
      {9, 9, 9, 9, 1, 2, 3},                 // no encapsulation there is
      {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0},  // stops early
      endless,
      tests::AnyBytes::Bytes(1000, 0xFF),  // over the type's bound: Fast DDS drops it itself
  };
  const LocalTime deadline = dds::now() + 10s;
  while (node->counters().undecodable < 20 && dds::now() < deadline) {
    for (tests::AnyBytes::Bytes bytes : nonsense) static_cast<void>(dds::fast::write(*writer, &bytes));
    EXPECT_TRUE(inbox.wait_until(dds::now() + 5ms).empty());
  }
  EXPECT_GE(node->counters().undecodable, 20U);

  const auto agent = tests::open(options, {dds::Hub::kSimulator, std::nullopt});
  const auto good = agent->writer<Beacon>();
  EXPECT_TRUE(wait_for(
      inbox, [](const Beacon& b) { return b.sequence == 42; },
      [&] {
        good.write({1, 42, {}, {}, std::nullopt, {}});
      }));
}

/// The local addresses of this process's UDP sockets, as /proc shows them: "0100007F:1CE8".
std::set<std::string> own_udp_addresses() {
  std::set<std::string> inodes;
  DIR* const directory = ::opendir("/proc/self/fd");
  while (const dirent* entry = ::readdir(directory)) {
    char target[64] = {};
    const std::string path = std::string("/proc/self/fd/") + entry->d_name;
    if (::readlink(path.c_str(), target, sizeof target - 1) <= 0) continue;
    const std::string link = target;  // "socket:[1234]"
    if (link.rfind("socket:[", 0) == 0) inodes.insert(link.substr(8, link.size() - 9));
  }
  ::closedir(directory);
  std::set<std::string> addresses;
  std::ifstream table("/proc/self/net/udp");
  std::string line;
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::vector<std::string> columns{std::istream_iterator<std::string>(words), {}};
    if (columns.size() > 9 && inodes.count(columns[9]) > 0) addresses.insert(columns[1]);
  }
  return addresses;
}

bool discovery_group_joined() {
  std::ifstream table("/proc/self/net/igmp");
  const std::string text{std::istreambuf_iterator<char>(table), {}};
  return text.find("0100FFEF") != std::string::npos;  // 239.255.0.1, as the kernel prints it
}

TEST(Node, IsOnLoopbackAloneAndJoinsNoMulticastGroup) {
  const bool joined_before = discovery_group_joined();
  dds::NodeOptions options;
  const auto node = tests::open_coordinator(options);
  ASSERT_TRUE(node);
  node->read<Beacon>([](Beacon, LocalTime) {});
  const auto writer = node->writer<Beacon>();
  writer.write({});
  EXPECT_EQ(discovery_group_joined(), joined_before);
  const std::set<std::string> addresses = own_udp_addresses();
  ASSERT_GE(addresses.size(), 2U) << "discovery and user data";
  // A socket bound to 127.0.0.1 receives no multicast, whatever groups the machine is in.
  for (const std::string& address : addresses) EXPECT_EQ(address.substr(0, 8), "0100007F") << address;
}

}  // namespace
}  // namespace gyre
