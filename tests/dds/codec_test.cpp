// Laws of the codec: what goes in comes out, bit for bit; what does not fit does not go in; what is no message does not
// come out.

#include "common/dds/codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/dds/strict_type.hpp"
#include "common/dds/topics.hpp"
#include "tests/dds/random_messages.hpp"

namespace gyre {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace): the messages are the subject

template <class Message>
class EveryMessage : public testing::Test {};

using Messages =
    testing::Types<Beacon, PlanOffer, HeldPlans, TimeRequest, TimeReply, AgentStatus, Setpoint, CarrierState, LoadState,
                   Command, CommandReply, CoordinatorStatus, MissionText, Health, Disturbance, JournalPiece>;
TYPED_TEST_SUITE(EveryMessage, Messages);

/// A message through the generated serialisation as well, as it crosses the wire.
template <class Message>
class Channel {
 public:
  using Support = typename dds::Wire<Message>::Support;
  using Type = typename dds::Wire<Message>::Type;

  Channel() : refused_(std::make_shared<std::atomic<std::uint64_t>>(0)), type_(refused_) {}

  [[nodiscard]] std::vector<unsigned char> send(Type wire) {
    dds::fast::rtps::SerializedPayload_t payload(dds::fast::wire_size(type_, wire));
    EXPECT_TRUE(dds::fast::serialize(type_, wire, dds::fast::passed(payload)));
    return {payload.data, payload.data + payload.length};
  }

