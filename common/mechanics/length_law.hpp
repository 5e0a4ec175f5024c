#pragma once
// How long a carrier's cable is at every moment: the one free choice left after the cable's direction is fixed.
//
//   symbol   meaning                                             unit
//   l        cable length, attachment to carrier                 m
//   B        attachment point in the world                       m, W
//   q        unit cable direction, attachment to carrier         -, W
//   u        fixed unit direction of a projection law            -, W
//   s*(t)    profile: where along u the carrier has to be        m
//   theta    phase of the cycle, rate · t                        rad
//
//   projection    l = (s*(t) − u·B) / (u·q)      level: u = e_z, s* = altitude;  directional: any u, any s*
//   free          l = l*(t)                      sine: l* oscillates;            fixed: l* constant
//
// A fixed length meets a profile only if s* − u·B = l u·q(t) for all t (fixed-length compatibility).
// Source: Franchi, Landi, Gabellieri: level and directional profiles, two-carrier construction, fixed-length
// compatibility.

#include <Eigen/Core>

namespace gyre::mechanics {

/// What a harmonic may be made of: the polynomials behind every exact figure have their degree from it.
inline constexpr int kMaxNumerator = 64;
inline constexpr int kMaxDenominator = 8;

/// A frequency as a multiple of the cycle's rate. Kept as whole numbers, so that a motion that is meant to be
/// periodic is exactly periodic, after a week as after a second.
struct Harmonic {
  int numerator = 1;
  int denominator = 1;

  [[nodiscard]] double ratio() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }

  friend bool operator==(const Harmonic& a, const Harmonic& b) {
    return a.numerator == b.numerator && a.denominator == b.denominator;
  }
};

/// mean + swing · sin(harmonic · theta + phase_rad).
struct Oscillation {
  double mean = 0.0;
  double swing = 0.0;
  Harmonic harmonic;
  double phase_rad = 0.0;

  [[nodiscard]] bool constant() const { return swing == 0.0; }

  friend bool operator==(const Oscillation& a, const Oscillation& b) {
    return a.mean == b.mean && a.swing == b.swing && a.harmonic == b.harmonic && a.phase_rad == b.phase_rad;
  }
};

struct LengthLaw {
  enum class Kind { kLevel, kDirectional, kSine, kFixed };

  Kind kind = Kind::kFixed;
  /// u, unit, W. Read by the projection laws only; e_z for level.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  /// s*(t) of a projection law [m along u], or l*(t) of a free law [m].
  Oscillation profile;

  [[nodiscard]] bool is_projection() const { return kind == Kind::kLevel || kind == Kind::kDirectional; }

  friend bool operator==(const LengthLaw& a, const LengthLaw& b) {
    return a.kind == b.kind && a.direction == b.direction && a.profile == b.profile;
  }

  static LengthLaw level(double altitude_m);
  static LengthLaw directional(const Eigen::Vector3d& direction, const Oscillation& profile_m);
  static LengthLaw sine(const Oscillation& length_m);
  static LengthLaw fixed(double length_m);
};

/// "level", "directional", "sine", "fixed": the words of the mission file.
[[nodiscard]] const char* name(LengthLaw::Kind kind);

}  // namespace gyre::mechanics
