#include "ground/recording/core/mcap_source.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "common/base/text.hpp"

namespace gyre::ground {

std::string told(const McapProblem& problem) {
  return "byte " + std::to_string(problem.offset) + ": " + problem.words;
}

void McapProblems::add(std::uint64_t offset, std::string words) {
  constexpr std::size_t kInWords = 16;
  if (first_.size() < kInWords) first_.push_back({offset, std::move(words)});
  ++count_;
}

bool McapDirectory::room_for(std::size_t bytes) {
  if (kept_ + bytes > kMaxRecordBytes) return false;
  kept_ += bytes;
  return true;
}

std::optional<std::string> McapDirectory::learn(Opcode opcode, ByteReader content) {
  const std::string too_much = "more schemas, channels and metadata than a reader keeps";
  const std::size_t bytes = content.left();
  if (opcode == Opcode::kSchema) {
    auto schema = read_schema(content);
    if (!schema) return "a schema whose fields do not fit into it";
    if (schema->id == 0) return std::nullopt;  // to be ignored, as the format says
    const auto known = schemas_.find(schema->id);
    if (known != schemas_.end()) {
      if (known->second == *schema) return std::nullopt;
      return text("two different schemas with the number %u", static_cast<unsigned>(schema->id));
    }
    if (!room_for(bytes)) return too_much;
    schemas_.emplace(schema->id, std::move(*schema));
  } else if (opcode == Opcode::kChannel) {
    auto channel = read_channel(content);
    if (!channel) return "a channel whose fields do not fit into it";
    const auto known = channels_.find(channel->id);
    if (known != channels_.end()) {
      if (known->second == *channel) return std::nullopt;
      return text("two different channels with the number %u", static_cast<unsigned>(channel->id));
    }
    if (channel->schema != 0 && schemas_.count(channel->schema) == 0) {
      return text("a channel of the schema %u, which was not told before", static_cast<unsigned>(channel->schema));
    }
    if (!room_for(bytes)) return too_much;
    channels_.emplace(channel->id, std::move(*channel));
  } else if (opcode == Opcode::kMetadata) {
    auto metadata = read_metadata(content);
    if (!metadata) return "metadata whose fields do not fit into it";
    if (!room_for(bytes)) return too_much;
    metadata_.push_back(std::move(*metadata));
  }
  return std::nullopt;
}

std::optional<RecordHead> read_head(const McapSource& source, std::uint64_t offset) {
  std::array<std::uint8_t, kRecordHead> bytes{};
  if (!source.read(offset, bytes.size(), bytes.data())) return std::nullopt;
  ByteReader reader(bytes.data(), bytes.size());
  RecordHead head;
  head.opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
  head.length = reader.number<std::uint64_t>();
  return head;
}

Result<Bytes> unpack(const PackedChunk& chunk) {
  const auto asked = static_cast<unsigned long long>(chunk.uncompressed_size);
  if (chunk.uncompressed_size > kMaxRecordBytes) {
    return Error{text("a chunk that wants %llu bytes unpacked, and %llu are the most", asked,
                      static_cast<unsigned long long>(kMaxRecordBytes))};
  }
  Bytes records;
  if (chunk.compression == "zstd") {
    records.resize(static_cast<std::size_t>(chunk.uncompressed_size));
    const std::size_t size = ::ZSTD_decompress(records.data(), records.size(), chunk.records, chunk.size);
    if (::ZSTD_isError(size)) {
      return Error{std::string("a chunk that zstd does not unpack: ") + ::ZSTD_getErrorName(size)};
    }
    if (size != records.size()) {
      return Error{text("a chunk that unpacks to %zu bytes where it says %llu", size, asked)};
    }
  } else if (chunk.compression.empty()) {
    if (chunk.size != chunk.uncompressed_size) {
      return Error{
          text("a chunk of %llu bytes that says it has %llu", static_cast<unsigned long long>(chunk.size), asked)};
    }
    records.assign(chunk.records, chunk.records + chunk.size);
  } else {
    return Error{"a chunk compressed by \"" + chunk.compression.substr(0, 32) +
                 "\": zstd and none are known; `mcap recompress` makes one of the other"};
  }
  const auto checksum = static_cast<std::uint32_t>(::crc32_z(0, records.data(), records.size()));
  if (chunk.uncompressed_crc != 0 && checksum != chunk.uncompressed_crc) {
    return Error{"a chunk whose checksum is wrong: its bytes were changed after it was written"};
  }
  return records;
}

std::optional<Error> judge_beginning(const McapSource& source) {
  std::array<std::uint8_t, kMcapMagic.size()> beginning{};
  const std::size_t there = static_cast<std::size_t>(std::min<std::uint64_t>(source.size(), beginning.size()));
  if (there > 0 && !source.read(0, there, beginning.data())) return Error{"byte 0: the file cannot be read"};
  if (there < beginning.size() &&
      std::equal(beginning.begin(), beginning.begin() + static_cast<std::ptrdiff_t>(there), kMcapMagic.begin())) {
    return Error{text("byte %zu: the file ends before anything was recorded", there)};
  }
  constexpr std::size_t kVersion = 5;
  if (!std::equal(beginning.begin(), beginning.begin() + kVersion, kMcapMagic.begin())) {
    return Error{"byte 0: no MCAP file: those begin with the bytes 89 4D 43 41 50"};
  }
  if (beginning != kMcapMagic) return Error{"byte 5: an MCAP file of another version of the format than 0"};
  return std::nullopt;
}

}  // namespace gyre::ground
