// The thread that writes: everything that is pushed, from however many threads, is in the file; what is not is counted.

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "common/dds/clock.hpp"
#include "common/dds/payload.hpp"
#include "ground/recording/core/mcap_index.hpp"
#include "ground/recording/recorder.hpp"
#include "tests/recording/said_of.hpp"

namespace gyre::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    auto file = ground::RecordingFile::create(path, ground::RecordingFile::Existing::kReplace);
    recorder = std::make_unique<ground::Recorder>(std::move(file).value(), ground::RecordingBegin{kBegin_ns, begin},
                                                  std::map<std::string, std::string>{}, std::nullopt);
  }
  ~RecorderTest() override { std::filesystem::remove(path); }

  template <class Message>
  dds::RecordedSample sample(const Message& message, std::uint8_t writer, std::uint64_t sequence,
                             std::optional<CarrierId> carrier = std::nullopt) const {
    const dds::Topic& topic = dds::kTopic<Message>;
    dds::RecordedSample sample;
    sample.topic = std::make_shared<const dds::RecordedTopic>(
        dds::RecordedTopic{dds::topic_name(topic, carrier), topic.type, topic.delivery});
    sample.writer = {writer};
    sample.sequence = sequence;
    sample.source_ns = 77;
    sample.arrived = begin + std::chrono::seconds(2);
    sample.payload = *dds::encode_payload(message);
    return sample;
  }

  static constexpr std::uint64_t kBegin_ns = 1'700'000'000'000'000'000;
  const LocalTime begin = dds::now();
  const std::string path = testing::TempDir() + "recorder-" + std::to_string(::getpid()) + ".mcap";
  std::unique_ptr<ground::Recorder> recorder;
};

TEST_F(RecorderTest, KeepsWhatEveryThreadPushes) {
  std::vector<std::thread> threads;
  for (std::uint8_t thread = 1; thread <= 4; ++thread) {
    threads.emplace_back([this, thread] {
      for (std::uint64_t i = 1; i <= 500; ++i) recorder->push(sample(protocol::Health{}, thread, i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  const auto end = recorder->finish();
  EXPECT_TRUE(end.complete) << end.line;
  EXPECT_THAT(end.line, HasSubstr("2 000 messages"));
  EXPECT_THAT(end.line, HasSubstr("lost on the wire: 0"));
  const json said = said_of(path);
  EXPECT_TRUE(said["whole"].get<bool>());
  EXPECT_EQ(said["topics"]["/gyre/health"], 2000);
  const auto source = ground::open_recording(path);
  ASSERT_TRUE(source.ok());
  const auto index = ground::McapIndex::open(*source.value());
  ASSERT_TRUE(index.ok()) << index.error().text;
  const auto first = index.value().messages().next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->log_ns, kBegin_ns + 2'000'000'000U) << "the wall clock of the beginning, and the steady one since";
  EXPECT_EQ(first->publish_ns, 77U);
}

TEST_F(RecorderTest, LearnsWhoFliesAndShowsThem) {
  protocol::CoordinatorStatus word;
  word.term = 1;
  word.carriers = {2, 5};
  recorder->push(sample(word, 1, 1));
  protocol::CarrierState state;
  state.carrier = 5;
  state.incarnation = 1;
  recorder->push(sample(state, 1, 1, 5));
  protocol::LoadState load;
  load.incarnation = 1;
  recorder->push(sample(load, 1, 1));
  // Of the same moment: the picture is shown with the first sample of it, so one of the next.
  auto later = sample(load, 1, 2);
  later.arrived += std::chrono::seconds(1);
  recorder->push(later);
  (void)recorder->finish();
  EXPECT_EQ(recorder->carriers(), (std::set<CarrierId>{2, 5}));
  const json said = said_of(path);
  for (const char* topic : {"/tf", "/gyre/scene", "/gyre/load_pose"})
    EXPECT_GE(said["topics"].value(topic, 0), 1) << topic;
}

TEST_F(RecorderTest, CountsWhatFindsNoRoom) {
  dds::RecordedSample huge = sample(protocol::Health{}, 1, 1);
  huge.payload.resize(std::size_t{65} << 20);  // more than the queue may take
  recorder->push(huge);
  recorder->push(sample(protocol::Health{}, 1, 2));
  const auto end = recorder->finish();
  EXPECT_FALSE(end.complete);
  EXPECT_EQ(said_of(path)["metadata"]["gyre_recording"]["lost_because_the_disk_was_slow"], "1");
  EXPECT_EQ(said_of(path)["messages"], 1);
}

TEST_F(RecorderTest, EndsAsIfKilledWithoutAWordOfIts) {
  recorder->push(sample(protocol::Health{}, 1, 1));
  recorder.reset();
  const json said = said_of(path);
  EXPECT_FALSE(said["whole"].get<bool>());
  EXPECT_THAT(said["problems"].dump(), HasSubstr("cut off"));
}

}  // namespace
}  // namespace gyre::tests
