#pragma once
// Randomness that is the same on every machine: xoshiro256++ (Blackman, Vigna), one stream per seed and name.
//
// A name per use ("wind") keeps streams apart: a second source of randomness does not change what the first one draws.
// The standard library's distributions are left alone because each implementation has its own.

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "common/base/angle.hpp"

namespace gyre {

class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name) {
    std::uint64_t mixed = 0xcbf29ce484222325U;  // FNV-1a over the name
    for (const char letter : name) mixed = (mixed ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
    mixed ^= seed;
    for (std::uint64_t& word : state_) word = split_mix(mixed);
  }

  [[nodiscard]] std::uint64_t next() {
    const std::uint64_t result = rotate(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17U;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotate(state_[3], 45);
    return result;
  }

  /// In (0, 1): never 0, so that a logarithm of it exists.
  [[nodiscard]] double uniform() { return (static_cast<double>(next() >> 11U) + 0.5) * 0x1p-53; }

  /// Mean 0, deviation 1 (Box and Muller; one of the pair is thrown away for a stream without memory).
  [[nodiscard]] double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(kTwoPi * uniform());
  }

 private:
  static std::uint64_t rotate(std::uint64_t word, unsigned by) { return (word << by) | (word >> (64U - by)); }
  static std::uint64_t split_mix(std::uint64_t& state) {
    std::uint64_t word = (state += 0x9e3779b97f4a7c15U);
    word = (word ^ (word >> 30U)) * 0xbf58476d1ce4e5b9U;
    word = (word ^ (word >> 27U)) * 0x94d049bb133111ebU;
    return word ^ (word >> 31U);
  }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace gyre
