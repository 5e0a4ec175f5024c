#pragma once
// Everything that is wrong with one file, collected while it is read: a person who gets all of it edits once.

#include <cstddef>
#include <string>
#include <vector>

#include "common/base/result.hpp"

namespace gyre::mission {

class Complaints {
 public:
  explicit Complaints(std::string source_name) : source_name_(std::move(source_name)) {}

  /// Line and column count from zero, as Protobuf gives them; negative: nowhere in particular. `field` may be empty.
  void add(int line, int column, const std::string& field, const std::string& text);

  [[nodiscard]] bool none() const { return count_ == 0; }
  /// One complaint per line; the first kMaxListed of them, and how many more there are.
  [[nodiscard]] Error error() const;

  static constexpr std::size_t kMaxListed = 20;

 private:
  std::string source_name_;
  std::vector<std::string> listed_;
  std::size_t count_ = 0;
};

}  // namespace gyre::mission
