#pragma once
// Records as bytes and back, one by one. Reading gives nothing where the content is no such record; fields that a later
// version of the format adds at a record's end are passed over, as it asks for.

#include <optional>
#include <string>

#include "ground/recording/core/mcap_bytes.hpp"
#include "ground/recording/core/mcap_format.hpp"

namespace gyre::ground {

void write_header(Bytes& out, const std::string& profile, const std::string& library);
void write(Bytes& out, const Schema& schema);
void write(Bytes& out, const Channel& channel);
void write(Bytes& out, const Message& message);
void write(Bytes& out, const Metadata& metadata);
void write(Bytes& out, const ChunkIndex& index);
void write(Bytes& out, const Statistics& statistics);

/// Of a record's content, without its head.
[[nodiscard]] std::optional<Schema> read_schema(ByteReader content);
[[nodiscard]] std::optional<Channel> read_channel(ByteReader content);
[[nodiscard]] std::optional<Message> read_message(ByteReader content);
[[nodiscard]] std::optional<Metadata> read_metadata(ByteReader content);
[[nodiscard]] std::optional<ChunkIndex> read_chunk_index(ByteReader content);
[[nodiscard]] std::optional<Statistics> read_statistics(ByteReader content);

/// A chunk before its records are unpacked; `records` points into what was read.
struct PackedChunk {
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: none
  std::string compression;             ///< "zstd", "" or another one's
  const std::uint8_t* records = nullptr;
  std::uint64_t size = 0;
};
[[nodiscard]] std::optional<PackedChunk> read_chunk(ByteReader content);

}  // namespace gyre::ground
