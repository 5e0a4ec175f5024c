// What a recording counts, and the scene it shows.

#include <gmock/gmock.h>

#include <cstring>

#include "ground/recording/core/recording.hpp"
#include "tests/recording/mcap_files.hpp"

namespace gyre::tests {
namespace {

using ground::Arrival;
using ground::Recording;
using testing::HasSubstr;

ground::WriterId writer(std::uint8_t number) {
  return {number};
}

Arrival beacon(std::uint8_t from, std::uint64_t sequence, std::uint64_t log_ns = 1000) {
  return {"rt/gyre/phase", "gyre_msgs::msg::dds_::Beacon_", {}, writer(from), sequence, 900, log_ns, {0, 1, 0, 0, 7}};
}

TEST(LossLedger, CountsGapsOfEachWriterByItself) {
  ground::LossLedger ledger;
  EXPECT_EQ(ledger.see(writer(1), 40), 0U) << "before it nobody listened";
  EXPECT_EQ(ledger.see(writer(1), 41), 0U);
  EXPECT_EQ(ledger.see(writer(2), 7), 0U);
  EXPECT_EQ(ledger.see(writer(1), 45), 3U);
  EXPECT_EQ(ledger.see(writer(2), 8), 0U);
  EXPECT_EQ(ledger.see(writer(1), 44), 0U) << "late";
  EXPECT_EQ(ledger.see(writer(1), 45), 0U) << "twice";
  EXPECT_EQ(ledger.see(writer(1), 46), 0U);
}

TEST(Recording, KeepsBytesTimesAndNumbers) {
  Recording recording("1.2", {{"domain", "7"}});
  Bytes file = recording.begin();
  recording.writer().written();
  recording.add(beacon(1, 0x1'0000'0005));
  Arrival silent_about_time = beacon(1, 0x1'0000'0006, 2000);
  silent_about_time.source_ns = 0;
  recording.add(silent_about_time);
  const Bytes chunk = recording.writer().close_chunk();
  file.insert(file.end(), chunk.begin(), chunk.end());
  const Streamed read = streamed(file);
  ASSERT_EQ(read.messages.size(), 2U);
  EXPECT_EQ(read.messages[0].payload, (Bytes{0, 1, 0, 0, 7}));
  EXPECT_EQ(read.messages[0].sequence, 5U);
  EXPECT_EQ(read.messages[0].log_ns, 1000U);
  EXPECT_EQ(read.messages[0].publish_ns, 900U);
  EXPECT_EQ(read.messages[1].publish_ns, 2000U) << "not known: the log time";
  EXPECT_EQ(read.metadata.front().entries.at("domain"), "7");
}

TEST(Recording, TellsHowTopicsWereOffered) {
  Recording recording("1.2", {});
  Bytes file = recording.begin();
  recording.writer().written();
  recording.add(beacon(1, 1));
  recording.add({"rt/gyre/carrier_3/plan", "gyre_msgs::msg::dds_::PlanOffer_", {true, true}, writer(1), 1, 1, 1, {}});
  const Bytes chunk = recording.writer().close_chunk();
  file.insert(file.end(), chunk.begin(), chunk.end());
  const BytesSource source(file);
  auto stream = ground::McapStream::open(source);
  ASSERT_TRUE(stream.ok());
  ground::McapStream reader = std::move(stream).value();
  while (reader.next()) {
  }
  ASSERT_EQ(reader.directory().channels().size(), 2U);
  const ground::Channel& phase = reader.directory().channels().at(0);
  EXPECT_EQ(phase.topic, "/gyre/phase");
  EXPECT_EQ(phase.encoding, "cdr");
  EXPECT_THAT(phase.metadata.at("offered_qos_profiles"), HasSubstr("reliability: 2\n  durability: 2\n"));
  const ground::Channel& plan = reader.directory().channels().at(1);
  EXPECT_THAT(plan.metadata.at("offered_qos_profiles"), HasSubstr("reliability: 1\n  durability: 1\n"));
  EXPECT_EQ(reader.directory().schemas().at(plan.schema).name, "gyre_msgs/msg/PlanOffer");
  EXPECT_EQ(reader.directory().schemas().at(plan.schema).encoding, "ros2msg");
}

TEST(Recording, SaysWhatIsMissing) {
  Recording recording("1.2", {});
  recording.add(beacon(1, 1));
  recording.add(beacon(1, 4));
  Arrival status{
      "rt/gyre/carrier_12/status", "gyre_msgs::msg::dds_::AgentStatus_", {true, true}, writer(2), 1, 1, 1, {}};
  recording.add(status);
  status.sequence = 9;
  recording.add(status);
  EXPECT_EQ(recording.lost(), 2U) << "of a retained topic older samples may be skipped";
  const auto word = recording.last_word({5, 6, 1}).entries;
  EXPECT_EQ(word.at("lost"), "2");
  EXPECT_EQ(word.at("lost /gyre/phase"), "2");
  EXPECT_EQ(word.at("skipped /gyre/carrier_12/status"), "7");
  EXPECT_EQ(word.at("lost_because_the_disk_was_slow"), "5");
  EXPECT_EQ(word.at("not_written"), "6");
  const std::string table = ground::recording_table(recording.counts());
  EXPECT_THAT(table, HasSubstr("/gyre/carrier_N/status   2          0"));
  EXPECT_THAT(table, HasSubstr("/gyre/phase              2          2"));
  ground::Statistics written;
  written.messages = 12345;
  written.start_ns = 1'000'000'000;
  written.end_ns = 3'500'000'000;
  EXPECT_EQ(
      ground::recording_line(recording, written, 1'500'000, {5, 6, 1}),
      "2.5 s, 12 345 messages, 1.5 MB; lost on the wire: 2, 5 of them because the disk was too slow; not written, "
      "because the disk was full or failed: 6");
}

// ------------------------------------------------------------------------------------------------------- the scene

class SceneTest : public testing::Test {
 protected:
  void load(const Eigen::Vector3d& position_w_m, const Eigen::Quaterniond& orientation_w_b) {
    protocol::LoadState state;
    state.incarnation = 1;
    state.position_w_m = position_w_m;
    state.orientation_w_b = orientation_w_b;
    ASSERT_TRUE(view.step(now, state));
  }
  void vehicle(CarrierId id, const Eigen::Vector3d& position_w_m, double tension_n) {
    protocol::CarrierState state;
    state.carrier = id;
    state.incarnation = 1;
    state.position_w_m = position_w_m;
    state.tension_n = tension_n;
    ASSERT_TRUE(view.step(now, state));
  }
  void plan(CarrierId id, const mechanics::CarrierSlice& slice) {
    protocol::HeldPlans held;
    held.carrier = id;
    held.incarnation = 1;
    held.slices.push_back({{1, 1}, slice});
    ASSERT_TRUE(view.step(now, held));
  }
  static const ground::Marker* find(const std::vector<ground::Marker>& markers, const std::string& name) {
    for (const ground::Marker& marker : markers) {
      if (marker.name == name) return &marker;
    }
    return nullptr;
  }

