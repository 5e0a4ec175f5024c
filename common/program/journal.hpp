#pragma once
// Keeps the journal of a process's core (common/protocol/journal.hpp), and sends it while somebody records.

#include <cstdint>
#include <optional>
#include <string>

#include "common/dds/node.hpp"
#include "common/protocol/journal.hpp"

namespace gyre::program {

class Journal {
 public:
  /// `process` is its name as people know it: "agent 3". `beginning`: with what its core was made. `node` outlives it.
  Journal(dds::Node& node, std::string process, const protocol::JournalEntry& beginning,
          std::size_t most_kept = protocol::JournalWriter::kMostKept);

  /// `entry()` makes it, if it is kept.
  template <class Entry>
  void add(const Entry& entry) {
    if (!writer_.given_up()) writer_.add(entry());
  }

  /// Sends what is due, if anybody listens. For the main loop, after what it has to say to the swarm.
  void send(LocalTime now);

 private:
  std::string process_;
  std::uint64_t incarnation_;
  protocol::JournalWriter writer_;
  dds::Writer<protocol::JournalPiece> pieces_;
  int readers_ = 0;
  std::optional<LocalTime> came_;    ///< the last of them
  int begun_ = 0;                    ///< for him
  std::optional<LocalTime> looked_;  ///< for readers
};

}  // namespace gyre::program
