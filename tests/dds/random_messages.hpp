#pragma once
// Messages filled at random, and compared bit by bit. Compiled once, for all the messages there are: their generators
// are most of what the compiler has to do for the tests of the wire.

#include <functional>
#include <string>

#include "common/protocol/messages.hpp"

namespace gyre::tests {

/// Every field with anything its type can hold; a third of the numbers are extremes. Runs inside a law.
template <class Message>
[[nodiscard]] Message random_message();

/// The bits of every field, one after the other. Equal for two messages exactly when they are the same, NaN included.
template <class Message>
[[nodiscard]] std::string bits_of(const Message& message);

/// Whether a law's RC_ASSERTs hold in every one of RapidCheck's cases; it prints the case that breaks it.
[[nodiscard]] bool holds(const std::function<void()>& law);

}  // namespace gyre::tests
