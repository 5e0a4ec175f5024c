#pragma once
// What a person at the page asks for, read from JSON (idl/page.proto). Errors say what is wrong and what would be
// right.

#include <string>

#include "common/base/result.hpp"
#include "common/protocol/messages.hpp"
#include "ground/page/core/hurt_request.hpp"

namespace gyre::ground {

[[nodiscard]] std::string answer_json(const Answer& answer);

/// A person's wish. Without an id. Errors say what is wrong, and what would be right.
[[nodiscard]] Result<protocol::Command> order_of(const std::string& json);

/// Reads, certifies, words; takes as long as certifying does.
[[nodiscard]] Result<std::string> verdict_json(const std::string& request_json);

/// Reads only: what becomes of it is for who owns the processes (flight/core/hurt_judge.hpp).
[[nodiscard]] Result<HurtRequest> hurt_of(const std::string& json);

}  // namespace gyre::ground