  ground::SwarmView view;
  LocalTime now{std::chrono::seconds(5)};
};

TEST_F(SceneTest, IsEmptyBeforeAnythingIsHeard) {
  const ground::Scene scene = ground::scene(view, nullptr);
  EXPECT_FALSE(scene.load);
  EXPECT_TRUE(scene.frames.empty());
  EXPECT_TRUE(scene.markers.empty());
  EXPECT_TRUE(ground::planned_orbits(view).empty());
}

// By hand: the load turned by a quarter about z at (1, 2, 3); the attachment (1, 0, 0) of its body is at (1, 3, 3).
TEST_F(SceneTest, CablesMoveWithTheLoadWhereTheMissionIsKnown) {
  load({1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())));
  vehicle(4, {1, 3, 5}, 2.0);
  mission::Mission mission;
  mission.plan.carriers.push_back({4, {1, 0, 0}, {}, 0.25});
  mission.plan.load.hull_b_m = mechanics::box_hull({0.5, 1.0, 0.1}, {0.0, 0.0, -0.1});
  mission.plan.limits.tension_min_n = 1.0;
  mission.plan.limits.tension_max_n = 2.0;
  const ground::Scene scene = ground::scene(view, &mission);
  const ground::Marker* const cables = find(scene.markers, "cables");
  ASSERT_TRUE(cables);
  ASSERT_EQ(cables->points_m.size(), 2U);
  EXPECT_TRUE(cables->points_m[0].isApprox(Eigen::Vector3d(1, 3, 3)));
  EXPECT_TRUE(cables->points_m[1].isApprox(Eigen::Vector3d(1, 3, 5)));
  ASSERT_EQ(cables->colours.size(), 2U);
  EXPECT_GT(cables->colours[0].red, 0.9F) << "at its limit";
  EXPECT_LT(cables->colours[0].blue, 0.2F);
  const ground::Marker* const box = find(scene.markers, "load");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->shape, ground::MarkerShape::kCube);
  EXPECT_TRUE(box->size_m.isApprox(Eigen::Vector3d(1.0, 2.0, 0.2)));
  EXPECT_TRUE(box->pose.position_m.isApprox(Eigen::Vector3d(1, 2, 2.9)));
  const ground::Marker* const carrier = find(scene.markers, "carriers");
  ASSERT_TRUE(carrier);
  EXPECT_EQ(carrier->number, 4);
  EXPECT_DOUBLE_EQ(carrier->size_m.x(), 0.5);
  ASSERT_EQ(scene.frames.size(), 2U);
  EXPECT_EQ(scene.frames[0].frame, "load");
  EXPECT_EQ(scene.frames[1].frame, "carrier_4");
}

