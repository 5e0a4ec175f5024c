#pragma once
// The pace of the phase: how plan time passes on the swarm's clock. The one number by which a flight starts, slows and
// stops.
//
// A plan holds the load at every phase, so starting and stopping are no changes of plan, only of the clock the plan
// runs on. Whatever the pace does, the load is in equilibrium, as long as all have the same plan time:
//
//   symbol   meaning                                                               unit
//   t        swarm time                                                            s
//   tau      plan time                                                             s
//   pace     tau', 1 in full motion, 0 at rest                                     -
//   P        where a plan, or a mixture of plans, has a carrier, by plan time      m
//
//   p(t) = P(tau(t))        v = pace P'        a = pace² P'' + pace' P'
//
// The axis is piecewise: constant paces, and between them ramps that leave no step in pace, pace' or pace''. A ramp
// that begins while another is under way takes over from what that one has reached:
//
//   pace(t) = target + (pace0 − target) v(x) + pace0' S s(y) + pace0'' S² c(y)
//   x = (t − start) / T        y = (t − start) / S        S = min(T, kSlopeFades)
//
// with v, s, c as in mechanics/quintic.hpp. So whatever is asked for at whatever moment, nobody has to wait. The slope
// fades in a time of its own: over a long T it would carry the pace far beyond both ends, and backwards.
// Reference: docs/design.md, fact 7.

#include <vector>

#include "common/base/time.hpp"

namespace gyre::protocol {

inline constexpr Duration kSlopeFades = std::chrono::milliseconds(500);

/// Where the axis is at one moment.
struct PlanMoment {
  PlanTime at{};
  double pace = 0.0;
  double rate_1_s = 0.0;        ///< pace'
  double curvature_1_s2 = 0.0;  ///< pace''
};

/// Complete in itself: what it begins with, and where it leads. Before its start it is a constant pace.
struct Ramp {
  SwarmTime start{};
  Duration duration{};  ///< 0: there at once, which only a constant pace may be
  PlanMoment from;      ///< at the start
  double target = 0.0;

  [[nodiscard]] SwarmTime end() const { return start + duration; }
  [[nodiscard]] PlanMoment at(SwarmTime time) const;
};

[[nodiscard]] bool operator==(const Ramp& a, const Ramp& b);

/// What a ramp asks for at its worst of a carrier that needs at most this speed and this acceleration at full pace.
/// Both are proven: found on a grid, with what could hide between its points added.
struct RampPeaks {
  double pace = 0.0;               ///< |pace|
  double acceleration_m_s2 = 0.0;  ///< pace² a_max + |pace'| v_max
};
[[nodiscard]] RampPeaks peaks(const Ramp& ramp, double speed_max_m_s, double acceleration_max_m_s2);

/// What is passing, what comes next, what overtakes that, and one to spare.
inline constexpr std::size_t kMaxRamps = 4;

struct Pace {
  /// In order of their starts, at least one; each counts from its start on.
  std::vector<Ramp> ramps{Ramp{}};

  [[nodiscard]] PlanMoment at(SwarmTime time) const;
  /// Where it leads.
  [[nodiscard]] double target() const { return ramps.back().target; }
  /// Whether it is constant from `now` on.
  [[nodiscard]] bool constant(SwarmTime now) const { return now >= ramps.back().end(); }
  /// Whether plan time stands, and will.
  [[nodiscard]] bool rests(SwarmTime now) const { return constant(now) && target() == 0.0; }

  /// The same until `start`, and from there to `target` within `duration`, whatever was to come. The ramp that is
  /// passing at `start` stays, so there is room for kMaxRamps − 1 that have not begun.
  [[nodiscard]] Pace with_ramp(SwarmTime start, Duration duration, double target) const;

  /// Forgets what has passed. True if anything changed; the motion ahead does not.
  bool settle(SwarmTime now);

  friend bool operator==(const Pace& a, const Pace& b) { return a.ramps == b.ramps; }
};

}  // namespace gyre::protocol
