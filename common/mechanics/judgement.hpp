#pragma once
// Holds figures against rules, and says in the paper's words what is broken and what would cure it.

#include <vector>

#include "common/mechanics/carrier_slice.hpp"
#include "common/mechanics/certificate.hpp"

namespace gyre::mechanics {

/// One carrier's figures against limits; `non_stop` also refuses a carrier that ever stands still.
void judge_carrier(const CarrierFigures& figures, const Limits& limits, bool non_stop, std::vector<Reason>& reasons);

/// The paper's conditions for a motion that never stops and holds the load: number of carriers, rank, plane, phases.
/// They explain; whether a carrier stops is decided by its exact least speed.
void judge_construction(const Plan& plan, const std::vector<CarrierSlice>& slices, std::vector<Reason>& reasons);

/// The forces exist: |G f0 − w| is rounding.
void judge_equilibrium(const Plan& plan, std::vector<Reason>& reasons);

/// What concerns the formation as a whole: separation and stiffness.
void judge_formation(const Certificate& certificate, const Limits& limits, std::vector<Reason>& reasons);

}  // namespace gyre::mechanics
