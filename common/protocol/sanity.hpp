#pragma once
// Nonsense is dropped at the door: what no honest process can have said, judged from the message alone.
//
// Each function answers whether the message can be used at all: every number finite and of a size the physical world
// has, directions of unit length, counts in range. Whether it is new, of the right term, or can be flown is for the
// core that reads it.

#include "common/protocol/messages.hpp"

namespace gyre::protocol {

[[nodiscard]] bool sane(const Beacon& beacon);
[[nodiscard]] bool sane(const PlanOffer& offer);
[[nodiscard]] bool sane(const HeldPlans& held);
[[nodiscard]] bool sane(const AgentStatus& status);
[[nodiscard]] bool sane(const CarrierState& state);
[[nodiscard]] bool sane(const LoadState& state);
[[nodiscard]] bool sane(const Disturbance& disturbance);

}  // namespace gyre::protocol
