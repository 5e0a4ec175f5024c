#pragma once
// Writes an MCAP file as a sequence of pieces that the shell appends, one after the other.
//
// Intuition: a recording is cut off by accident more often than it is ended in order, and a disk is full sooner or
// later. So a piece is whole: a chunk with its indexes, after which the file reads up to there. And a piece counts only
// when the shell has written it: one that failed is discarded, and the writer goes on as if its messages had never
// come, with the same place in the file for the next.
//
//   begin() -> piece            once, first
//   add(..)                     a message; its schema and channel go in front of it in the same chunk, once per file
//   close_chunk() -> piece      when it is due: by size, or by age, which bounds what an accident takes
//   finish() -> piece           once, last: the summary
//   written() | discarded()     after each piece, before anything else
//
// Checksums are over what was written: of each chunk, of the data, of the summary (zlib's CRC-32; the data's costs a
// gigabyte per second and is part of what it costs to write). Compression is zstd at its fastest level.
//
// Reference: docs/interop.md, MCAP.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ground/recording/core/mcap_format.hpp"

namespace gyre::ground {

struct McapWriterOptions {
  std::string profile = "ros2";
  std::string library;
  std::uint64_t chunk_bytes = std::uint64_t{1} << 20;
  std::uint64_t chunk_ns = 1'000'000'000;  ///< from its first message on
};

class McapWriter {
 public:
  explicit McapWriter(McapWriterOptions options);
  ~McapWriter();

  [[nodiscard]] Bytes begin(const Metadata& about);

  /// Known schemas are found by name. The text of a known one is not compared.
  std::uint16_t schema(const std::string& name, const std::string& encoding, const std::string& text);
  /// A new channel. The format has room for 65535 of them; absent where they are used up.
  std::optional<std::uint16_t> channel(std::uint16_t schema, const std::string& topic, const std::string& encoding,
                                       const std::map<std::string, std::string>& metadata);
  /// On a channel of this writer's.
  void add(const Message& message);

  /// Whether the open chunk has reached its size, or its age at this time.
  [[nodiscard]] bool due(std::uint64_t now_ns) const;
  [[nodiscard]] std::uint64_t open_messages() const { return open_.messages; }
  /// Empty when there is no message in it.
  [[nodiscard]] Bytes close_chunk();
  /// The data's end and the summary, with a last word in front. An open chunk has to be closed before.
  [[nodiscard]] Bytes finish(const Metadata& last_word);

  void written();
  /// The last piece never came to be: its messages are gone.
  void discarded();

  /// Of what was written.
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  struct OpenChunk {
    Bytes records;
    std::uint64_t messages = 0;
    std::uint64_t start_ns = 0;
    std::uint64_t end_ns = 0;
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index;  ///< time and place
    std::set<std::uint16_t> schemas, channels;                                            ///< told in it
  };
  struct Compressor;

  [[nodiscard]] Bytes metadata_piece(const Metadata& metadata);

  const McapWriterOptions options_;
  std::unique_ptr<Compressor> compressor_;
  std::vector<Schema> schemas_;                           // by id, from 1 on
  std::vector<Channel> channels_;                         // by id, from 0 on
  std::set<std::uint16_t> told_schemas_, told_channels_;  // in what was written
  OpenChunk open_;

  // The piece that is on its way.
  Bytes piece_;
  OpenChunk closed_;
  std::optional<ChunkIndex> pending_chunk_;
  Bytes pending_metadata_index_;

  // What was written.
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
  Bytes chunk_indexes_;
  Bytes metadata_indexes_;
  Statistics statistics_;
};

}  // namespace gyre::ground
