#pragma once
// How close two carriers ever come: a lower bound that is proven, and attained to 1e-7.
//
//   D = p_i − p_j,  F = D·D,  F' = 2 D·D',  F'' = 2 |D'|² + 2 D·D'' >= −2 |D| (a_i + a_j)
//
// On a cell of half width h around t: |D| <= |D(t)| + (v_i + v_j) h, so F >= F(t) − |F'(t)| h − |D|_max (a_i + a_j) h².
// The speeds v and accelerations a are the certificate's own, exact for all time; so this is a proof, by branch and
// bound. A bound on the first derivative alone would prove as much with thousands of times the cells.
//
// Reference: DESIGN fact 1 (where no polynomial is at hand).

#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/certificate.hpp"

namespace gyre::mechanics {

/// `figures` in the order of `slices`. Infinite for fewer than two carriers; 0 where a carrier's motion is unbounded.
[[nodiscard]] Separation separation(const std::vector<CarrierSlice>& slices, const std::vector<CarrierFigures>& figures,
                                    double period_s);

}  // namespace gyre::mechanics
