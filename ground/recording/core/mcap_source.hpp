#pragma once
// What the readers have in common: where the bytes come from, what a file has told so far, what was wrong with it.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "ground/recording/core/mcap_records.hpp"

namespace gyre::ground {

/// A file's bytes by place. The shell has the file; a test has a vector.
class McapSource {
 public:
  McapSource() = default;
  McapSource(const McapSource&) = delete;
  McapSource& operator=(const McapSource&) = delete;
  virtual ~McapSource() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// All of them or false. Within size().
  [[nodiscard]] virtual bool read(std::uint64_t offset, std::size_t count, std::uint8_t* to) const = 0;
};

/// What is wrong with a file, and where: for a person who has only this file.
struct McapProblem {
  std::uint64_t offset = 0;
  std::string words;
};
/// "byte 1234: words".
[[nodiscard]] std::string told(const McapProblem& problem);

/// The first few in words, the rest counted: a file can be wrong in every byte.
class McapProblems {
 public:
  void add(std::uint64_t offset, std::string words);
  [[nodiscard]] const std::vector<McapProblem>& first() const { return first_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::vector<McapProblem> first_;
  std::uint64_t count_ = 0;
};

/// Schemas, channels and metadata, as many as there is a sensible use for: a file cannot make a reader keep more than
/// kMaxRecordBytes of them.
class McapDirectory {
 public:
  /// Absent: kept, or known already. Otherwise what is wrong with it.
  [[nodiscard]] std::optional<std::string> learn(Opcode opcode, ByteReader content);

  [[nodiscard]] const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<Metadata>& metadata() const { return metadata_; }

 private:
  [[nodiscard]] bool room_for(std::size_t bytes);

  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Metadata> metadata_;
  std::uint64_t kept_ = 0;
};

struct RecordHead {
  Opcode opcode{};
  std::uint64_t length = 0;  ///< of the content
};
/// At `offset`, which leaves room for it. Absent: the source does not give it.
[[nodiscard]] std::optional<RecordHead> read_head(const McapSource& source, std::uint64_t offset);

/// The records of a chunk, unpacked, within kMaxRecordBytes, with its checksum right.
[[nodiscard]] Result<Bytes> unpack(const PackedChunk& chunk);

/// Absent: a file that begins as MCAP files do.
[[nodiscard]] std::optional<Error> judge_beginning(const McapSource& source);

}  // namespace gyre::ground
