#pragma once
// Terms fence coordinators: whoever comes later has the higher one, and nobody listens to a lower.
//
// The generation counts up in the upper bits. The lower ones are random, so that two coordinators that started from the
// same knowledge still have different terms, and one of them stands down.

#include <cstdint>

namespace gyre::protocol {

inline constexpr int kTermNonceBits = 16;

/// The term after `highest` (0: nobody has ever had one).
[[nodiscard]] constexpr std::uint64_t next_term(std::uint64_t highest, std::uint64_t nonce) {
  return (((highest >> kTermNonceBits) + 1) << kTermNonceBits) | (nonce & ((1U << kTermNonceBits) - 1));
}

/// What a person is told of a term: 1, 2, 3, ...
[[nodiscard]] constexpr unsigned long long generation(std::uint64_t term) {
  return term >> kTermNonceBits;
}

}  // namespace gyre::protocol
