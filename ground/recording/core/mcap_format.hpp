#pragma once
// The records of an MCAP file, as far as Gyre writes and reads them.
//
//   file     magic, record.., magic                       numbers little endian
//   record   opcode (1), length of what follows (8), content
//   text     length (4), UTF-8                            map   length in bytes (4), key, value, ..
//
//   data:    header, metadata, then chunks, each a sequence of schemas, channels and messages, compressed, with a
//            checksum, and behind it one index per channel: time and place of each message; data end
//   summary: schemas, channels, chunk indexes, metadata indexes, statistics, and where each of these groups begins;
//            footer, which says where the summary is
//
// So a file that was cut off anywhere reads from its front up to its last whole chunk, and a whole one from its end
// without reading what is not asked for.
//
// Reference: docs/interop.md, MCAP.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/base/bytes.hpp"

namespace gyre::ground {

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

inline constexpr std::array<std::uint8_t, 8> kMcapMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::uint64_t kRecordHead = 9;  ///< opcode and length
inline constexpr std::uint64_t kFooterBytes = 20;

/// What a reader sets aside for one record, or for one chunk once it is unpacked, at most. Writers in use make chunks
/// of about a megabyte; a file that asks for more than this is refused, whatever it says of itself.
inline constexpr std::uint64_t kMaxRecordBytes = std::uint64_t{1} << 26;

struct Schema {
  std::uint16_t id = 0;  ///< never 0
  std::string name;      ///< "gyre_msgs/msg/Beacon"
  std::string encoding;  ///< "ros2msg"
  std::string text;

  friend bool operator==(const Schema& a, const Schema& b) {
    return a.id == b.id && a.name == b.name && a.encoding == b.encoding && a.text == b.text;
  }
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  ///< 0: none
  std::string topic;         ///< "/gyre/phase"
  std::string encoding;      ///< "cdr"
  std::map<std::string, std::string> metadata;

  friend bool operator==(const Channel& a, const Channel& b) {
    return a.id == b.id && a.schema == b.schema && a.topic == b.topic && a.encoding == b.encoding &&
           a.metadata == b.metadata;
  }
};

/// Times are nanoseconds since 1970.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;      ///< when it was recorded
  std::uint64_t publish_ns = 0;  ///< when it was sent
  Bytes payload;
};

struct Metadata {
  std::string name;
  std::map<std::string, std::string> entries;
};

struct ChunkIndex {
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t offset = 0;  ///< of the chunk's record in the file
  std::uint64_t length = 0;  ///< of this record, head included
  std::map<std::uint16_t, std::uint64_t> message_indexes;
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::map<std::uint16_t, std::uint64_t> by_channel;
};

}  // namespace gyre::ground
