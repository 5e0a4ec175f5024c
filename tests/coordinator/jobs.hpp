#pragma once
// What the coordinator's tests let be flown, and what has to hold at every beacon of every flight.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "common/protocol/sanity.hpp"
#include "coordinator/core/coordinator.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::coordinator::test {

/// Carriers on a polygon, and nothing else that matters.
inline Job job(std::size_t carriers = 4) {
  Job job;
  job.name = "polygon";
  job.plan = mechanics::test::polygon_plan(carriers);
  return job;
}

/// The same load in another motion.
inline Job faster() {
  Job faster = job();
  faster.name = "faster";
  faster.plan.cycle.rate_rad_s *= 1.2;
  return faster;
}

/// A motion in which a swing grows at 0.6 to 0.8 of its pace.
inline Job swinging(Job job) {
  job.swings = mechanics::Swings{-0.01, -0.005, {{0.0, 0.0}, {0.6, 0.05}, {0.8, 0.02}, {0.9, -0.01}, {1.0, -0.01}}};
  return job;
}

inline CoordinatorOptions engaging() {
  CoordinatorOptions options;
  options.engage_when_ready = true;
  return options;
}

inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// What came of a command, in words.
inline std::string the_one_answer(const std::vector<protocol::CommandReply>& replies, std::uint64_t command) {
  std::string text;
  int answers = 0;
  for (const protocol::CommandReply& reply : replies) {
    if (reply.id == command) ++answers, text = (reply.done ? "done: " : "refused: ") + reply.text;
  }
  return answers == 1 ? text : "answered " + std::to_string(answers) + " times";
}

/// The same event where the clock that stamps what arrives leapt.
inline Event by_a_clock_that_leapt(Event event, Duration leapt) {
  if (auto* said = std::get_if<StatusArrived>(&event)) said->arrived += leapt;
  if (auto* asked = std::get_if<TimeRequestArrived>(&event)) asked->arrived += leapt;
  return event;
}

/// What has to hold from one beacon to the next.
inline void check_invariants(const std::optional<protocol::Beacon>& before, const protocol::Beacon& b,
                             const protocol::Silence& silence) {
  constexpr Duration kRounding(2);
  const protocol::Course& course = b.course;
  EXPECT_TRUE(sane(b));
  EXPECT_EQ(course.term, b.term);
  EXPECT_LE(course.pace.ramps.size(), protocol::kMaxRamps);
  EXPECT_LE(course.transitions.size(), protocol::kMaxTransitions);
  const protocol::PlanMoment now = course.moment(b.swarm_time);
  EXPECT_GE(now.pace, -0.1);
  EXPECT_LE(now.pace, 1.1);
  if (b.proposal) {
    EXPECT_EQ(b.proposal->term, b.term);
    EXPECT_TRUE(b.proposal->newer_than(course)) << b.proposal->revision << " after " << course.revision;
    EXPECT_LE(b.proposal->pace.ramps.size(), protocol::kMaxRamps);
    EXPECT_LE(b.proposal->transitions.size(), protocol::kMaxTransitions);
  }
  if (course.lease && silence.stop_after) {
    EXPECT_LE(*course.lease - b.swarm_time, *silence.stop_after);
  }
  if (!before) return;
  EXPECT_GE(b.term, before->term);
  if (b.term == before->term) {
    EXPECT_GT(b.sequence, before->sequence);
    EXPECT_GE(course.revision, before->course.revision);
    if (course.revision == before->course.revision) {
      EXPECT_TRUE(course.wish == before->course.wish);
    }
  }
  // Plan time goes on from where it was, whatever was decided: no faster than its pace may be, and by what was known.
  const Duration passed = b.swarm_time - before->swarm_time;
  const Duration gone = now.at - before->course.moment(before->swarm_time).at;
  EXPECT_LE((gone - passed - passed / 10).count(), kRounding.count());
  EXPECT_GE((gone + passed / 10).count(), -kRounding.count());
  const Duration off = now.at - before->course.moment(b.swarm_time).at;
  EXPECT_LE(std::abs(off.count()), kRounding.count());
}

/// The beacons of one swarm.
class Said {
 public:
  void check(const protocol::Beacon& b, const protocol::Silence& silence) {
    if (last_ && last_->term != b.term) by_revision_.clear();
    // What was said already may be said again, in the place of what nobody has begun.
    const auto again = by_revision_.find(b.course.revision);
    check_invariants(again == by_revision_.end() ? last_ : again->second, b, silence);
    by_revision_[b.course.revision] = last_ = b;
  }

 private:
  std::optional<protocol::Beacon> last_;
  std::map<std::uint64_t, std::optional<protocol::Beacon>> by_revision_;  ///< in this term, the last of each
};

/// Whoever is to fly a course was offered all that is in it.
inline void check_that_plans_are_offered(const protocol::Beacon& b, const protocol::PlanOffer& offer) {
  std::vector<protocol::PlanNumber> plans = protocol::plans_of(b.course);
  if (b.proposal) plans.push_back(protocol::plans_of(*b.proposal).back());
  for (const protocol::PlanNumber& number : plans) {
    const auto same = [&](const protocol::NumberedSlice& s) { return s.number == number; };
    EXPECT_TRUE(std::any_of(offer.slices.begin(), offer.slices.end(), same)) << "a plan of the course is not offered";
  }
}

}  // namespace gyre::coordinator::test
