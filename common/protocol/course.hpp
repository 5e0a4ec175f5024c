#pragma once
// A course: what the swarm flies, whole. Which plans count now, how a carrier's slices of them lie on each other, and
// at what pace they run.
//
//   P(tau)   the plan at the bottom and the transitions that lie on it, by plan time (mechanics/transition.hpp)
//   tau(t)   the pace axis (pace.hpp), which stops at the end of the lease (silence.hpp)
//
// Transitions run on plan time, too: whoever stops the phase stops them where they are, and what was proven of them at
// full pace holds at every lower one.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/base/time.hpp"
#include "common/mechanics/transition.hpp"
#include "common/protocol/pace.hpp"

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

/// A plan on the plan clock: theta = rate · (tau − epoch).
struct TimedPlan {
  PlanNumber number;
  PlanTime epoch{};

  friend bool operator==(const TimedPlan& a, const TimedPlan& b) { return a.number == b.number && a.epoch == b.epoch; }
};

struct Transition {
  TimedPlan to;
  PlanTime start{};
  Duration duration{};  ///< of plan time

  [[nodiscard]] PlanTime end() const { return start + duration; }
  friend bool operator==(const Transition& a, const Transition& b) {
    return a.to == b.to && a.start == b.start && a.duration == b.duration;
  }
};

/// More than this many transitions are never under way at once.
inline constexpr std::size_t kMaxTransitions = 4;
static_assert(kMaxTransitions + 1 == mechanics::kMaxLayers, "one layer per transition, and the base");
/// The plans anybody has to know at once: a course's base, one per transition, one that is proposed, and the mission's.
inline constexpr std::size_t kMaxPlans = kMaxTransitions + 3;

/// Who wished it.
enum class Wisher : std::uint8_t {
  kNobody = 1,    ///< this swarm has never been told anything
  kStart = 2,     ///< the coordinator was started with the wish
  kPerson = 3,    ///< a command
  kSilence = 4,   ///< a lease ended
  kEvidence = 5,  ///< a carrier got stuck
};

/// What the swarm is to do, until somebody wishes something else. Part of the course, so it survives every hand-over:
/// what a person stopped stays stopped, whoever leads.
struct Wish {
  double pace = 0.0;               ///< 0: rest
  bool rest_when_changed = false;  ///< as soon as no transition is under way any more
  Wisher by = Wisher::kNobody;

  friend bool operator==(const Wish& a, const Wish& b) {
    return a.pace == b.pace && a.rest_when_changed == b.rest_when_changed && a.by == b.by;
  }
};

struct Course {
  std::uint64_t term = 0;      ///< of the coordinator that made it
  std::uint64_t revision = 0;  ///< grows with every change within a term
  Wish wish;
  Pace pace;
  /// Until when the phase may run on without another word; absent: for ever. It alone changes without a new revision.
  std::optional<SwarmTime> lease;
  Duration stopping = std::chrono::seconds(2);  ///< how long the stop at the end of the lease takes, > 0
  TimedPlan base;
  std::vector<Transition> transitions;

  [[nodiscard]] bool none() const { return base.number.none(); }
  [[nodiscard]] bool newer_than(const Course& other) const {
    return term != other.term ? term > other.term : revision > other.revision;
  }
  /// The pace axis as it is flown: with the stop at the end of the lease, once that has passed.
  [[nodiscard]] Pace flown_pace(SwarmTime now) const;
  [[nodiscard]] PlanMoment moment(SwarmTime now) const;
  /// Whether nothing moves at `now`, and nothing is going to.
  [[nodiscard]] bool rests(SwarmTime now) const { return flown_pace(now).rests(now); }
};

/// Whether both ask for the same motion, whoever wished it, under whatever number.
[[nodiscard]] bool same_motion(const Course& a, const Course& b);
/// All of it.
[[nodiscard]] bool operator==(const Course& a, const Course& b);

/// A carrier's slice of a plan, or nullptr where it is not held.
using SliceLookup = std::function<const mechanics::CarrierSlice*(const PlanNumber&)>;

/// The course's plan and transitions as layers, in seconds of plan time since `origin`. Empty when a slice is missing:
/// a course is flown whole or not at all.
[[nodiscard]] std::vector<mechanics::TimedLayer> layers(const Course& course, PlanTime origin,
                                                        const SliceLookup& lookup);

/// Every plan the course refers to, from the bottom up.
[[nodiscard]] std::vector<PlanNumber> plans_of(const Course& course);

/// Forgets what has passed: ramps, and what lies below a transition that is complete, whose plan becomes the base. True
/// if a transition was completed; the motion does not change by it.
bool settle(Course& course, SwarmTime now);

}  // namespace gyre::protocol
