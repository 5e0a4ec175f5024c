#include "ground/recording/core/mcap_index.hpp"

#include <zlib.h>

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "common/base/text.hpp"

namespace gyre::ground {
namespace {

Error at(std::uint64_t offset, const std::string& words) {
  return Error{told({offset, words})};
}

/// Of a stretch of the file and what follows it. Absent: it cannot be read.
std::optional<std::uint32_t> checksum(const McapSource& source, std::uint64_t begin, std::uint64_t end,
                                      const std::uint8_t* more, std::size_t count) {
  std::uint32_t sum = 0;
  Bytes block(std::size_t{1} << 16);
  for (std::uint64_t place = begin; place < end; place += block.size()) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), end - place));
    if (!source.read(place, size, block.data())) return std::nullopt;
    sum = static_cast<std::uint32_t>(::crc32_z(sum, block.data(), size));
  }
  return static_cast<std::uint32_t>(::crc32_z(sum, more, count));
}

}  // namespace

Result<McapIndex> McapIndex::open(const McapSource& source) {
  if (auto wrong = judge_beginning(source)) return *wrong;
  constexpr std::uint64_t kTail = kRecordHead + kFooterBytes + kMcapMagic.size();
  const std::uint64_t size = source.size();
  if (size < kMcapMagic.size() + kTail) return at(size, "the file was cut off: it ends without a summary");
  std::array<std::uint8_t, kTail> tail{};
  const std::uint64_t footer = size - kTail;
  if (!source.read(footer, tail.size(), tail.data())) return at(footer, "the file cannot be read here");
  ByteReader reader(tail.data(), tail.size());
  const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
  const auto length = reader.number<std::uint64_t>();
  const auto summary = reader.number<std::uint64_t>();
  const auto offsets = reader.number<std::uint64_t>();
  const auto crc = reader.number<std::uint32_t>();
  const bool ends = std::equal(kMcapMagic.begin(), kMcapMagic.end(), tail.end() - kMcapMagic.size());
  if (!ends || opcode != Opcode::kFooter || length != kFooterBytes) {
    return at(size, "the file was cut off: it ends without a summary");
  }
  if (summary == 0) return at(footer, "the file has no summary");
  const std::uint64_t end = offsets == 0 ? footer : offsets;
  if (summary < kMcapMagic.size() || summary > end || end > footer) {
    return at(footer, "the footer names a summary that is not in the file");
  }
  if (footer - summary > kMaxSummaryBytes) {
    return at(summary, text("the summary has %llu bytes, and %llu are the most",
                            static_cast<unsigned long long>(footer - summary),
                            static_cast<unsigned long long>(kMaxSummaryBytes)));
  }
  if (crc != 0) {
    // Over the offsets and the footer's beginning as well.
    const auto sum = checksum(source, summary, footer, tail.data(), kRecordHead + 16);
    if (!sum) return at(summary, "the file cannot be read here");
    if (*sum != crc) {
      return at(summary, "the checksum of the summary is wrong: bytes were changed after they were written");
    }
  }
  McapIndex index(source);
  if (auto wrong = index.read_summary(summary, end)) return *wrong;
  // What the summary does not lead to would be missing without a word.
  const bool none = index.statistics_ && index.statistics_->messages == 0;
  const bool all = index.statistics_ ? index.chunks_.size() == index.statistics_->chunks : true;
  if (!none && (index.chunks_.empty() || !all || index.directory_.channels().empty())) {
    return at(summary, "the summary does not lead to all messages; read from the front they are there");
  }
  return index;
}

std::optional<Error> McapIndex::read_summary(std::uint64_t begin, std::uint64_t end) {
  Bytes record;
  for (std::uint64_t place = begin; place < end;) {
    const auto head = end - place < kRecordHead ? std::nullopt : read_head(*source_, place);
    if (!head || head->length > end - place - kRecordHead || head->length > kMaxRecordBytes) {
      return at(place, "a record of the summary does not fit into it");
    }
    record.resize(static_cast<std::size_t>(head->length));
    if (!source_->read(place + kRecordHead, record.size(), record.data()))
      return at(place, "the file cannot be read here");
    if (auto wrong = learn(head->opcode, ByteReader(record))) return at(place, *wrong);
    place += kRecordHead + head->length;
  }
  const auto earlier = [](const Chunk& a, const Chunk& b) {
    return std::tie(a.start_ns, a.offset) < std::tie(b.start_ns, b.offset);
  };
  std::sort(chunks_.begin(), chunks_.end(), earlier);
  return std::nullopt;
}

