#pragma once
// What is demanded of a motion, as numbers that a search can push below 0.
//
//   symbol    meaning                                                                unit
//   F         a figure of a carrier, a pair or an edge at a sample, as far as the     its own
//             certificate will prove it
//   L, S      its limit; what it is counted in, the limit's own size as a rule       its own
//
//   residual = ±(F − L) / S          <= 0: met
//
// Everything that the certificate judges is among the demands, and what it takes for granted, too: tension, lengths
// and cosines that keep away from 0. Clearance is the certificate's (docs/design.md, fact 8): how far a carrier may
// stray before its cable touches another.

#include <optional>
#include <string>
#include <vector>

#include "common/design/sampled_motion.hpp"

namespace gyre::design {

enum class Kind { kCarrier, kSeparation, kClearance, kSide, kLoad, kAmplitude };

enum class Origin {
  kAsked,      ///< a limit of the file
  kAlways,     ///< what the certificate judges anyway
  kNecessary,  ///< what a motion needs to be one
};

struct Demand {
  Kind kind = Kind::kCarrier;
  Figure figure = Figure::kCount;  ///< of kCarrier
  bool least = false;              ///< the limit is a least one
  double limit = 0.0;
  double scale = 1.0;
  int who = -1;      ///< one carrier or edge alone; -1: all
  std::string name;  ///< as the file has it, "speed_min_m_s"
  const char* unit = "";
  Origin origin = Origin::kAsked;
  double proven = 1.0;  ///< share of the true figure that the certificate proves

  [[nodiscard]] double residual(double value) const { return slope() * (value - limit / proven); }
  /// d residual / d value.
  [[nodiscard]] double slope() const { return (least ? -1.0 : 1.0) * proven / scale; }
};

/// Sizes that numbers of a mission are counted in.
struct Scales {
  double force_n = 1.0;   ///< a carrier's share of the weight
  double length_m = 1.0;  ///< of a cable
  double speed_m_s = 1.0;
};

[[nodiscard]] std::vector<Demand> demands_of(const Requirements& requirements, const Scales& scales);

/// Whether its limit is the cosine of an angle that the file has.
[[nodiscard]] bool is_angle(const Demand& demand);
/// The limit as the file has it.
[[nodiscard]] double shown_limit(const Demand& demand);

}  // namespace gyre::design
