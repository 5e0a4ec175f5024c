#include "common/protocol/journal.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace gyre::protocol {
namespace {

constexpr std::size_t kLength = 4;
constexpr std::size_t kHead = 8 + 1 + 1;

}  // namespace

void JournalWriter::add(const JournalEntry& entry) {
  if (given_up_) return;
  const std::size_t more = kLength + kHead + entry.content.size();
  if (kept_.size() + more > most_kept_) {
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(said_));
    offset_ += std::exchange(said_, 0);
  }
  if (kept_.size() + more > most_kept_) {
    given_up_ = true;
    kept_ = {};
    return;
  }
  Bytes bytes;
  bytes.reserve(more);
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint32_t>(kHead + entry.content.size()));
  writer.number(static_cast<std::uint64_t>(entry.at.time_since_epoch().count()));
  writer.number(entry.kind);
  writer.number(entry.said);
  writer.raw(entry.content.data(), entry.content.size());
  kept_.insert(kept_.end(), bytes.begin(), bytes.end());
}

std::optional<JournalWriter::Piece> JournalWriter::next(bool all) {
  if (waiting() == 0 || (!all && waiting() < kMaxJournalBytes)) return std::nullopt;
  const auto begin = kept_.begin() + static_cast<std::ptrdiff_t>(said_);
  const auto end = begin + static_cast<std::ptrdiff_t>(std::min(waiting(), kMaxJournalBytes));
  Piece piece{offset_ + said_, Bytes(begin, end)};
  said_ += piece.bytes.size();
  return piece;
}

void JournalWriter::begin_again() {
  if (offset_ == 0) said_ = 0;
}

void JournalReader::take(std::uint64_t offset, const Bytes& bytes) {
  if (broken_ || offset > std::numeric_limits<std::uint64_t>::max() - bytes.size()) return;
  furthest_ = std::max(furthest_, offset + bytes.size());
  if (offset > end_ || offset + bytes.size() <= end_) return;
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