  [[nodiscard]] std::optional<Message> receive(const std::vector<unsigned char>& bytes) {
    dds::fast::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
    std::copy(bytes.begin(), bytes.end(), payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    Type wire;
    if (!type_.deserialize(dds::fast::passed(payload), &wire)) return std::nullopt;
    return dds::decode(wire);
  }

  [[nodiscard]] std::uint64_t refused() const { return *refused_; }

 private:
  std::shared_ptr<std::atomic<std::uint64_t>> refused_;
  dds::StrictType<Support> type_;
};

TYPED_TEST(EveryMessage, CrossesTheWireBitForBit) {
  EXPECT_TRUE(tests::holds([] {
    const auto message = tests::random_message<TypeParam>();
    Channel<TypeParam> channel;
    const auto wire = dds::encode(message);
    RC_ASSERT(wire.has_value());
    const auto back = channel.receive(channel.send(*wire));
    RC_ASSERT(back.has_value());
    RC_ASSERT(tests::bits_of(*back) == tests::bits_of(message));
    RC_ASSERT(channel.refused() == 0U);
  }));
}

TYPED_TEST(EveryMessage, CutShortIsRefusedAndCounted) {
  EXPECT_TRUE(tests::holds([] {
    Channel<TypeParam> channel;
    const auto bytes = channel.send(*dds::encode(tests::random_message<TypeParam>()));
    const auto size = *rc::gen::inRange<std::size_t>(0, bytes.size());
    RC_ASSERT(!channel.receive({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}));
    RC_ASSERT(channel.refused() == 1U);
  }));
}

TYPED_TEST(EveryMessage, WithMoreBehindItThanPaddingIsRefused) {
  EXPECT_TRUE(tests::holds([] {
    Channel<TypeParam> channel;
    auto bytes = channel.send(*dds::encode(tests::random_message<TypeParam>()));
    bytes.resize(bytes.size() + *rc::gen::inRange<std::size_t>(0, 4));
    RC_ASSERT(channel.receive(bytes).has_value());
    bytes.resize(bytes.size() + *rc::gen::inRange<std::size_t>(4, 400));
    RC_ASSERT(!channel.receive(bytes));
  }));
}

TYPED_TEST(EveryMessage, IsNeverFoundInNoise) {
  Channel<TypeParam> channel;
  std::size_t accepted = 0;
  EXPECT_TRUE(tests::holds([&] {
    auto bytes = *rc::gen::container<std::vector<unsigned char>>(rc::gen::arbitrary<unsigned char>());
    if (bytes.size() >= 4) bytes[0] = bytes[2] = bytes[3] = 0, bytes[1] = *rc::gen::element<unsigned char>(0, 1);
    accepted += channel.receive(bytes) ? 1U : 0U;  // sizes up to 100: only a fixed-size message can be met by chance
  }));
  EXPECT_GT(channel.refused(), 0U);
  EXPECT_LT(accepted, 20U);
}

TEST(Codec, PutsEveryQuantityIntoItsOwnField) {
  Setpoint setpoint;
  setpoint.carrier = 7;
  setpoint.sequence = 8;
  setpoint.swarm_time = SwarmTime(Duration(9));
  setpoint.position_w_m = {1, 2, 3};
  setpoint.velocity_w_m_s = {4, 5, 6};
  setpoint.acceleration_w_m_s2 = {7, 8, 9};
  setpoint.direction_w = {10, 11, 12};
  setpoint.tension_n = 13;
  setpoint.cable_length_m = 14;
  setpoint.winch_length_m = 15;
  setpoint.winch_rate_m_s = 16;
  setpoint.winch_acceleration_m_s2 = 17;
  const auto wire = dds::encode(setpoint);
  ASSERT_TRUE(wire);
  using Triple = std::array<double, 3>;
  EXPECT_EQ(wire->carrier(), 7U);
  EXPECT_EQ(wire->sequence_number(), 8U);
  EXPECT_EQ(wire->swarm_time_ns(), 9);
  EXPECT_EQ(wire->position_w_m(), (Triple{1, 2, 3}));
  EXPECT_EQ(wire->velocity_w_m_s(), (Triple{4, 5, 6}));
  EXPECT_EQ(wire->acceleration_w_m_s2(), (Triple{7, 8, 9}));
  EXPECT_EQ(wire->direction_w(), (Triple{10, 11, 12}));
  EXPECT_EQ(wire->tension_n(), 13);
  EXPECT_EQ(wire->cable_length_m(), 14);
  EXPECT_EQ(wire->winch_length_m(), 15);
  EXPECT_EQ(wire->winch_rate_m_s(), 16);
  EXPECT_EQ(wire->winch_acceleration_m_s2(), 17);
}

TEST(Codec, PutsWhatACourseIsMadeOfIntoItsOwnFields) {
  Beacon beacon;
  Course& course = beacon.proposal.emplace();
  course.term = 1;
  course.revision = 2;
  course.wish = {0.25, true, Wisher::kPerson};
  course.pace.ramps = {{SwarmTime(Duration(3)), Duration(4), {PlanTime(Duration(5)), 0.1, 0.2, 0.3}, 0.4}};
  course.lease = SwarmTime(Duration(6));
  course.stopping = Duration(7);
  course.base = {{8, 9}, PlanTime(Duration(10))};
  course.transitions = {{{{11, 12}, PlanTime(Duration(13))}, PlanTime(Duration(14)), Duration(15)}};
  const auto encoded = dds::encode(beacon);
  ASSERT_TRUE(encoded);
  ASSERT_EQ(encoded->proposal().size(), 1U);
  const auto& wire = encoded->proposal().front();
  EXPECT_EQ(wire.term(), 1U);
  EXPECT_EQ(wire.revision(), 2U);
  EXPECT_EQ(wire.wish().pace(), 0.25);
  EXPECT_TRUE(wire.wish().rest_when_changed());
  EXPECT_EQ(wire.wish().by(), 3);
  ASSERT_EQ(wire.pace().size(), 1U);
  EXPECT_EQ(wire.pace()[0].swarm_start_ns(), 3);
  EXPECT_EQ(wire.pace()[0].duration_ns(), 4);
  EXPECT_EQ(wire.pace()[0].plan_from_ns(), 5);
  EXPECT_EQ(wire.pace()[0].from_pace(), 0.1);
  EXPECT_EQ(wire.pace()[0].from_rate_1_s(), 0.2);
  EXPECT_EQ(wire.pace()[0].from_curvature_1_s2(), 0.3);
  EXPECT_EQ(wire.pace()[0].target_pace(), 0.4);
  EXPECT_EQ(wire.swarm_lease_ns(), std::vector<std::int64_t>{6});
  EXPECT_EQ(wire.stopping_ns(), 7);
  EXPECT_EQ(wire.base().number().term(), 8U);
  EXPECT_EQ(wire.base().number().revision(), 9U);
  EXPECT_EQ(wire.base().plan_epoch_ns(), 10);
  ASSERT_EQ(wire.transitions().size(), 1U);
  EXPECT_EQ(wire.transitions()[0].to().number().revision(), 12U);
  EXPECT_EQ(wire.transitions()[0].to().plan_epoch_ns(), 13);
  EXPECT_EQ(wire.transitions()[0].plan_start_ns(), 14);
  EXPECT_EQ(wire.transitions()[0].plan_duration_ns(), 15);
}

// By hand, so that every release of Fast DDS is held to the same bytes: XCDR1 puts eight bytes at multiples of eight,
// where XCDR2 would be content with four, and says so in the first two bytes.
TEST(Codec, TravelsAsPlainCdr) {
  const TimeRequest request{0x0A, 0x0B, 0x0C, LocalTime(Duration(0x0D))};
  const std::vector<unsigned char> expected = {
      0,    1, 0, 0,              // plain CDR, little endian, no options
      0x0A, 0, 0, 0, 0, 0, 0, 0,  // carrier, padding
      0x0B, 0, 0, 0, 0, 0, 0, 0,  // incarnation
      0x0C, 0, 0, 0, 0, 0, 0, 0,  // sequence number
      0x0D, 0, 0, 0, 0, 0, 0, 0,  // sent
  };
  EXPECT_EQ(Channel<TimeRequest>().send(*dds::encode(request)), expected);
}

TEST(Codec, QuaternionsTravelInRosOrder) {
  LoadState state;
  state.orientation_w_b = Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4);  // w, x, y, z
  EXPECT_EQ(dds::encode(state)->orientation_w_b_xyzw(), (std::array<double, 4>{0.2, 0.3, 0.4, 0.1}));
}

