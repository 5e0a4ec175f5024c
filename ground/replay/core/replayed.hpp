#pragma once
// What came of stepping a process's core through its journal again, one life of the process, and how it is told.

#include <cstdint>
#include <map>
#include <string>

#include "ground/replay/core/comparison.hpp"

namespace gyre::ground {

struct Replayed {
  std::string process;
  std::string version;                         ///< of the program that kept the journal
  std::map<std::string, std::uint64_t> heard;  ///< what it was told, by kind
  Comparison comparison;
  std::string cut;  ///< why the journal ends before the recording does; empty: it does not

  [[nodiscard]] bool same() const { return comparison.different() == 0; }
};

/// For people: what it was told, what it says in its log, what it says again, and where it decides otherwise.
[[nodiscard]] std::string replay_text(const Replayed& replayed, const std::string& this_version);

}  // namespace gyre::ground
