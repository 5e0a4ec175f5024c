#pragma once
// How close two carriers ever come: a lower bound that is proven, and attained to kSeparationSlack_m.
//
//   D = p_i − p_j,  F = D·D,  F' = 2 D·D'
//
// On a cell of half width h around t: D(t + s) = D + D' s + r with |r| <= (a_i + a_j) s² / 2, and so
//
//   F(t + s) = |D + D' s + r|² >= |D|² + 2 D·(D' s + r) >= F(t) − |F'(t)| h − |D(t)| (a_i + a_j) h²
//
// The accelerations a are the certificate's own, exact for all time; so this is a proof, by branch and bound. A bound
// on the first derivative alone would prove as much with thousands of times the cells.
//
// Reference: docs/design.md, fact 1 (where no polynomial is at hand).

#include <functional>
#include <optional>
#include <vector>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/taylor.hpp"

namespace gyre::mechanics {

/// Where a carrier is at any time of a window, and how fast and how sharply it moves in it at most.
struct Path {
  CarrierId id = 0;
  double speed_max_m_s = 0.0;
  double acceleration_max_m_s2 = 0.0;
  std::function<TaylorVector<double>(double t_s)> position_w_m;
};

/// Carriers that come closer than this touch: their separation is 0.
inline constexpr double kSeparationSlack_m = 2e-7;

/// Over [begin_s, end_s]. Absent for fewer than two carriers, and where a carrier's acceleration has no bound.
[[nodiscard]] std::optional<Separation> separation(const std::vector<Path>& paths, double begin_s, double end_s);

}  // namespace gyre::mechanics
