#pragma once
// What did not arrive, by the numbers that each writer gives its samples: 1, 2, 3 .. without a gap.
//
// A gap is a loss on a topic whose samples are sent once. On a retained topic it is none: a writer that says something
// newer need not say the older again. Before a writer's first sample nobody listened, so nothing is missing there.

#include <array>
#include <cstdint>
#include <map>

namespace gyre::ground {

/// A writer's RTPS GUID.
using WriterId = std::array<std::uint8_t, 16>;

class LossLedger {
 public:
  /// How many samples before this one are missing; zero for one that comes late or twice.
  std::uint64_t see(const WriterId& writer, std::uint64_t sequence);

 private:
  std::map<WriterId, std::uint64_t> newest_;
};

}  // namespace gyre::ground
