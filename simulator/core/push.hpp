#pragma once
// A push of a laboratory: a constant force on the load's centre of mass, for a while.
//
// Intuition: the world is cut into ticks, and a force that jumps between two of them is one that an implicit integrator
// takes exactly. So a push begins with the first tick not before it was asked for, lasts a whole number of ticks, and
// has the impulse that was asked for:
//
//   n = max(1, round(T / h))        force = F T / (n h)
//
// One at a time: a new one takes the place of the one before it. So no two together are stronger than the weight, and
// that is the bound: what is stronger lifts the load out of its cables, or tears it to where no path was certified.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "common/base/time.hpp"

namespace gyre::simulator {

class Push {
 public:
  Push(double weight_n, Duration tick) : weight_n_(weight_n), tick_(tick) {}

  /// Why a push is none that a load can be given, and what would be.
  [[nodiscard]] std::optional<std::string> objection(const Eigen::Vector3d& force_w_n, Duration duration) const;

  /// One that there is no objection to. `arrived` may lie before the tick that comes next, or after it.
  void begin(LocalTime arrived, const Eigen::Vector3d& force_w_n, Duration duration);

  /// The tick that begins `at`; once per tick, in order.
  void tick(LocalTime at);

  /// Throughout that tick.
  [[nodiscard]] const Eigen::Vector3d& force_w_n() const { return now_w_n_; }

 private:
  double weight_n_;
  Duration tick_;
  LocalTime begins_{};
  std::int64_t ticks_left_ = 0;
  Eigen::Vector3d force_w_n_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d now_w_n_ = Eigen::Vector3d::Zero();
};

}  // namespace gyre::simulator
