#pragma once
// What our own reader says of a recording, for others to be held against: how many messages on which topic, what it
// says about itself, and of the last message of some topics what it means to us.

#include <nlohmann/json.hpp>
#include <string>

namespace gyre::tests {

/// `whole`, `messages`, `topics`, `metadata`, `samples`, `problems`.
[[nodiscard]] nlohmann::json said_of(const std::string& path);

}  // namespace gyre::tests
