#pragma once
// A recording on disk, written by our own writer, of messages that nobody had to send.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "common/dds/payload.hpp"
#include "common/dds/topics.hpp"
#include "ground/recording/core/recording.hpp"
#include "ground/recording/recording_file.hpp"

namespace gyre::test {

class WrittenRecording {
 public:
  explicit WrittenRecording(const std::string& path)
      : file_(create(path)), recording_("test", {{"begin", "2026-01-02T03:04:05Z"}, {"domain", "7"}}) {
    append(recording_.begin());
  }

  template <class Message>
  void add(LocalTime arrived, const Message& message) {
    const auto log_ns = static_cast<std::uint64_t>(arrived.time_since_epoch().count());
    const auto payload = dds::encode_payload(message);
    ASSERT_TRUE(payload);
    const auto& topic = dds::kTopic<Message>;
    std::optional<CarrierId> carrier;
    if constexpr (dds::kTopic<Message>.per_carrier) carrier = message.carrier;
    recording_.add({dds::topic_name(topic, carrier), topic.type, {}, {}, ++sequence_, 1, log_ns, *payload});
    if (recording_.writer().due(log_ns)) append(recording_.writer().close_chunk());
  }

  void finish() {
    append(recording_.writer().close_chunk());
    append(recording_.writer().finish({"gyre_recording", {{"lost", "0"}}}));
  }

 private:
  static ground::RecordingFile create(const std::string& path) {
    auto created = ground::RecordingFile::create(path, ground::RecordingFile::Existing::kReplace);
    EXPECT_TRUE(created.ok());
    return std::move(created).value();
  }
  void append(const Bytes& piece) {
    EXPECT_FALSE(file_.append(piece));
    recording_.writer().written();
  }

  ground::RecordingFile file_;
  ground::Recording recording_;
  std::uint64_t sequence_ = 0;
};

}  // namespace gyre::test