TEST(Codec, ListsOverTheirBoundNeitherGoNorCome) {
  Beacon beacon;
  beacon.course.transitions.resize(kMaxTransitions + 1);
  EXPECT_FALSE(dds::encode(beacon));
  PlanOffer offer;
  offer.slices.resize(kMaxPlans + 1);
  EXPECT_FALSE(dds::encode(offer));
  HeldPlans held;
  held.slices.resize(kMaxPlans + 1);
  EXPECT_FALSE(dds::encode(held));
  CoordinatorStatus coordinator;
  coordinator.silent.resize(kMaxCarrierId);
  EXPECT_TRUE(dds::encode(coordinator));
  coordinator.silent.resize(kMaxCarrierId + 1);
  EXPECT_FALSE(dds::encode(coordinator));
  AgentStatus status;
  status.accepted.resize(kMaxPlans + 1);
  EXPECT_FALSE(dds::encode(status));
  status.accepted.clear();
  status.course.transitions.resize(kMaxTransitions + 1);
  EXPECT_FALSE(dds::encode(status));

  for (const bool proposed : {false, true}) {
    Beacon ramps;
    Course& course = proposed ? ramps.proposal.emplace() : ramps.course;
    course.pace.ramps.resize(kMaxRamps);
    EXPECT_TRUE(dds::encode(ramps));
    course.pace.ramps.resize(kMaxRamps + 1);
    EXPECT_FALSE(dds::encode(ramps));
  }

  auto wire_beacon = *dds::encode(Beacon{});
  wire_beacon.course().transitions().resize(kMaxTransitions + 1, wire_beacon.course().transitions().emplace_back());
  EXPECT_FALSE(dds::decode(wire_beacon));
  auto wire_ramps = *dds::encode(Beacon{});
  wire_ramps.course().pace().resize(kMaxRamps);
  EXPECT_TRUE(dds::decode(wire_ramps));
  wire_ramps.course().pace().emplace_back();
  EXPECT_FALSE(dds::decode(wire_ramps));
  auto wire_leases = *dds::encode(Beacon{});
  wire_leases.course().swarm_lease_ns().assign(1, 5);
  EXPECT_TRUE(dds::decode(wire_leases));
  wire_leases.course().swarm_lease_ns().assign(2, 5);
  EXPECT_FALSE(dds::decode(wire_leases));
  auto wire_proposals = *dds::encode(Beacon{});
  wire_proposals.proposal().assign(1, wire_proposals.course());
  EXPECT_TRUE(dds::decode(wire_proposals));
  wire_proposals.proposal().assign(2, wire_proposals.course());
  EXPECT_FALSE(dds::decode(wire_proposals));
  wire_proposals.proposal().assign(1, wire_ramps.course());
  EXPECT_FALSE(dds::decode(wire_proposals)) << "what is proposed is read as strictly as what is flown";
  auto wire_offer = *dds::encode(PlanOffer{0, 0, 0, {NumberedSlice{}}, {}});
  const auto entry = wire_offer.slices().front();
  wire_offer.slices().resize(kMaxPlans, entry);
  EXPECT_TRUE(dds::decode(wire_offer));
  wire_offer.slices().push_back(entry);
  EXPECT_FALSE(dds::decode(wire_offer));
  auto wire_held = *dds::encode(HeldPlans{});
  wire_held.slices().resize(kMaxPlans, entry);
  EXPECT_TRUE(dds::decode(wire_held));
  wire_held.slices().push_back(entry);
  EXPECT_FALSE(dds::decode(wire_held));
  auto wire_coordinator = *dds::encode(CoordinatorStatus{});
  wire_coordinator.silent().resize(kMaxCarrierId + 1);
  EXPECT_FALSE(dds::decode(wire_coordinator));
  auto wire_status = *dds::encode(AgentStatus{});
  wire_status.accepted().resize(kMaxPlans + 1);
  EXPECT_FALSE(dds::decode(wire_status));
}

