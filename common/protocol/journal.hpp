#pragma once
// The journal of a core: what it was made with, everything it was told and when, in order. Because a core decides by
// nothing else, whoever steps another core through its journal sees it decide again: a failure in the field becomes a
// test.
//
//   journal   entry, entry, ..            the first says with what the core was made, each other is one step
//   entry     length of what follows (4), at (8), kind (1), said (1), content     numbers little endian
//
// `kind` and `content` are the process's own (agent/journal.hpp); `said` is which of its outputs came of the step, one
// bit each. The bytes travel in pieces that each fit into a datagram.
//
// A journal is whole or it is none: it begins with its process. So its beginning is kept for a while, for recorders
// that are found later, and said again to each. Then what was said is forgotten; and where nobody was there until then,
// the journal is given up for good: a process does not grow.

#include <cstdint>
#include <deque>
#include <optional>

#include "common/base/bytes.hpp"
#include "common/base/time.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::protocol {

struct JournalEntry {
  LocalTime at{};  ///< what the core was told to be now
  std::uint8_t kind = 0;
  std::uint8_t said = 0;
  Bytes content;

  friend bool operator==(const JournalEntry& a, const JournalEntry& b) {
    return a.at == b.at && a.kind == b.kind && a.said == b.said && a.content == b.content;
  }
};

/// Bytes of one entry that are believed: many times what the largest message takes.
inline constexpr std::size_t kMaxJournalEntry = std::size_t{1} << 20;

class JournalWriter {
 public:
  /// Half a minute of an agent's.
  static constexpr std::size_t kMostKept = std::size_t{1} << 20;

  explicit JournalWriter(std::size_t most_kept = kMostKept) : most_kept_(most_kept) {}

  void add(const JournalEntry& entry);
  /// So many bytes that a piece is full, or with `all` what there is. Absent: nothing waits.
  struct Piece {
    std::uint64_t offset = 0;
    Bytes bytes;
  };
  [[nodiscard]] std::optional<Piece> next(bool all);
  /// Somebody came who has heard nothing: from the beginning, if that is still kept.
  void begin_again();
  [[nodiscard]] std::size_t waiting() const { return kept_.size() - said_; }
  /// More waited than is kept.
  [[nodiscard]] bool given_up() const { return given_up_; }

 private:
  std::size_t most_kept_;
  std::deque<std::uint8_t> kept_;
  std::size_t said_ = 0;      ///< of those
  std::uint64_t offset_ = 0;  ///< of the first of those
  bool given_up_ = false;
};

class JournalReader {
 public:
  /// Of a piece what was not there before; what lies behind a gap is passed over, and may be said again.
  void take(std::uint64_t offset, const Bytes& bytes);
  /// Absent: none is whole yet, or broken().
  [[nodiscard]] std::optional<JournalEntry> next();

  [[nodiscard]] std::uint64_t bytes() const { return end_; }   ///< that came without a gap
  [[nodiscard]] bool gap() const { return furthest_ > end_; }  ///< a piece is missing
  [[nodiscard]] bool broken() const { return broken_; }        ///< what came is no journal

 private:
  Bytes unread_;
  std::size_t read_ = 0;  ///< of those
  std::uint64_t end_ = 0;
  std::uint64_t furthest_ = 0;  ///< that anything came of
  bool broken_ = false;
};

}  // namespace gyre::protocol
