#pragma once
// What is not absurd. Anything outside is a slip of the unit or of the exponent, not a flight.

#include "common/mission/located.hpp"
#include "common/protocol/silence.hpp"

namespace gyre::mission {

inline constexpr Span kMassKg{1e-6, 1e6, "kg"};
inline constexpr Span kInertia{-1e9, 1e9, "kg m^2"};
inline constexpr Span kPlaceM{-1e5, 1e5, "m"};
inline constexpr Span kLengthM{0.0, 1e5, "m"};
inline constexpr Span kComponent{-1e6, 1e6, ""};
inline constexpr Span kGravity{1e-3, 1e3, "m/s^2"};
inline constexpr Span kForceN{-1e7, 1e7, "N"};
inline constexpr Span kPositiveForceN{0.0, 1e7, "N"};
inline constexpr Span kRate{1e-6, 1e3, "rad/s"};
inline constexpr Span kPhaseRad{-1e3, 1e3, "rad"};
inline constexpr Span kSpeed{0.0, 1e4, "m/s"};
inline constexpr Span kAcceleration{0.0, 1e6, "m/s^2"};
inline constexpr Span kStiffness{1e-3, 1e9, "N/m"};
inline constexpr Span kDamping{0.0, 1e9, "N s/m"};
inline constexpr Span kTimeConstantS{0.0, 1e3, "s"};
inline constexpr Span kGustTimeS{1e-3, 1e4, "s"};
inline constexpr Span kDurationS{0.1, 3600.0, "s"};
inline constexpr Span kLeaseS{2.0, 600.0, "s"};
static_assert(from_seconds(kLeaseS.min) == protocol::kShortestLease &&
              from_seconds(kLeaseS.max) == protocol::kLongestLease);
inline constexpr Span kCosine{0.0, 1.0, ""};
inline constexpr Span kRotationDeg{0.0, 180.0, "deg"};
inline constexpr Span kBankDeg{0.0, 90.0, "deg"};
inline constexpr Span kLagError{-0.9, 10.0, ""};

}  // namespace gyre::mission
