#include "common/protocol/journal.hpp"

#include <algorithm>
#include <utility>

namespace gyre::protocol {
namespace {

constexpr std::size_t kLength = 4;
constexpr std::size_t kHead = 8 + 1 + 1;

}  // namespace

void JournalWriter::add(const JournalEntry& entry) {
  if (given_up_) return;
  if (waiting_.size() + kLength + kHead + entry.content.size() > most_waiting_) {
    given_up_ = true;
    waiting_ = {};
    return;
  }
  Bytes bytes;
  bytes.reserve(kLength + kHead + entry.content.size());
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint32_t>(kHead + entry.content.size()));
  writer.number(static_cast<std::uint64_t>(entry.at.time_since_epoch().count()));
  writer.number(entry.kind);
  writer.number(entry.said);
  writer.raw(entry.content.data(), entry.content.size());
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

std::optional<JournalWriter::Piece> JournalWriter::next(bool all) {
  if (waiting_.empty() || (!all && waiting_.size() < kMaxJournalBytes)) return std::nullopt;
  const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(waiting_.size(), kMaxJournalBytes));
  Piece piece{offset_, Bytes(waiting_.begin(), end)};
  offset_ += piece.bytes.size();
  waiting_.erase(waiting_.begin(), end);
  return piece;
}

void JournalReader::take(std::uint64_t offset, const Bytes& bytes) {
  if (gap_ || broken_ || offset + bytes.size() <= end_) return;
  if (offset > end_) {
    gap_ = true;
    return;
  }
  unread_.erase(unread_.begin(), unread_.begin() + static_cast<std::ptrdiff_t>(std::exchange(read_, 0)));
  unread_.insert(unread_.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end_ - offset), bytes.end());
  end_ = offset + bytes.size();
}

std::optional<JournalEntry> JournalReader::next() {
  ByteReader reader(unread_.data() + read_, unread_.size() - read_);
  if (broken_ || reader.left() < kLength) return std::nullopt;
  const auto length = reader.number<std::uint32_t>();
  broken_ = length < kHead || length > kMaxJournalEntry;
  if (broken_ || reader.left() < length) return std::nullopt;
  JournalEntry entry;
  entry.at = LocalTime(Duration(static_cast<Duration::rep>(reader.number<std::uint64_t>())));
  broken_ = entry.at.time_since_epoch() > kLongest || entry.at.time_since_epoch() < -kLongest;
  if (broken_) return std::nullopt;
  entry.kind = reader.number<std::uint8_t>();
  entry.said = reader.number<std::uint8_t>();
  const std::size_t size = length - kHead;
  const std::uint8_t* const content = reader.take(size);
  entry.content.assign(content, content + size);
  read_ += kLength + length;
  return entry;
}

}  // namespace gyre::protocol
