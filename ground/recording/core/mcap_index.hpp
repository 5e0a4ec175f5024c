#pragma once
// Reads a whole MCAP file by its summary: what is in it at once, and any stretch of time and choice of topics without
// reading the rest.
//
// Messages come in the order of their log time. Chunks of one writer hardly overlap; of a file where they do, as many
// are unpacked at a time as overlap, at most kMaxOpenBytes.

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ground/recording/core/mcap_source.hpp"

namespace gyre::ground {

/// Ten hours of a hundred carriers are a quarter of it.
inline constexpr std::uint64_t kMaxSummaryBytes = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMaxOpenBytes = 4 * kMaxRecordBytes;

struct McapQuery {
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = std::numeric_limits<std::uint64_t>::max();  ///< included
  std::set<std::string> topics;                                     ///< none: all
};

class McapIndex {
 public:
  /// `source` outlives it. An error says why there is no summary to read by: a file that was cut off has none, and a
  /// stream reads it (mcap_stream.hpp).
  [[nodiscard]] static Result<McapIndex> open(const McapSource& source);

  [[nodiscard]] const McapDirectory& directory() const { return directory_; }
  [[nodiscard]] const std::optional<Statistics>& statistics() const { return statistics_; }
  /// As written, by its name; read when it is asked for. The newest where there are several.
  [[nodiscard]] std::optional<Metadata> metadata(const std::string& name) const;

  struct Chunk {
    std::uint64_t start_ns = 0, end_ns = 0, offset = 0, length = 0;
    std::vector<std::uint16_t> channels;  ///< none: the index does not say
  };
  /// By start.
  [[nodiscard]] const std::vector<Chunk>& chunks() const { return chunks_; }

  /// Answers one query, message by message.
  class Cursor {
   public:
    [[nodiscard]] std::optional<Message> next();
    [[nodiscard]] const McapProblems& problems() const { return problems_; }

   private:
    friend class McapIndex;
    struct Entry {
      std::uint64_t log_ns;
      std::size_t chunk;
      std::size_t place;
      [[nodiscard]] bool operator>(const Entry& other) const;
    };
    struct Open {
      Bytes records;
      std::size_t left = 0;
    };
    Cursor(const McapIndex& index, McapQuery query);
    [[nodiscard]] bool wanted(const Chunk& chunk) const;
    void open_chunk(std::size_t number);
    void list_messages(std::size_t number, Open& open);

    const McapIndex* index_;
    McapQuery query_;
    std::set<std::uint16_t> channels_;  // wanted
    std::size_t next_chunk_ = 0;
    std::vector<Entry> heap_;
    std::map<std::size_t, Open> open_;
    std::uint64_t open_bytes_ = 0;
    McapProblems problems_;
  };
  /// The index outlives the cursor.
  [[nodiscard]] Cursor messages(McapQuery query = {}) const { return {*this, std::move(query)}; }

 private:
  explicit McapIndex(const McapSource& source) : source_(&source) {}
  [[nodiscard]] std::optional<Error> read_summary(std::uint64_t begin, std::uint64_t end);
  [[nodiscard]] std::optional<std::string> learn(Opcode opcode, const ByteReader& content);

  struct MetadataPlace {
    std::uint64_t offset = 0, length = 0;
    std::string name;
  };
  const McapSource* source_;
  McapDirectory directory_;
  std::optional<Statistics> statistics_;
  std::vector<Chunk> chunks_;
  std::vector<MetadataPlace> metadata_;
};

}  // namespace gyre::ground