TEST(Codec, EnumeratorsThatDoNotExistAreNoMessage) {
  Beacon beacon;
  beacon.proposal.emplace();
  for (const int value : {0, 6, 255}) {
    auto wire = *dds::encode(beacon);
    ASSERT_TRUE(dds::decode(wire));
    wire.course().wish().by(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(wire)) << value;
    wire = *dds::encode(beacon);
    wire.proposal().front().wish().by(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(wire)) << value;
  }
  for (const int value : {0, 5, 255}) {
    auto offer = *dds::encode(PlanOffer{1, 1, 1, {NumberedSlice{}}, {}});
    ASSERT_TRUE(dds::decode(offer));
    offer.slices().front().slice().law().kind(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(offer)) << value;
    auto held = *dds::encode(HeldPlans{1, 1, {NumberedSlice{}}, {}});
    ASSERT_TRUE(dds::decode(held));
    held.slices().front().slice().law().kind(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(held)) << value;
    auto status = *dds::encode(AgentStatus{});
    ASSERT_TRUE(dds::decode(status));
    status.state(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(status)) << value;
  }
  for (const int value : {0, 6, 255}) {
    auto command = *dds::encode(Command{});
    ASSERT_TRUE(dds::decode(command));
    command.kind(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(command)) << value;
  }
  for (const int value : {0, 4, 255}) {
    auto disturbance = *dds::encode(Disturbance{});
    ASSERT_TRUE(dds::decode(disturbance));
    disturbance.kind(static_cast<std::uint8_t>(value));
    EXPECT_FALSE(dds::decode(disturbance)) << value;
  }
}

TEST(Codec, AMissionIsSentWholeOrNotAtAll) {
  const auto retune = [](std::string mission) {
    return Command{1, CommandKind::kRetune, 1.0, std::nullopt, std::move(mission)};
  };
  EXPECT_TRUE(dds::encode(retune(std::string(kMaxMissionBytes, 'm'))));
  EXPECT_FALSE(dds::encode(retune(std::string(kMaxMissionBytes + 1, 'm'))));
  EXPECT_FALSE(dds::encode(retune(std::string("name\0hidden", 11))));
  EXPECT_TRUE(dds::encode(MissionText{1, {1, 2}, std::string(kMaxMissionBytes, 'm')}));
  EXPECT_FALSE(dds::encode(MissionText{1, {1, 2}, std::string(kMaxMissionBytes + 1, 'm')}));
}

