#pragma once
// A course: what the swarm flies, whole. Which plans count now, and how a carrier's slices of them lie on each other.

#include <cstdint>
#include <functional>
#include <vector>

#include "common/base/time.hpp"
#include "common/mechanics/transition.hpp"

namespace gyre::protocol {

/// A plan's number. The term is the coordinator's that made it; revision 0 means "no plan".
struct PlanNumber {
  std::uint64_t term = 0;
  std::uint64_t revision = 0;

  [[nodiscard]] bool none() const { return revision == 0; }
  friend bool operator==(const PlanNumber& a, const PlanNumber& b) {
    return a.term == b.term && a.revision == b.revision;
  }
  friend bool operator!=(const PlanNumber& a, const PlanNumber& b) { return !(a == b); }
  friend bool operator<(const PlanNumber& a, const PlanNumber& b) {
    return a.term != b.term ? a.term < b.term : a.revision < b.revision;
  }
};

/// A plan on the swarm's clock: theta = rate · (now − epoch).
struct TimedPlan {
  PlanNumber number;
  SwarmTime epoch{};

  friend bool operator==(const TimedPlan& a, const TimedPlan& b) { return a.number == b.number && a.epoch == b.epoch; }
};

/// A transition is proposed until every agent has confirmed it, then it is go; a revoked one is simply not there.
enum class Stage : std::uint8_t { kProposed = 1, kGo = 2 };

struct Transition {
  std::uint64_t id = 0;
  TimedPlan to;
  SwarmTime start{};
  Duration duration{};
  Stage stage = Stage::kProposed;

  [[nodiscard]] SwarmTime end() const { return start + duration; }
  friend bool operator==(const Transition& a, const Transition& b) {
    return a.id == b.id && a.to == b.to && a.start == b.start && a.duration == b.duration && a.stage == b.stage;
  }
};

/// More than this many transitions are never under way at once: engage, turn back, freeze, and one to spare.
inline constexpr std::size_t kMaxTransitions = 4;
static_assert(kMaxTransitions + 1 == mechanics::kMaxLayers, "one layer per transition, and the base");
/// The plans anybody has to know at once: a course's base, one per transition, and where it may be sent next: to the
/// motion or to rest.
inline constexpr std::size_t kMaxPlans = kMaxTransitions + 3;

/// What the swarm flies, whole: a plan at the bottom and the transitions that lie on it (mechanics/transition.hpp).
struct Course {
  std::uint64_t revision = 0;  ///< grows with every change within a term
  TimedPlan base;
  std::vector<Transition> transitions;

  friend bool operator==(const Course& a, const Course& b) {
    return a.revision == b.revision && a.base == b.base && a.transitions == b.transitions;
  }
};

/// A carrier's slice of a plan, or nullptr where it is not held.
using SliceLookup = std::function<const mechanics::CarrierSlice*(const PlanNumber&)>;

/// The course's plan and transitions as layers, in seconds since `origin`. Transitions that are only proposed are not
/// flown and not in it. Empty when a slice is missing: a course is flown whole or not at all.
[[nodiscard]] std::vector<mechanics::TimedLayer> layers(const Course& course, SwarmTime origin,
                                                        const SliceLookup& lookup);

/// Every plan the course refers to, proposed ones too, from the bottom up.
[[nodiscard]] std::vector<PlanNumber> plans_of(const Course& course);

/// A transition that is complete makes its plan the base, and what lay below it goes. True if anything changed;
/// the motion does not change by it.
bool settle(Course& course, SwarmTime now);

/// Whether a transition that is go has started and is not complete.
[[nodiscard]] bool in_transition(const Course& course, SwarmTime now);

}  // namespace gyre::protocol
