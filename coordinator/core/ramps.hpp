#pragma once
// How long a change of pace takes, so that every carrier keeps its mission's limits: by a formula, at any number of
// carriers (protocol/pace.hpp, RampPeaks).

#include <optional>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/mechanics/certificate.hpp"
#include "common/mechanics/plan.hpp"
#include "common/protocol/pace.hpp"

namespace gyre::coordinator {

/// What a ramp has to keep: the limits, and what winches can do, by all that the carriers may be doing at full pace
/// meanwhile. What a winch pays out passes by plan time as a carrier's place does, so the same formula bounds it:
/// |L''| <= pace² |L''|max + |pace'| |L'|max.
struct RampLimits {
  mechanics::Limits limits;
  mechanics::Winch winch;
  std::vector<mechanics::CarrierFigures> figures;  ///< of every plan in use, and of mixtures of them; any order

  /// One more, unless another asks for more in everything: of a hundred carriers alike one is left to look at.
  void include(const mechanics::CarrierFigures& carrier);
  /// The first limit that a ramp breaks, in words; absent: none.
  [[nodiscard]] std::optional<std::string> broken_by(const protocol::Ramp& ramp) const;
};

struct RampWish {
  SwarmTime start{};
  double target = 0.0;
  Duration shortest{};
  bool fixed = false;  ///< that long and no longer; a ramp to rest may always take longer
};

/// The ramp that does so, in no more than `longest`. A ramp to rest is always found: to stop comes first.
[[nodiscard]] Result<Duration> ramp_duration(const protocol::Pace& pace, const RampWish& wish, const RampLimits& limits,
                                             Duration longest);

/// Stops within `duration` of `start`, and goes back to `where` that is passed by then: gently, and no faster than a
/// third of full pace.
[[nodiscard]] protocol::Pace stopped_at(PlanTime where, const protocol::Pace& pace, SwarmTime start, Duration duration);

/// How long it takes to stop from full pace, at least `shortest`.
[[nodiscard]] Duration stopping_time(const RampLimits& limits, Duration shortest, Duration longest);

/// Whether some carrier would be slower at this pace, for good, than its mission lets it be. On the way, and at rest,
/// it may. `figures`: of what is flown.
[[nodiscard]] std::optional<std::string> too_slow(double pace, const mechanics::Limits& limits,
                                                  const std::vector<mechanics::CarrierFigures>& figures);

/// Whether a swing of the load would grow at this pace, for good. On the way it may: a ramp is soon over.
[[nodiscard]] std::optional<std::string> swing_grows(double pace, const std::optional<mechanics::Swings>& swings);

}  // namespace gyre::coordinator