std::optional<std::string> McapIndex::learn(Opcode opcode, const ByteReader& content) {
  switch (opcode) {
    case Opcode::kSchema:
    case Opcode::kChannel:
      return directory_.learn(opcode, content);
    case Opcode::kStatistics:
      statistics_ = read_statistics(content);
      return statistics_ ? std::nullopt : std::optional<std::string>("statistics whose fields do not fit into them");
    case Opcode::kChunkIndex: {
      const auto index = read_chunk_index(content);
      if (!index) return "a chunk index whose fields do not fit into it";
      Chunk chunk{index->start_ns, index->end_ns, index->offset, index->length, {}};
      for (const auto& [channel, place] : index->message_indexes) chunk.channels.push_back(channel);
      chunks_.push_back(std::move(chunk));
      return std::nullopt;
    }
    case Opcode::kMetadataIndex: {
      ByteReader reader = content;
      MetadataPlace place;
      reader.get(place.offset);
      reader.get(place.length);
      reader.get(place.name);
      if (!reader.good()) return "a metadata index whose fields do not fit into it";
      metadata_.push_back(std::move(place));
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::optional<Metadata> McapIndex::metadata(const std::string& name) const {
  const auto found =
      std::find_if(metadata_.rbegin(), metadata_.rend(), [&](const MetadataPlace& p) { return p.name == name; });
  if (found == metadata_.rend() || found->length < kRecordHead || found->length > kMaxRecordBytes) return std::nullopt;
  if (found->offset > source_->size() || found->length > source_->size() - found->offset) return std::nullopt;
  Bytes record(static_cast<std::size_t>(found->length));
  if (!source_->read(found->offset, record.size(), record.data())) return std::nullopt;
  ByteReader reader(record);
  const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
  const auto length = reader.number<std::uint64_t>();
  if (opcode != Opcode::kMetadata || length != reader.left()) return std::nullopt;
  return read_metadata(reader);
}

// ------------------------------------------------------------------------------------------------------ one query

bool McapIndex::Cursor::Entry::operator>(const Entry& other) const {
  return std::tie(log_ns, chunk, place) > std::tie(other.log_ns, other.chunk, other.place);
}

McapIndex::Cursor::Cursor(const McapIndex& index, McapQuery query) : index_(&index), query_(std::move(query)) {
  for (const auto& [id, channel] : index.directory_.channels()) {
    if (query_.topics.empty() || query_.topics.count(channel.topic) > 0) channels_.insert(id);
  }
}

bool McapIndex::Cursor::wanted(const Chunk& chunk) const {
  if (chunk.start_ns > query_.to_ns || chunk.end_ns < query_.from_ns) return false;
  return chunk.channels.empty() || std::any_of(chunk.channels.begin(), chunk.channels.end(),
                                               [&](std::uint16_t channel) { return channels_.count(channel) > 0; });
}

std::optional<Message> McapIndex::Cursor::next() {
  const std::vector<Chunk>& chunks = index_->chunks_;
  for (;;) {
    while (next_chunk_ < chunks.size() && (heap_.empty() || chunks[next_chunk_].start_ns <= heap_.front().log_ns)) {
      if (wanted(chunks[next_chunk_])) open_chunk(next_chunk_);
      ++next_chunk_;
    }
    if (heap_.empty()) return std::nullopt;
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Entry entry = heap_.back();
    heap_.pop_back();
    Open& open = open_.at(entry.chunk);
    ByteReader reader(open.records.data() + entry.place, open.records.size() - entry.place);
    const auto length = reader.number<std::uint64_t>();
    const std::uint8_t* const from = reader.take(length);
    auto message = read_message(ByteReader(from, static_cast<std::size_t>(length)));
    if (--open.left == 0) {
      open_bytes_ -= open.records.size();
      open_.erase(entry.chunk);
    }
    if (message) return message;
  }
}

void McapIndex::Cursor::open_chunk(std::size_t number) {
  const Chunk& chunk = index_->chunks_[number];
  const McapSource& source = *index_->source_;
  const bool fits = chunk.length >= kRecordHead && chunk.length <= kMaxRecordBytes && chunk.offset <= source.size() &&
                    chunk.length <= source.size() - chunk.offset;
  if (!fits) return problems_.add(chunk.offset, "the summary names a chunk that does not fit into the file");
  Bytes record(static_cast<std::size_t>(chunk.length));
  if (!source.read(chunk.offset, record.size(), record.data())) {
    return problems_.add(chunk.offset, "the file cannot be read here");
  }
  ByteReader reader(record);
  const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
  const auto length = reader.number<std::uint64_t>();
  if (opcode != Opcode::kChunk || length != reader.left()) {
    return problems_.add(chunk.offset, "the summary names a chunk where there is none");
  }
  const auto packed = read_chunk(ByteReader(record.data() + kRecordHead, record.size() - kRecordHead));
  if (!packed) return problems_.add(chunk.offset, "a chunk whose fields do not fit into it");
  if (packed->uncompressed_size > kMaxOpenBytes - open_bytes_) {
    return problems_.add(chunk.offset, "more chunks overlap in time than are held at once: this one is passed over");
  }
  auto records = unpack(*packed);
  if (!records) return problems_.add(chunk.offset, records.error().text);
  Open open{std::move(records).value(), 0};
  list_messages(number, open);
  if (open.left == 0) return;
  open_bytes_ += open.records.size();
  open_.emplace(number, std::move(open));
}

void McapIndex::Cursor::list_messages(std::size_t number, Open& open) {
  ByteReader reader(open.records);
  while (reader.left() > 0) {
    const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
    const std::size_t place = reader.at();
    const auto length = reader.number<std::uint64_t>();
    const std::uint8_t* const from = reader.take(length);
    if (!from) {
      return problems_.add(index_->chunks_[number].offset, "a chunk whose records do not fit into it");
    }
    if (opcode != Opcode::kMessage) continue;
    ByteReader content(from, static_cast<std::size_t>(length));
    const auto channel = content.number<std::uint16_t>();
    (void)content.number<std::uint32_t>();
    const auto log_ns = content.number<std::uint64_t>();
    (void)content.number<std::uint64_t>();
    if (!content.good()) {
      problems_.add(index_->chunks_[number].offset, "a message whose fields do not fit into it");
      continue;
    }
    if (channels_.count(channel) == 0 || log_ns < query_.from_ns || log_ns > query_.to_ns) continue;
    heap_.push_back({log_ns, number, place});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    ++open.left;
  }
}

}  // namespace gyre::ground
