#pragma once
// Numbers, texts and maps as little-endian bytes: written behind each other, and read back within bounds.

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace gyre {

using Bytes = std::vector<std::uint8_t>;

/// Appends to bytes that outlive it.
class ByteWriter {
 public:
  explicit ByteWriter(Bytes& out) : out_(out) {}

  template <class Number>
  void number(Number value) {
    static_assert(std::is_unsigned_v<Number>);
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      out_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
    }
  }
  void raw(const std::uint8_t* data, std::size_t size) { out_.insert(out_.end(), data, data + size); }
  void text(std::string_view words) {
    number(static_cast<std::uint32_t>(words.size()));
    out_.insert(out_.end(), words.begin(), words.end());
  }
  void put(const std::string& words) { text(words); }
  template <class Number, class = std::enable_if_t<std::is_unsigned_v<Number>>>
  void put(Number value) {
    number(value);
  }
  template <class Key, class Value>
  void map(const std::map<Key, Value>& entries) {
    const std::size_t at = out_.size();
    number(std::uint32_t{0});
    for (const auto& [key, value] : entries) {
      put(key);
      put(value);
    }
    overwrite(at, static_cast<std::uint32_t>(out_.size() - at - 4));
  }
  template <class Number>
  void overwrite(std::size_t at, Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      out_[at + i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
    }
  }

 private:
  Bytes& out_;
};

/// Reads within bounds. Whoever reads over the end gets zeros and empty texts from then on, and good() is false: a
/// record is read whole and judged once.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  explicit ByteReader(const Bytes& bytes) : ByteReader(bytes.data(), bytes.size()) {}

  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] std::size_t left() const { return size_ - at_; }
  [[nodiscard]] std::size_t at() const { return at_; }

  template <class Number>
  [[nodiscard]] Number number() {
    static_assert(std::is_unsigned_v<Number>);
    const std::uint8_t* const from = take(sizeof(Number));
    std::uint64_t value = 0;
    for (std::size_t i = 0; from && i < sizeof(Number); ++i) value |= std::uint64_t{from[i]} << (8 * i);
    return static_cast<Number>(value);
  }
  [[nodiscard]] std::string text() {
    const auto size = number<std::uint32_t>();
    const std::uint8_t* const from = take(size);
    return from ? std::string(from, from + size) : std::string();
  }
  /// So many bytes in place; nullptr where there are fewer.
  [[nodiscard]] const std::uint8_t* take(std::uint64_t size) {
    if (!good_ || size > left()) {
      good_ = false;
      return nullptr;
    }
    const std::uint8_t* const from = data_ + at_;
    at_ += static_cast<std::size_t>(size);
    return from;
  }
  void get(std::string& words) { words = text(); }
  template <class Number, class = std::enable_if_t<std::is_unsigned_v<Number>>>
  void get(Number& value) {
    value = number<Number>();
  }
  template <class Key, class Value>
  void map(std::map<Key, Value>& entries) {
    const auto size = number<std::uint32_t>();
    const std::uint8_t* const from = take(size);
    if (!from) return;
    ByteReader inner(from, size);
    while (inner.good() && inner.left() > 0) {
      Key key{};
      Value value{};
      inner.get(key);
      inner.get(value);
      if (inner.good()) entries[std::move(key)] = std::move(value);
    }
    good_ = good_ && inner.good();
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool good_ = true;
};

}  // namespace gyre
