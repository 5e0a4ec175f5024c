#include "ground/recording/core/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "common/base/ensure.hpp"
#include "ground/recording/core/mcap_records.hpp"

namespace gyre::ground {
namespace {

std::uint32_t checksum(std::uint32_t before, const Bytes& bytes) {
  return static_cast<std::uint32_t>(::crc32_z(before, bytes.data(), bytes.size()));
}

void append(Bytes& to, const Bytes& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// One group of the summary, and where it is.
void add_group(Bytes& summary, Bytes& offsets, std::uint64_t begin, Opcode opcode, const Bytes& group) {
  if (group.empty()) return;
  RecordWriter offset(offsets, Opcode::kSummaryOffset);
  offset.number(static_cast<std::uint8_t>(opcode));
  offset.number(begin + summary.size());
  offset.number(static_cast<std::uint64_t>(group.size()));
  append(summary, group);
}

}  // namespace

struct McapWriter::Compressor {
  Compressor() : context(::ZSTD_createCCtx()) { GYRE_ENSURE(context, "zstd has memory for a compressor"); }
  ~Compressor() { ::ZSTD_freeCCtx(context); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  [[nodiscard]] Bytes compress(const Bytes& from) const {
    constexpr int kFastest = 1;
    Bytes to(::ZSTD_compressBound(from.size()));
    const std::size_t size = ::ZSTD_compressCCtx(context, to.data(), to.size(), from.data(), from.size(), kFastest);
    GYRE_ENSURE(!::ZSTD_isError(size), "zstd compresses into the room it asked for");
    to.resize(size);
    return to;
  }

  ::ZSTD_CCtx* context;
};

McapWriter::McapWriter(McapWriterOptions options)
    : options_(std::move(options)), compressor_(std::make_unique<Compressor>()) {}
McapWriter::~McapWriter() = default;

Bytes McapWriter::metadata_piece(const Metadata& metadata) {
  Bytes record;
  write(record, metadata);
  pending_metadata_index_.clear();
  RecordWriter index(pending_metadata_index_, Opcode::kMetadataIndex);
  index.number(size_ + piece_.size());
  index.number(static_cast<std::uint64_t>(record.size()));
  index.text(metadata.name);
  return record;
}

Bytes McapWriter::begin(const Metadata& about) {
  GYRE_ENSURE(size_ == 0, "a file begins once");
  piece_.assign(kMcapMagic.begin(), kMcapMagic.end());
  write_header(piece_, options_.profile, options_.library);
  append(piece_, metadata_piece(about));
  return piece_;
}

std::uint16_t McapWriter::schema(const std::string& name, const std::string& encoding, const std::string& text) {
  const auto known =
      std::find_if(schemas_.begin(), schemas_.end(), [&](const Schema& schema) { return schema.name == name; });
  if (known != schemas_.end()) return known->id;
  GYRE_ENSURE(schemas_.size() < std::numeric_limits<std::uint16_t>::max(), "a program has fewer types than that");
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, name, encoding, text});
  return id;
}

std::optional<std::uint16_t> McapWriter::channel(std::uint16_t schema, const std::string& topic,
                                                 const std::string& encoding,
                                                 const std::map<std::string, std::string>& metadata) {
  if (channels_.size() > std::numeric_limits<std::uint16_t>::max()) return std::nullopt;
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back({id, schema, topic, encoding, metadata});
  return id;
}

void McapWriter::add(const Message& message) {
  GYRE_ENSURE(message.channel < channels_.size(), "a message is on a channel of this writer's");
  const Channel& channel = channels_[message.channel];
  if (channel.schema != 0 && told_schemas_.count(channel.schema) == 0 && open_.schemas.insert(channel.schema).second) {
    write(open_.records, schemas_[channel.schema - 1U]);
  }
  if (told_channels_.count(channel.id) == 0 && open_.channels.insert(channel.id).second) write(open_.records, channel);
  open_.index[message.channel].emplace_back(message.log_ns, open_.records.size());
  write(open_.records, message);
  open_.start_ns = open_.messages == 0 ? message.log_ns : std::min(open_.start_ns, message.log_ns);
  open_.end_ns = std::max(open_.end_ns, message.log_ns);
  ++open_.messages;
}

bool McapWriter::due(std::uint64_t now_ns) const {
  if (open_.messages == 0) return false;
  return open_.records.size() >= options_.chunk_bytes || now_ns >= open_.start_ns + options_.chunk_ns;
}

Bytes McapWriter::close_chunk() {
  GYRE_ENSURE(piece_.empty(), "one piece at a time");
  if (open_.messages == 0) return {};
  closed_ = std::exchange(open_, {});
  const Bytes packed = compressor_->compress(closed_.records);
  ChunkIndex index;
  index.start_ns = closed_.start_ns;
  index.end_ns = closed_.end_ns;
  index.offset = size_;
  index.compression = "zstd";
  index.compressed_size = packed.size();
  index.uncompressed_size = closed_.records.size();
  {
    RecordWriter chunk(piece_, Opcode::kChunk);
    chunk.number(index.start_ns);
    chunk.number(index.end_ns);
    chunk.number(index.uncompressed_size);
    chunk.number(checksum(0, closed_.records));
    chunk.text(index.compression);
    chunk.number(index.compressed_size);
    chunk.raw(packed.data(), packed.size());
  }
  index.length = piece_.size();
  for (auto& [channel, entries] : closed_.index) {
    // Readers may take the index as sorted by time, and messages of several threads overtake each other.
    std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    index.message_indexes[channel] = size_ + piece_.size();
    RecordWriter record(piece_, Opcode::kMessageIndex);
    record.number(channel);
    record.number(static_cast<std::uint32_t>(entries.size() * 16));
    for (const auto& [log_ns, place] : entries) {
      record.number(log_ns);
      record.number(place);
    }
  }
  index.message_index_length = piece_.size() - index.length;
  pending_chunk_ = std::move(index);
  return piece_;
}

Bytes McapWriter::finish(const Metadata& last_word) {
  GYRE_ENSURE(piece_.empty() && open_.messages == 0, "the last chunk was closed");
  Statistics statistics = statistics_;
  ++statistics.metadata;
  piece_ = metadata_piece(last_word);
  const std::uint32_t data_crc = checksum(crc_, piece_);
  {
    RecordWriter end(piece_, Opcode::kDataEnd);
    end.number(data_crc);
  }
  const std::uint64_t begin = size_ + piece_.size();
  Bytes schemas;
  for (const std::uint16_t id : told_schemas_) write(schemas, schemas_[id - 1U]);
  Bytes channels;
  for (const std::uint16_t id : told_channels_) write(channels, channels_[id]);
  Bytes statistic;
  write(statistic, statistics);
  Bytes metadata_indexes = metadata_indexes_;
  append(metadata_indexes, pending_metadata_index_);
  Bytes summary;
  Bytes offsets;
  add_group(summary, offsets, begin, Opcode::kSchema, schemas);
  add_group(summary, offsets, begin, Opcode::kChannel, channels);
  add_group(summary, offsets, begin, Opcode::kStatistics, statistic);
  add_group(summary, offsets, begin, Opcode::kChunkIndex, chunk_indexes_);
  add_group(summary, offsets, begin, Opcode::kMetadataIndex, metadata_indexes);
  const std::uint64_t offsets_begin = begin + summary.size();
  append(summary, offsets);
  // The footer's own head and its first two fields are part of the checksum.
  ByteWriter footer(summary);
  footer.number(static_cast<std::uint8_t>(Opcode::kFooter));
  footer.number(kFooterBytes);
  footer.number(begin);
  footer.number(offsets_begin);
  footer.number(checksum(0, summary));
  footer.raw(kMcapMagic.data(), kMcapMagic.size());
  append(piece_, summary);
  return piece_;
}

void McapWriter::written() {
  size_ += piece_.size();
  crc_ = checksum(crc_, piece_);
  if (!pending_metadata_index_.empty()) {
    append(metadata_indexes_, std::exchange(pending_metadata_index_, {}));
    ++statistics_.metadata;
  }
  if (pending_chunk_) {
    write(chunk_indexes_, *pending_chunk_);
    const bool first = statistics_.messages == 0;
    statistics_.start_ns = first ? closed_.start_ns : std::min(statistics_.start_ns, closed_.start_ns);
    statistics_.end_ns = std::max(statistics_.end_ns, closed_.end_ns);
    statistics_.messages += closed_.messages;
    ++statistics_.chunks;
    for (const auto& [channel, entries] : closed_.index) statistics_.by_channel[channel] += entries.size();
    told_schemas_.insert(closed_.schemas.begin(), closed_.schemas.end());
    told_channels_.insert(closed_.channels.begin(), closed_.channels.end());
    statistics_.schemas = static_cast<std::uint16_t>(told_schemas_.size());
    statistics_.channels = static_cast<std::uint32_t>(told_channels_.size());
  }
  discarded();
}

void McapWriter::discarded() {
  piece_.clear();
  closed_ = {};
  pending_chunk_.reset();
  pending_metadata_index_.clear();
}

}  // namespace gyre::ground
