#pragma once
// Where somebody was, as a line in space, in bounded memory: what goes round and round the same way takes no more room
// than one round.
//
// Intuition: space is cut into cells, and a step from one cell into the next is drawn once. When there are too many
// steps, cells become twice as long, and fewer steps are told apart. A line so drawn is off the way by less than a
// cell's diagonal.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "common/mechanics/range.hpp"

namespace gyre::ground {

class Trace {
 public:
  static constexpr std::size_t kMostSteps = 3000;

  void add(const Eigen::Vector3d& place_m);
  /// Nobody knows the way to the next place.
  void interrupt() { at_.reset(); }

  [[nodiscard]] const std::vector<std::vector<Eigen::Vector3d>>& strokes() const { return strokes_; }
  /// Of every place, along x, y and z.
  [[nodiscard]] const std::array<mechanics::Range, 3>& extent() const { return extent_; }
  /// Where it began; absent before anything was told.
  [[nodiscard]] const std::optional<Eigen::Vector3d>& first_m() const { return first_m_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] std::size_t steps() const { return steps_.size(); }

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell(const Eigen::Vector3d& place_m) const;
  void step(const Eigen::Vector3d& place_m);
  void widen();

  double cell_m_ = 1e-3;
  std::set<std::pair<Cell, Cell>> steps_;  // drawn
  std::vector<std::vector<Eigen::Vector3d>> strokes_;
  std::optional<Eigen::Vector3d> first_m_;
  std::optional<Cell> at_;
  Eigen::Vector3d entered_m_ = Eigen::Vector3d::Zero();  // where at_ was entered
  bool down_ = false;                                    // whether the last stroke ends there
  std::array<mechanics::Range, 3> extent_;
};

}  // namespace gyre::ground
