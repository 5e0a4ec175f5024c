#pragma once
// Holds plans and figures against rules, and says in the paper's words what is broken and what would cure it.
//
//   one-carrier impossibility    n = 1 cannot be non-stop and bounded
//   two-carrier obstruction      n = 2 under a periodic level law: both stop whenever d(lambda)/dt = 0
//   two-carrier construction     n = 2 with lengths that swing; the swing is not 0, f0 not along d
//   level non-stop, n >= 3       rank [delta deltabar] = 2; f0 not in their plane; their phases differ by no multiple
//   of pi
//
// Source: Franchi, Landi, Gabellieri, the theorems of these names; docs/design.md, The mechanics.

#include <vector>

#include "common/mechanics/braid.hpp"
#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/certificate.hpp"

namespace gyre::mechanics {

/// Whether it is a plan at all (plan.hpp): carriers, a cycle through them, numbers that are some. Without a reason from
/// here everything else in this folder may be asked about it.
void judge_form(const Plan& plan, std::vector<Reason>& reasons);

/// One carrier's figures against limits; `non_stop` also refuses a carrier that ever stands still. Figures that are not
/// finite break every limit they are held to.
void judge_carrier(const CarrierFigures& figures, const Limits& limits, bool non_stop, std::vector<Reason>& reasons);

/// The same figures against what the mission says that the winch and the vehicle can do. What is not known of a figure
/// is not judged.
void judge_machines(const CarrierFigures& figures, const Winch& winch, const Vehicle& vehicle,
                    std::vector<Reason>& reasons);

/// The paper's conditions for a motion that never stops and holds the load: number of carriers, rank, plane, phases.
/// They explain; whether a carrier stops is decided by its exact least speed.
void judge_construction(const Plan& plan, const std::vector<CarrierSlice>& slices, std::vector<Reason>& reasons);

/// The forces exist: |G f0 − w| is rounding.
void judge_equilibrium(const Plan& plan, std::vector<Reason>& reasons);

void judge_separation(const Approach& separation, const Limits& limits, std::vector<Reason>& reasons);

/// Cables that pass through each other: never.
void judge_braids(const std::vector<Braid>& braids, std::vector<Reason>& reasons);

/// What touches, or is closer to it than the limit.
void judge_clearance(const Approach& clearance, const Limits& limits, std::vector<Reason>& reasons);

/// Vehicles below the load's highest corner, or closer to it than the limit.
void judge_above_load(double above_load_min_m, const Limits& limits, std::vector<Reason>& reasons);

/// A swing of the load dies out, or at least does not grow, in full motion, with some margin.
void judge_swings(const Swings& swings, std::vector<Reason>& reasons);

/// At which paces, on the way from rest, one grows.
void caution_of_swings(const Swings& swings, std::vector<Reason>& cautions);

/// That the load is not pulled back at some moments.
void caution_of_stiffness(double stiffness_min_1_s2, std::vector<Reason>& cautions);

}  // namespace gyre::mechanics
