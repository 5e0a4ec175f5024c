#include "common/mechanics/floquet.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace gyre::mechanics {
namespace {

constexpr int kFreedoms = 6;
constexpr int kUnknowns = kFreedoms * kRadauStages;
constexpr int kStates = 2 * kFreedoms;

using Coefficients = Eigen::Matrix<double, kRadauStages, kRadauStages>;
using StageMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using StageVectors = Eigen::Matrix<double, kUnknowns, kStates>;
using Half = Eigen::Matrix<double, kFreedoms, kStates>;

/// A of Radau IIA; its last row are the weights, and its rows sum up to the nodes.
Coefficients radau_coefficients() {
  const double root = std::sqrt(6.0);
  Coefficients a;
  a << (88.0 - 7.0 * root) / 360.0, (296.0 - 169.0 * root) / 1800.0, (-2.0 + 3.0 * root) / 225.0,  //
      (296.0 + 169.0 * root) / 1800.0, (88.0 + 7.0 * root) / 360.0, (-2.0 - 3.0 * root) / 225.0,   //
      (16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0;
  return a;
}

/// Twelve solutions at once, one from each unit state; columns of (x, x').
struct Solutions {
  Half x = Half::Zero();
  Half v = Half::Zero();

  Solutions() {
    x.leftCols<kFreedoms>().setIdentity();
    v.rightCols<kFreedoms>().setIdentity();
  }
};

/// By the scale; what has died out is nothing, before it becomes a denormal number, with which processors crawl.
void scaled(Half& half, double scale) {
  constexpr double kDiedOut = 1e-100;
  half /= scale;
  half = (half.array().abs() < kDiedOut).select(0.0, half);
}

class Radau {
 public:
  Radau(const Matrix6d& inertia, double step_s, double pace)
      : inertia_(inertia), pace_(pace), h_(step_s), ha_(step_s * radau_coefficients()), hhaa_(ha_ * ha_) {}

  /// One step, by the moments at its three nodes.
  void advance(const LinearMoment* moments, Solutions& solutions) {
    for (int i = 0; i < kRadauStages; ++i) {
      const Matrix6d& damping = moments[i].damping;
      const Matrix6d stiffness = moments[i].stiffness + pace_ * moments[i].circulation;
      const int row = kFreedoms * i;
      for (int j = 0; j < kRadauStages; ++j) {
        auto block = system_.block<kFreedoms, kFreedoms>(row, kFreedoms * j);
        block = ha_(i, j) * damping + hhaa_(i, j) * stiffness;
        if (i == j) block += inertia_;
      }
      auto push = accelerations_.middleRows<kFreedoms>(row);
      const double reached = h_ * radau_nodes()[static_cast<std::size_t>(i)];
      push.noalias() = -stiffness.lazyProduct(solutions.x);
      push.noalias() -= Matrix6d(damping + reached * stiffness).lazyProduct(solutions.v);
    }
    accelerations_ = system_.partialPivLu().solve(accelerations_);
    solutions.x += h_ * solutions.v;
    for (int j = 0; j < kRadauStages; ++j) {
      const auto a = accelerations_.middleRows<kFreedoms>(kFreedoms * j);
      solutions.x += hhaa_(kRadauStages - 1, j) * a;
      solutions.v += ha_(kRadauStages - 1, j) * a;
    }
  }

 private:
  Matrix6d inertia_;
  double pace_, h_;
  Coefficients ha_, hhaa_;
  StageMatrix system_;
  StageVectors accelerations_;
};

}  // namespace

const std::array<double, kRadauStages>& radau_nodes() {
  static const std::array<double, kRadauStages> kNodes = {(4.0 - std::sqrt(6.0)) / 10.0, (4.0 + std::sqrt(6.0)) / 10.0,
                                                          1.0};
  return kNodes;
}

double floquet_growth(const Matrix6d& inertia, const std::vector<LinearMoment>& moments, double period_s, double pace) {
  // What decays by a thousand orders of magnitude in a period would be rounded to nothing, so its scale is kept apart.
  constexpr std::size_t kBetweenScalings = 16;
  const std::size_t steps = moments.size() / kRadauStages;
  const double duration_s = period_s / pace;
  Radau radau(inertia, duration_s / static_cast<double>(steps), pace);
  Solutions solutions;
  double log_scale = 0.0;
  for (std::size_t k = 0; k < steps; ++k) {
    radau.advance(&moments[kRadauStages * k], solutions);
    if (k % kBetweenScalings != 0 && k + 1 != steps) continue;
    const double scale = std::max(solutions.x.cwiseAbs().maxCoeff(), solutions.v.cwiseAbs().maxCoeff());
    if (!(scale > 0.0) || !std::isfinite(scale)) return std::numeric_limits<double>::quiet_NaN();
    scaled(solutions.x, scale);
    scaled(solutions.v, scale);
    log_scale += std::log(scale);
  }
  Eigen::Matrix<double, kStates, kStates> monodromy;
  monodromy << solutions.x, solutions.v;
  const Eigen::EigenSolver<decltype(monodromy)> solver(monodromy, false);
  if (solver.info() != Eigen::Success) return std::numeric_limits<double>::quiet_NaN();
  return (std::log(solver.eigenvalues().cwiseAbs().maxCoeff()) + log_scale) / duration_s;
}

}  // namespace gyre::mechanics
