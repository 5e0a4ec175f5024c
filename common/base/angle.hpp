#pragma once
// Angles are radians everywhere; degrees are for people.

namespace gyre {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;

[[nodiscard]] constexpr double degrees(double angle_rad) {
  return angle_rad * (180.0 / kPi);
}

[[nodiscard]] constexpr double radians(double angle_deg) {
  return angle_deg * (kPi / 180.0);
}

}  // namespace gyre
