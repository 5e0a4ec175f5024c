#pragma once
// What kept a test from its time besides other programs: a kernel that is seconds about a change of its packet filter,
// because other namespaces come and go. What is timed from such a change says nothing.

#include <algorithm>
#include <chrono>

#include "common/base/time.hpp"

namespace gyre::test {

class Hindrance {
 public:
  /// A change that takes longer spoils the test that made it.
  static constexpr Duration kSpoils = std::chrono::milliseconds(500);

  static void begin() { longest() = Duration::zero(); }
  static void took(Duration duration) { longest() = std::max(longest(), duration); }
  [[nodiscard]] static bool spoilt() { return longest() >= kSpoils; }
  /// Of one test, so far.
  static Duration& longest() {
    static Duration longest{};
    return longest;
  }
};

}  // namespace gyre::test
