#pragma once
// Plain CDR, little endian: how the standard visual messages are written. Gyre's own messages are recorded as they
// crossed the wire.
//
// A number begins at a multiple of its size, counted from behind the four bytes that name the encoding; a text is its
// length with the closing NUL, and the bytes; a sequence is its count and its elements.

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "ground/recording/core/mcap_format.hpp"

namespace gyre::ground {

class CdrWriter {
 public:
  CdrWriter() : bytes_{0, 1, 0, 0} {}

  template <class Number>
  void number(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    while ((bytes_.size() - kHead) % sizeof(Number) != 0) bytes_.push_back(0);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(Number));  // this machine is little endian, too
    for (std::size_t i = 0; i < sizeof(Number); ++i) bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  void text(std::string_view words) {
    number(static_cast<std::uint32_t>(words.size() + 1));
    bytes_.insert(bytes_.end(), words.begin(), words.end());
    bytes_.push_back(0);
  }
  void count(std::size_t elements) { number(static_cast<std::uint32_t>(elements)); }

  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHead = 4;
  Bytes bytes_;
};

}  // namespace gyre::ground
