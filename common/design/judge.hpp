#pragma once
// How far a sampled motion is from what is demanded of it, and how that changes with every variable.
//
//   symbol    meaning                                                                       unit
//   p_i       carrier i at a sample                                                         m, W
//   u         the side of a pair, horizontal                                                -
//   y         where the cables of a pair are at the height of the lower carrier             m, W
//
// Clearance is that of the certificate: the distance of cable j from the places to which carrier i may stray before its
// cable touches that one, { p_i + s (B_i − B_j), s >= 0 }, and from the vehicle itself.
//
// That two cables are not wound around each other no distance tells, since cables can pass through each other between
// two samples. So each pair has a side:
//
//   u · (y_j − y_i) >= least
//
// At the attachments, and so all along the cables, carrier j is on that side of carrier i, at every sample. The curve
// of y_j − y_i is an ellipse or nearly so, which either encloses 0, and then the cables braid, or has such a side.
//
// Reference: docs/design.md, fact 8.

#include "common/design/demands.hpp"
#include "common/mechanics/load_hull.hpp"

namespace gyre::design {

/// One residual: of a demand, of whom, when.
struct Row {
  std::size_t demand = 0;
  std::size_t first = 0, second = 0;  ///< carriers, or an edge; `second` of pairs only
  std::size_t sample = 0;
};

/// A row and what it is where it was looked at.
struct Judged {
  Row row;
  double residual = 0.0;
};

class Judge {
 public:
  /// All of them live as long as this.
  Judge(const mechanics::Plan& plan, const Unknowns& unknowns, const std::vector<Demand>& demands,
        const SampledMotion& motion);

  /// Gives every pair the side on which it is furthest apart in the motion as it was last evaluated.
  void choose_sides();

  /// Residuals above `least`, and the greatest of all. Of the motion as it was last evaluated, at x.
  struct Findings {
    std::vector<Judged> rows;
    double worst = 0.0;
  };
  [[nodiscard]] Findings find(const Eigen::VectorXd& x, double least) const;

  /// One residual, and gradient = its change by x.
  double residual(const Row& row, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> gradient) const;

 private:
  struct Gap {
    double distance_m = 0.0;
    Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit, from the first to the second
    double first_share = 1.0, second_share = 1.0;     ///< how far along their cables the closest points are
  };
  /// How far apart on a side, and how that changes with either carrier's place.
  struct Side {
    double distance_m = 0.0;
    Eigen::Vector3d by_first = Eigen::Vector3d::Zero(), by_second = Eigen::Vector3d::Zero();
  };
  [[nodiscard]] Side side(const Row& row, const Eigen::Vector3d& along) const;
  [[nodiscard]] const Eigen::Vector3d& chosen(const Row& row) const {
    return sides_[row.first * motion_.carriers() + row.second];
  }
  [[nodiscard]] Gap separation(const Row& row) const;
  [[nodiscard]] Gap off_load(const Row& row) const;
  [[nodiscard]] Gap clearance(const Row& row) const;
  [[nodiscard]] double value(const Row& row, const Eigen::VectorXd& x) const;

  const mechanics::Plan& plan_;
  const Unknowns& unknowns_;
  const std::vector<Demand>& demands_;
  const SampledMotion& motion_;
  std::vector<Eigen::Vector3d> sides_;      ///< of pairs, by first and second
  std::vector<mechanics::LoadCone> cones_;  ///< of carriers; none for a load without a shape
};

}  // namespace gyre::design
