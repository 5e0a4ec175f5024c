#pragma once
// Reads an MCAP file from its front, message by message, in the order of the file: for files that were cut off, and for
// those that are read whole.
//
// Intuition: the file was written by somebody who was killed, on a disk that was full, and was perhaps not written by
// us at all. What is whole is given, what is not is passed over and said, with its place; a length is believed only as
// far as the file reaches. One record, or one chunk, is in memory at a time, at most kMaxRecordBytes of either.

#include <optional>

#include "ground/recording/core/mcap_source.hpp"

namespace gyre::ground {

class McapStream {
 public:
  /// `source` outlives it. An error says why this is no MCAP file.
  [[nodiscard]] static Result<McapStream> open(const McapSource& source);

  /// The next message, of a channel that the directory knows. Absent: there are no more, and whole() and problems() say
  /// how it ended.
  [[nodiscard]] std::optional<Message> next();

  [[nodiscard]] const McapDirectory& directory() const { return directory_; }
  /// Whether the end of the data was reached that its writer wrote.
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] const McapProblems& problems() const { return problems_; }

 private:
  explicit McapStream(const McapSource& source) : source_(&source) {}

  /// One record of the file; false where nothing can follow.
  [[nodiscard]] bool read_record();
  void take(const RecordHead& head, std::uint64_t place);
  void end_of_data(ByteReader content);
  [[nodiscard]] std::optional<Message> next_of_chunk();
  [[nodiscard]] std::optional<Message> message_of(ByteReader content, std::uint64_t place);

  const McapSource* source_;
  McapDirectory directory_;
  McapProblems problems_;
  std::uint64_t at_ = kMcapMagic.size();
  Bytes record_;  // head and content
  Bytes chunk_;   // unpacked
  std::size_t in_chunk_ = 0;
  std::uint64_t chunk_place_ = 0;
  std::optional<Message> loose_;  // one that is in no chunk
  std::uint32_t crc_ = 0;         // of what was read
  bool all_read_ = true;
  bool whole_ = false;
  bool over_ = false;
};

}  // namespace gyre::ground
