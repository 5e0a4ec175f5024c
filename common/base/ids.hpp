#pragma once
// Names of things that travel between processes.

#include <cstdint>

namespace gyre {

/// A carrier's number as the mission file gives it: 1..kMaxCarrierId.
using CarrierId = std::uint32_t;

/// One DDS participant id per carrier has to fit below the protocol's limit of 119 (the hubs take four).
inline constexpr CarrierId kMaxCarrierId = 100;

}  // namespace gyre
