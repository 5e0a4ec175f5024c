#pragma once
// What a person at the page wants to be done to a flight on purpose, and the answer that every wish gets.

#include <Eigen/Core>
#include <string>

namespace gyre::ground {

struct Answer {
  bool done = false;
  std::string text;
};

enum class HurtKind { kKill = 1, kStop, kContinue, kRestart, kLose, kShiftClock, kPush };
struct HurtRequest {
  HurtKind kind = HurtKind::kKill;
  std::string process;                                  ///< "agent 3"; of a push nobody: it is the simulator's
  double amount = 0.0;                                  ///< kLose: percent of the packets; kShiftClock: seconds
  Eigen::Vector3d force_w_n = Eigen::Vector3d::Zero();  ///< kPush
  double duration_s = 0.0;                              ///< kPush
};

}  // namespace gyre::ground
