#pragma once
// MCAP files in memory, made by the writer, and what is read back from them.

#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ground/recording/core/mcap_index.hpp"
#include "ground/recording/core/mcap_stream.hpp"
#include "ground/recording/core/mcap_writer.hpp"

namespace gyre::tests {

class BytesSource final : public ground::McapSource {
 public:
  explicit BytesSource(Bytes bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] bool read(std::uint64_t offset, std::size_t count, std::uint8_t* to) const override {
    if (offset > bytes_.size() || count > bytes_.size() - offset) return false;
    if (count > 0) std::memcpy(to, bytes_.data() + offset, count);
    return true;
  }

 private:
  Bytes bytes_;
};

/// One that somebody writes by hand.
class FileInMemory {
 public:
  explicit FileInMemory(std::uint64_t chunk_bytes = 256) : writer(options(chunk_bytes)) {
    take(writer.begin({"about", {}}));
  }

  std::uint16_t channel(const std::string& topic) {
    return *writer.channel(writer.schema("test/msg/Text", "ros2msg", "string words\n"), topic, "cdr", {{"key", topic}});
  }
  void add(const ground::Message& message) {
    writer.add(message);
    if (writer.due(message.log_ns)) close_chunk();
  }
  void close_chunk() { take(writer.close_chunk()); }
  Bytes finish() {
    close_chunk();
    take(writer.finish({"last", {{"lost", "0"}}}));
    return bytes;
  }

  ground::McapWriter writer;
  Bytes bytes;
  std::vector<std::size_t> wholes;  ///< sizes at which the file was whole up to there

 private:
  static ground::McapWriterOptions options(std::uint64_t chunk_bytes) {
    ground::McapWriterOptions options;
    options.library = "test";
    options.chunk_bytes = chunk_bytes;
    return options;
  }
  void take(const Bytes& piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    if (!piece.empty()) writer.written();
    wholes.push_back(bytes.size());
  }
};

inline bool same(const ground::Message& a, const ground::Message& b) {
  return a.channel == b.channel && a.sequence == b.sequence && a.log_ns == b.log_ns && a.publish_ns == b.publish_ns &&
         a.payload == b.payload;
}

struct Streamed {
  std::vector<ground::Message> messages;
  std::vector<ground::Metadata> metadata;
  bool opened = false;
  bool whole = false;
  std::uint64_t problems = 0;
  std::string words;  ///< of the first problem, or why it is no such file
};

inline Streamed streamed(const Bytes& bytes) {
  Streamed all;
  const BytesSource source(bytes);
  auto stream = ground::McapStream::open(source);
  all.opened = stream.ok();
  if (!stream) {
    all.words = stream.error().text;
    return all;
  }
  ground::McapStream reader = std::move(stream).value();
  while (auto message = reader.next()) all.messages.push_back(std::move(*message));
  all.metadata = reader.directory().metadata();
  all.whole = reader.whole();
  all.problems = reader.problems().count();
  if (all.problems > 0) all.words = told(reader.problems().first().front());
  return all;
}

}  // namespace gyre::tests
