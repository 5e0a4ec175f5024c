#include "ground/recording/core/loss_ledger.hpp"

#include <cstddef>

namespace gyre::ground {

std::uint64_t LossLedger::see(const WriterId& writer, std::uint64_t sequence) {
  // A process that starts again and again has new writers every time: the ledger does not grow for ever.
  constexpr std::size_t kMostWriters = 4096;
  const auto known = newest_.find(writer);
  if (known == newest_.end()) {
    if (newest_.size() < kMostWriters) newest_.emplace(writer, sequence);
    return 0;
  }
  if (sequence <= known->second) return 0;
  const std::uint64_t missing = sequence - known->second - 1;
  known->second = sequence;
  return missing;
}

}  // namespace gyre::ground
