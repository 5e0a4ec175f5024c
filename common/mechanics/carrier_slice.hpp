#pragma once
// The local form: what one carrier has to know of a plan to fly its part of it. Its size does not depend on n.
//
//   symbol      meaning                                                           shape   frame   unit
//   B_i         attachment point, p_L + r_i                                       3       W       m
//   f0_i        particular force                                                  3       W       N
//   delta_i     push of the incoming edge on this carrier, −d_in  (unit)          3       W       -
//   deltabar_i  push of the outgoing edge on this carrier, +d_out (unit)          3       W       -
//
//   f_i = f0_i + lambda_in delta_i + lambda_out deltabar_i                                    (local force)
//
// Source: Franchi, Landi, Gabellieri, local force: internal forces along a Hamiltonian cycle.

#include <Eigen/Core>
#include <vector>

#include "common/base/ids.hpp"
#include "common/mechanics/length_law.hpp"
#include "common/mechanics/plan.hpp"

namespace gyre::mechanics {

/// One edge as the carrier at one of its ends feels it. A carrier without such an edge (two carriers, one edge; or a
/// single carrier) has a zero push: the formulas need no special case.
struct EdgePush {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double offset_n = 0.0;
  double amplitude_n = 0.0;
  double phase_rad = 0.0;

  friend bool operator==(const EdgePush& a, const EdgePush& b) {
    return a.direction == b.direction && a.offset_n == b.offset_n && a.amplitude_n == b.amplitude_n &&
           a.phase_rad == b.phase_rad;
  }
};

struct CarrierSlice {
  CarrierId id = 0;
  Eigen::Vector3d attachment_w_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d particular_force_w_n = Eigen::Vector3d::Zero();
  EdgePush incoming;
  EdgePush outgoing;
  double rate_rad_s = 0.0;
  LengthLaw law;
  /// 0: do not compensate the cable's stretch.
  double cable_stiffness_n_m = 0.0;
  /// First-order lags of the carrier's winch and vehicle, which are asked for everything so much ahead; 0: none.
  double winch_lag_s = 0.0;
  double vehicle_lag_s = 0.0;

  /// To the bit: the same plan, told twice.
  friend bool operator==(const CarrierSlice& a, const CarrierSlice& b) {
    return a.id == b.id && a.attachment_w_m == b.attachment_w_m && a.particular_force_w_n == b.particular_force_w_n &&
           a.incoming == b.incoming && a.outgoing == b.outgoing && a.rate_rad_s == b.rate_rad_s && a.law == b.law &&
           a.cable_stiffness_n_m == b.cable_stiffness_n_m && a.winch_lag_s == b.winch_lag_s &&
           a.vehicle_lag_s == b.vehicle_lag_s;
  }
};

/// Whether the slice ever moves its carrier.
[[nodiscard]] inline bool moves(const CarrierSlice& c) {
  return c.incoming.amplitude_n != 0.0 || c.outgoing.amplitude_n != 0.0 || !c.law.profile.constant();
}

/// But for rounding: the same plan, worked out on another machine.
[[nodiscard]] bool alike(const CarrierSlice& a, const CarrierSlice& b);

/// One slice per carrier, in the plan's order of carriers; none for a plan without. An edge whose end is no carrier of
/// the plan is a bug of the caller's (GYRE_ENSURE): `certify` refuses such a plan.
[[nodiscard]] std::vector<CarrierSlice> slices(const Plan& plan);

}  // namespace gyre::mechanics
