#pragma once
// A value, or the reason there is none. For failures a caller can act on; bugs use GYRE_ENSURE.

#include <string>
#include <utility>
#include <variant>

#include "common/base/ensure.hpp"

namespace gyre {

/// Why something could not be done, in words for the person who can cure it: what, where, and what would be right.
struct Error {
  std::string text;
};

template <class T, class E = Error>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: a value is a result
  Result(E error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: so is an error

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  [[nodiscard]] const T& value() const& {
    GYRE_ENSURE(ok(), "value() of a failed result");
    return *std::get_if<0>(&state_);
  }
  [[nodiscard]] T&& value() && {
    GYRE_ENSURE(ok(), "value() of a failed result");
    return std::move(*std::get_if<0>(&state_));
  }
  [[nodiscard]] const E& error() const {
    GYRE_ENSURE(!ok(), "error() of a good result");
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, E> state_;
};

}  // namespace gyre
