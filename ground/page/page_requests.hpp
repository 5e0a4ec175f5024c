#pragma once
// What a person at the page asks for, read from JSON (idl/page.proto). Errors say what is wrong and what would be
// right.

#include <Eigen/Core>
#include <string>

#include "common/base/result.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::ground {

struct Answer {
  bool done = false;
  std::string text;
};
[[nodiscard]] std::string answer_json(const Answer& answer);

/// A person's wish. Without an id. Errors say what is wrong, and what would be right.
[[nodiscard]] Result<protocol::Command> order_of(const std::string& json);

/// Reads, certifies, words; takes as long as certifying does.
[[nodiscard]] Result<std::string> verdict_json(const std::string& request_json);

enum class HurtKind { kKill = 1, kStop, kContinue, kRestart, kLose, kShiftClock, kPush };
struct HurtRequest {
  HurtKind kind = HurtKind::kKill;
  std::string process;
  double amount = 0.0;  ///< percent of the packets, or seconds
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();
  double duration_s = 0.0;
};
[[nodiscard]] Result<HurtRequest> hurt_of(const std::string& json);

}  // namespace gyre::ground
