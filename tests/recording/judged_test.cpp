// Messages of every type, filled at random, in a recording that others read.

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <tuple>

#include "common/dds/payload.hpp"
#include "common/dds/topics.hpp"
#include "ground/recording/core/recording.hpp"
#include "ground/recording/recording_file.hpp"
#include "tests/dds/random_messages.hpp"
#include "tests/recording/judge.hpp"
#include "tests/recording/said_of.hpp"

namespace gyre::tests {
namespace {

template <class Message>
void add_one(ground::Recording& recording, std::uint64_t& time_ns) {
  const auto payload = dds::encode_payload(random_message<Message>());
  if (!payload) return;
  const dds::Topic& topic = dds::kTopic<Message>;
  const auto carrier = topic.per_carrier ? std::optional<CarrierId>(3) : std::nullopt;
  recording.add({dds::topic_name(topic, carrier), topic.type, {}, {}, time_ns, 1, time_ns, *payload});
  ++time_ns;
}

template <class... Messages>
void add_each(std::tuple<Messages...> /*all*/, ground::Recording& recording, std::uint64_t& time_ns) {
  (add_one<Messages>(recording, time_ns), ...);
}

TEST(Judged, RandomMessagesOfEveryTypeAreReadByOthers) {
  const std::string path = testing::TempDir() + "judged-" + std::to_string(::getpid());
  const std::string said_path = path + ".json";
  {
    auto created = ground::RecordingFile::create(path, ground::RecordingFile::Existing::kReplace);
    ASSERT_TRUE(created.ok());
    ground::RecordingFile file = std::move(created).value();
    ground::Recording recording("test", {});
    const auto append = [&](const Bytes& piece) {
      ASSERT_FALSE(file.append(piece));
      recording.writer().written();
    };
    append(recording.begin());
    std::uint64_t time_ns = 1;
    ASSERT_TRUE(holds([&] { add_each(dds::EveryMessage{}, recording, time_ns); }));
    append(recording.writer().close_chunk());
    append(recording.writer().finish(recording.last_word({})));
  }
  const nlohmann::json said = said_of(path);
  ASSERT_EQ(said["topics"].size(), std::tuple_size_v<dds::EveryMessage>);
  std::ofstream(said_path) << said.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const bool was_judged = judged("judge.mjs", path + " " + said_path);
  std::filesystem::remove(path);
  std::filesystem::remove(said_path);
  if (!was_judged) GTEST_SKIP() << "no Node, or no npm: see above";
}

}  // namespace
}  // namespace gyre::tests
