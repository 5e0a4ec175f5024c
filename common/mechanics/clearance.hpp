#pragma once
// How close things come that must not touch: carriers, their cables, the load. Lower bounds that are proven.
//
//   symbol   meaning                                                        shape   frame   unit
//   p_i      carrier i, with the radius R_i of its vehicle                  3       W       m
//   B_i      attachment i; the cable is the segment from B_i to p_i         3       W       m
//   C_i      directions in which the load lies, from B_i (load_hull.hpp)    cone    W
//
// Three questions. How far apart are carriers (separation), how far apart are cables (cable_distance), and how far may
// any one carrier stray from its path before something touches (clearance)? A plain distance says little about cables:
// near the load they are as close as their attachments, whatever one does. But a carrier that strays by x moves its
// cable by a·x only, at the share a of its length. So the clearance of cable i from cable j is
//
//   min |B_i + a (p_i − B_i) − B_j − b (p_j − B_j)| / a   over 0 < a <= 1, 0 <= b <= 1, b <= a    and with i, j
//   exchanged
//     = the distance of cable j from the ray { p_i + s (B_i − B_j), s >= 0 }
//
// (divide by a, put s = 1/a − 1 and b/a for b), which is never less than the distance of the cables. That of a vehicle
// is its distance from cables and vehicles less the radii; that of cable i from the load is the distance of p_i − B_i
// from C_i.
//
// All of these are distances of two convex sets with corners that move. With n from the one's closest point to the
// other's, and every corner x of the first and y of the second,
//
//   gap(t + s) >= min over x, y of n·(x − y) − |n·(x' − y')| h − (a_x + a_y) h² / 2              |s| <= h
//
// on a cell of half width h: n separates the sets, and a set reaches no further than its corners. The accelerations a
// are proven bounds, so this is a proof, by branch and bound.
//
// Reference: docs/design.md, facts 1 and 8.

#include <functional>
#include <optional>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/taylor.hpp"

namespace gyre::mechanics {

/// A carrier and its cable in a window of time.
struct Hanging {
  CarrierId id = 0;
  Eigen::Vector3d attachment_w_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double altitude_min_m = 0.0, acceleration_max_m_s2 = 0.0;  ///< of the carrier, in this window
  std::function<TaylorVector<double>(double t_s)> position_w_m;
};

/// What comes this close touches.
inline constexpr double kSeparationSlack_m = 2e-7;
/// The bounds on cables are less than the truth by no more than this share of it, and kTouch_m.
inline constexpr double kClearanceSlack = 0.009;
inline constexpr double kTouch_m = 1e-6;

/// Of carriers' places, over [begin_s, end_s]; attained to kSeparationSlack_m. Absent for fewer than two carriers, and
/// where one's acceleration has no bound. So are the others.
[[nodiscard]] std::optional<Approach> separation(const std::vector<Hanging>& carriers, double begin_s, double end_s);

/// Of cables, over [begin_s, end_s].
[[nodiscard]] std::optional<Approach> cable_distance(const std::vector<Hanging>& carriers, double begin_s,
                                                     double end_s);

/// Over [begin_s, end_s]; `hull_w_m` as in load_hull.hpp, or none. Also absent if there is nothing that could touch: a
/// single carrier without a load's shape. An attachment inside the hull has a clearance of 0.
[[nodiscard]] std::optional<Approach> clearance(const std::vector<Hanging>& carriers,
                                                const std::vector<Eigen::Vector3d>& hull_w_m, double begin_s,
                                                double end_s);

/// From the hull's highest corner up to the lowest edge of a vehicle; absent without a hull.
[[nodiscard]] std::optional<double> above_load(const std::vector<Hanging>& carriers,
                                               const std::vector<Eigen::Vector3d>& hull_w_m);

}  // namespace gyre::mechanics
