#pragma once
// Whether a vehicle can fly a plan, by the same exact figures the coordinator used for the whole
// (mechanics/orbit_figures.hpp): whoever made the plan, this vehicle flies nothing it cannot.
//
// Not within a step: an honest plan takes microseconds, but the worst slices that pass the door take more than a
// minute, and no setpoint would go out meanwhile. So the core asks and flies on; whoever performs its outputs judges,
// beside the beat, and tells the verdict as an event. Nothing interrupts a judgement: what is asked next waits for it.

#include "common/base/result.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/protocol/messages.hpp"

namespace gyre::agent {

/// What its owner says of this carrier's winch and vehicle. Their lags are not his to say: the plan knows them.
struct Machines {
  mechanics::Winch winch;
  mechanics::Vehicle vehicle;
};

struct PlanQuestion {
  protocol::NumberedSlice plan;
  mechanics::Limits vehicle;  ///< absent limits are not judged; its speed_min holds for plans that move
  Machines machines;
};

struct PlanVerdict {
  protocol::PlanNumber number;
  Result<mechanics::CarrierFigures> figures;  ///< or, in words, why this vehicle cannot fly it
};

[[nodiscard]] PlanVerdict judge(const PlanQuestion& question);

}  // namespace gyre::agent
