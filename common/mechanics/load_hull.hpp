#pragma once
// The load's shape as its cables see it: the cone of directions in which the load lies, from an attachment.
//
//   symbol   meaning                                                   shape   frame   unit
//   B        attachment                                                3       W       m
//   v_k      corners of the load's convex hull                         3       W       m
//   C        { sum c_k (v_k − B), c_k >= 0 }                           cone    W
//   n        outward normal of a face of C                             3       W       -
//
// A straight cable from B touches the load exactly when it lies in C, however long it is: for a load that is convex and
// an attachment on it or outside. So how far the carrier is from C is how far it may stray before its cable does.
//
// Reference: docs/design.md, fact 8.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/mechanics/plan.hpp"

namespace gyre::mechanics {

/// Corners of the load's hull, W; none for a load without a shape.
[[nodiscard]] std::vector<Eigen::Vector3d> hull_w(const Load& load);

class LoadCone {
 public:
  /// `hull_w_m`: at least four corners, not all in a plane. Absent for an attachment inside the hull: nothing but load
  /// is to be seen from there.
  [[nodiscard]] static std::optional<LoadCone> seen_from(const Eigen::Vector3d& attachment_w_m,
                                                         const std::vector<Eigen::Vector3d>& hull_w_m);

  /// From the nearest point of the cone to a place relative to the attachment; zero inside.
  [[nodiscard]] Eigen::Vector3d off(const Eigen::Vector3d& place_m) const;

 private:
  /// The part of a face between two corners that are seen at its rim.
  struct Face {
    Eigen::Vector3d normal, a, b;  ///< unit; the corners' directions, not along each other
  };
  std::vector<Face> faces_;
};

}  // namespace gyre::mechanics