TEST_F(SceneTest, CablesEndWhereThePlanSaysWhereTheMissionIsNotKnown) {
  load({0, 0, 0}, Eigen::Quaterniond::Identity());
  vehicle(2, {0, 0, 2}, 1.0);
  EXPECT_FALSE(find(ground::scene(view, nullptr).markers, "cables")) << "nobody told where it begins";
  mechanics::CarrierSlice slice;
  slice.id = 2;
  slice.attachment_w_m = {0.5, 0, 0};
  slice.particular_force_w_n = {0, 0, 5};
  slice.incoming = {{1, 0, 0}, 0, 1, 0};
  slice.outgoing = {{0, 1, 0}, 0, 1, M_PI / 2};
  slice.rate_rad_s = 2.0;
  slice.law = mechanics::LengthLaw::fixed(2.0);
  plan(2, slice);
  const ground::Scene scene = ground::scene(view, nullptr);
  const ground::Marker* const cables = find(scene.markers, "cables");
  ASSERT_TRUE(cables);
  EXPECT_TRUE(cables->points_m[0].isApprox(slice.attachment_w_m));
  EXPECT_EQ(find(scene.markers, "load")->shape, ground::MarkerShape::kSphere);

  const auto orbits = ground::planned_orbits(view);
  ASSERT_EQ(orbits.size(), 1U);
  EXPECT_TRUE(orbits[0].points_m.front().isApprox(orbits[0].points_m.back())) << "a round is closed";
  for (const Eigen::Vector3d& point : orbits[0].points_m) {
    EXPECT_NEAR((point - slice.attachment_w_m).norm(), 2.0, 1e-9) << "a cable's length from its attachment";
  }
}

// Byte by byte, by hand.
TEST(VisualMessages, APoseIsPlainCdr) {
  ground::Pose pose;
  pose.position_m = {1.0, 0.0, 0.0};
  const Bytes cdr = ground::pose_cdr(3'000'000'002, pose);
  const Bytes head{0, 1, 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 6, 0, 0, 0, 'w', 'o', 'r', 'l', 'd', 0};
  ASSERT_EQ(cdr.size(), 4U + 24U + 7 * 8U);  // 18 bytes of stamp and frame, doubles from 24 on
  EXPECT_TRUE(std::equal(head.begin(), head.end(), cdr.begin()));
  double x = 0.0;
  std::memcpy(&x, cdr.data() + 4 + 24, sizeof(x));
  EXPECT_EQ(x, 1.0);
  std::memcpy(&x, cdr.data() + 4 + 24 + 6 * 8, sizeof(x));
  EXPECT_EQ(x, 1.0) << "w of no rotation";
}

}  // namespace
}  // namespace gyre::tests