TEST(Codec, TextsAreCutBetweenCharacters) {
  EXPECT_EQ(dds::fitting_text("tension", 255), "tension");
  EXPECT_EQ(dds::fitting_text("tension", 3), "ten");
  EXPECT_EQ(dds::fitting_text("aλb", 1), "a");
  EXPECT_EQ(dds::fitting_text("aλb", 2), "a");  // λ is two bytes
  EXPECT_EQ(dds::fitting_text("aλb", 3), "aλ");
  EXPECT_EQ(dds::fitting_text("a𝛌b", 4), "a");  // this one four
  EXPECT_EQ(dds::fitting_text("a𝛌b", 5), "a𝛌");
  EXPECT_EQ(dds::fitting_text(std::string("a\0b", 3), 255), "a");
  const CommandReply reply{1, true, std::string(kMaxTextBytes - 1, 'x') + "λ"};
  EXPECT_EQ(dds::decode(*dds::encode(reply))->text, std::string(kMaxTextBytes - 1, 'x'));
  CoordinatorStatus status;
  status.mission = status.news = reply.text;
  EXPECT_EQ(dds::decode(*dds::encode(status))->mission, std::string(kMaxTextBytes - 1, 'x'));
  EXPECT_EQ(dds::decode(*dds::encode(status))->news, std::string(kMaxTextBytes - 1, 'x'));
}

TEST(Topics, FollowRosNamesAndNameTheCarrier) {
  EXPECT_EQ(dds::topic_name(dds::kTopic<Beacon>, std::nullopt), "rt/gyre/phase");
  EXPECT_EQ(dds::topic_name(dds::kTopic<PlanOffer>, 3), "rt/gyre/carrier_3/plan");
  EXPECT_EQ(dds::topic_name(dds::kTopic<TimeRequest>, 3), "rt/gyre/carrier_3/time_request");
  EXPECT_EQ(dds::topic_name(dds::kTopic<TimeReply>, 3), "rt/gyre/carrier_3/time_reply");
  EXPECT_EQ(dds::topic_name(dds::kTopic<AgentStatus>, 3), "rt/gyre/carrier_3/status");
  EXPECT_EQ(dds::topic_name(dds::kTopic<Setpoint>, 3), "rt/gyre/carrier_3/setpoint");
  EXPECT_EQ(dds::topic_name(dds::kTopic<CarrierState>, 100), "rt/gyre/carrier_100/state");
  EXPECT_EQ(dds::topic_name(dds::kTopic<LoadState>, std::nullopt), "rt/gyre/load/state");
  EXPECT_EQ(dds::topic_name(dds::kTopic<Command>, std::nullopt), "rt/gyre/command");
  EXPECT_EQ(dds::topic_name(dds::kTopic<CommandReply>, std::nullopt), "rt/gyre/command_reply");
  EXPECT_EQ(dds::topic_name(dds::kTopic<HeldPlans>, 3), "rt/gyre/carrier_3/held");
  EXPECT_EQ(dds::topic_name(dds::kTopic<CoordinatorStatus>, std::nullopt), "rt/gyre/coordinator/status");
  EXPECT_EQ(dds::topic_name(dds::kTopic<MissionText>, std::nullopt), "rt/gyre/mission");
  EXPECT_EQ(dds::topic_name(dds::kTopic<Health>, std::nullopt), "rt/gyre/health");
  EXPECT_EQ(dds::topic_name(dds::kTopic<Disturbance>, std::nullopt), "rt/gyre/laboratory");
}

TYPED_TEST(EveryMessage, IsRegisteredUnderItsGeneratedTypesRosName) {
  const dds::fast::api::TypeSupport support(new typename dds::Wire<TypeParam>::Support);
  const std::string generated = support.get_type_name();  // "gyre_msgs::msg::Beacon"
  const std::string name = generated.substr(generated.rfind(':') + 1);
  EXPECT_EQ(dds::kTopic<TypeParam>.type, "gyre_msgs::msg::dds_::" + name + "_");
}

}  // namespace
}  // namespace gyre
