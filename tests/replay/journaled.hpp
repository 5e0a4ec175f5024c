#pragma once
// A process's journal and its words in a recording, as if a recorder had been there; and what replaying it says.

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/random_stream.hpp"
#include "common/protocol/journal.hpp"
#include "ground/recording/recording_file.hpp"
#include "ground/replay/core_replay.hpp"
#include "tests/recording/written_recording.hpp"

namespace gyre::test {

class Journaled {
 public:
  Journaled(std::string process, std::uint64_t incarnation) : process_(std::move(process)), incarnation_(incarnation) {
    std::string pattern = ::testing::TempDir() + "gyre-replay-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
    recording_.emplace(path());
  }
  ~Journaled() { std::filesystem::remove_all(folder_); }
  Journaled(const Journaled&) = delete;
  Journaled& operator=(const Journaled&) = delete;

  void keep(const protocol::JournalEntry& entry) { entries.push_back(entry); }
  template <class Message>
  void say(const Message& message) {
    recording_->add(clock_ += std::chrono::milliseconds(1), message);
  }

  /// Writes the journal behind the words, and replays it. `lost`: the piece that the recorder did not get.
  [[nodiscard]] Result<std::vector<ground::Replayed>> replay(std::optional<CarrierId> carrier, int lost = -1) {
    protocol::JournalWriter writer(std::size_t{1} << 28U);
    for (const protocol::JournalEntry& entry : entries) writer.add(entry);
    for (int i = 0; const auto piece = writer.next(true); ++i) {
      if (i != lost) say(protocol::JournalPiece{process_, incarnation_, piece->offset, piece->bytes});
    }
    recording_->finish();
    recording_.reset();
    const auto source = ground::open_recording(path());
    EXPECT_TRUE(source);
    return ground::replay_core(*source.value(), carrier);
  }

  /// A few bytes of it are others.
  void damage(RandomStream& random) {
    for (std::uint64_t i = 1 + random.next() % 8; i > 0; --i) {
      protocol::JournalEntry& entry = entries[random.next() % entries.size()];
      const std::uint64_t what = random.next() % 8;
      if (what == 0) {
        entry.kind = static_cast<std::uint8_t>(random.next() % 12);
      } else if (what == 1) {
        entry.at = LocalTime(Duration(static_cast<Duration::rep>(random.next() >> (random.next() % 64))));
      } else if (!entry.content.empty()) {
        entry.content[random.next() % entry.content.size()] = static_cast<std::uint8_t>(random.next());
      }
    }
  }

  std::vector<protocol::JournalEntry> entries;

 private:
  [[nodiscard]] std::string path() const { return (folder_ / "a.mcap").string(); }

  std::string process_;
  std::uint64_t incarnation_;
  std::filesystem::path folder_;
  std::optional<WrittenRecording> recording_;
  LocalTime clock_{std::chrono::hours(1)};
};

}  // namespace gyre::test
