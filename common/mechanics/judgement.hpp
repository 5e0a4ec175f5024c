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

void judge_separation(const Separation& separation, const Limits& limits, std::vector<Reason>& reasons);

}  // namespace gyre::mechanics
