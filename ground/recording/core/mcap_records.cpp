#include "ground/recording/core/mcap_records.hpp"

#include <utility>

namespace gyre::ground {
namespace {

template <class Record>
std::optional<Record> if_good(const ByteReader& content, Record record) {
  if (!content.good()) return std::nullopt;
  return record;
}

}  // namespace

void write_header(Bytes& out, const std::string& profile, const std::string& library) {
  RecordWriter record(out, Opcode::kHeader);
  record.text(profile);
  record.text(library);
}

void write(Bytes& out, const Schema& schema) {
  RecordWriter record(out, Opcode::kSchema);
  record.number(schema.id);
  record.text(schema.name);
  record.text(schema.encoding);
  record.text(schema.text);
}

void write(Bytes& out, const Channel& channel) {
  RecordWriter record(out, Opcode::kChannel);
  record.number(channel.id);
  record.number(channel.schema);
  record.text(channel.topic);
  record.text(channel.encoding);
  record.map(channel.metadata);
}

void write(Bytes& out, const Message& message) {
  RecordWriter record(out, Opcode::kMessage);
  record.number(message.channel);
  record.number(message.sequence);
  record.number(message.log_ns);
  record.number(message.publish_ns);
  record.raw(message.payload.data(), message.payload.size());
}

void write(Bytes& out, const Metadata& metadata) {
  RecordWriter record(out, Opcode::kMetadata);
  record.text(metadata.name);
  record.map(metadata.entries);
}

void write(Bytes& out, const ChunkIndex& index) {
  RecordWriter record(out, Opcode::kChunkIndex);
  record.number(index.start_ns);
  record.number(index.end_ns);
  record.number(index.offset);
  record.number(index.length);
  record.map(index.message_indexes);
  record.number(index.message_index_length);
  record.text(index.compression);
  record.number(index.compressed_size);
  record.number(index.uncompressed_size);
}

void write(Bytes& out, const Statistics& statistics) {
  RecordWriter record(out, Opcode::kStatistics);
  record.number(statistics.messages);
  record.number(statistics.schemas);
  record.number(statistics.channels);
  record.number(statistics.attachments);
  record.number(statistics.metadata);
  record.number(statistics.chunks);
  record.number(statistics.start_ns);
  record.number(statistics.end_ns);
  record.map(statistics.by_channel);
}

std::optional<Schema> read_schema(ByteReader content) {
  Schema schema;
  content.get(schema.id);
  content.get(schema.name);
  content.get(schema.encoding);
  content.get(schema.text);
  return if_good(content, std::move(schema));
}

std::optional<Channel> read_channel(ByteReader content) {
  Channel channel;
  content.get(channel.id);
  content.get(channel.schema);
  content.get(channel.topic);
  content.get(channel.encoding);
  content.map(channel.metadata);
  return if_good(content, std::move(channel));
}

std::optional<Message> read_message(ByteReader content) {
  Message message;
  content.get(message.channel);
  content.get(message.sequence);
  content.get(message.log_ns);
  content.get(message.publish_ns);
  const std::size_t size = content.left();
  if (const std::uint8_t* const payload = content.take(size)) message.payload.assign(payload, payload + size);
  return if_good(content, std::move(message));
}

std::optional<Metadata> read_metadata(ByteReader content) {
  Metadata metadata;
  content.get(metadata.name);
  content.map(metadata.entries);
  return if_good(content, std::move(metadata));
}

std::optional<ChunkIndex> read_chunk_index(ByteReader content) {
  ChunkIndex index;
  content.get(index.start_ns);
  content.get(index.end_ns);
  content.get(index.offset);
  content.get(index.length);
  content.map(index.message_indexes);
  content.get(index.message_index_length);
  content.get(index.compression);
  content.get(index.compressed_size);
  content.get(index.uncompressed_size);
  return if_good(content, std::move(index));
}

std::optional<Statistics> read_statistics(ByteReader content) {
  Statistics statistics;
  content.get(statistics.messages);
  content.get(statistics.schemas);
  content.get(statistics.channels);
  content.get(statistics.attachments);
  content.get(statistics.metadata);
  content.get(statistics.chunks);
  content.get(statistics.start_ns);
  content.get(statistics.end_ns);
  content.map(statistics.by_channel);
  return if_good(content, std::move(statistics));
}

std::optional<PackedChunk> read_chunk(ByteReader content) {
  PackedChunk chunk;
  content.get(chunk.start_ns);
  content.get(chunk.end_ns);
  content.get(chunk.uncompressed_size);
  content.get(chunk.uncompressed_crc);
  content.get(chunk.compression);
  content.get(chunk.size);
  chunk.records = content.take(chunk.size);
  return if_good(content, chunk);
}

}  // namespace gyre::ground
