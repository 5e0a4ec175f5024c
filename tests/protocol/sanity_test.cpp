// Nonsense is refused field by field; what an honest process says is not.

#include "common/protocol/sanity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "paces.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::protocol {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr SwarmTime kNever{Duration::max()};

constexpr PlanTime kNeverPlanned{Duration::max()};

Course good_course() {
  Course course;
  course.term = 1;
  course.revision = 3;
  course.wish = {1.0, false, Wisher::kPerson};
  course.pace = test::constant_pace(0.0).with_ramp(test::kAxisBegin, std::chrono::seconds(5), 1.0);
  course.pace = course.pace.with_ramp(test::kAxisBegin + std::chrono::seconds(1), std::chrono::seconds(2), 0.5);
  course.lease = test::kAxisBegin + std::chrono::seconds(9);
  course.base = {{1, 1}, PlanTime(Duration(5))};
  course.transitions = {{{{1, 2}, {}}, {}, std::chrono::seconds(5)}};
  return course;
}
Beacon good_beacon() {
  Beacon beacon;
  beacon.term = beacon.sequence = 1;
  beacon.course = good_course();
  beacon.proposal = good_course();
  return beacon;
}
PlanOffer good_offer() {
  const auto slice = mechanics::slices(mechanics::test::polygon_plan(3))[0];
  return {slice.id, 1, 1, {{{1, 1}, slice}}, {}};
}
AgentStatus good_status() {
  AgentStatus s;
  s.carrier = 1;
  s.term = 1;
  s.clock_uncertainty = Duration::max();  // before the first exchange
  s.course = good_course();
  return s;
}
CarrierState good_state() {
  CarrierState s;
  s.carrier = kMaxCarrierId;
  return s;
}

template <class Message>
using Breakages = std::vector<std::function<void(Message&)>>;

template <class Message>
void expect_each_refused(const Message& good, const Breakages<Message>& breakages) {
  EXPECT_TRUE(sane(good));
  for (std::size_t i = 0; i < breakages.size(); ++i) {
    Message broken = good;
    breakages[i](broken);
    EXPECT_FALSE(sane(broken)) << "breakage " << i;
  }
}

/// The numbers no quantity can have.
template <class Message>
void expect_numbers_refused(const Message& good, const std::vector<std::function<double&(Message&)>>& fields) {
  for (const double nonsense : {kNan, kInfinity, -kInfinity, 1e8, -1e8}) {
    Breakages<Message> breakages;
    for (const auto& field : fields) breakages.push_back([&field, nonsense](Message& m) { field(m) = nonsense; });
    expect_each_refused(good, breakages);
  }
}

TEST(Sanity, Beacon) {
  expect_each_refused<Beacon>(good_beacon(), {
                                                 [](Beacon& b) { b.swarm_time = kNever; },
                                                 [](Beacon& b) { b.skew_budget = Duration(-1); },
                                                 [](Beacon& b) { b.skew_budget = Duration::max(); },
                                             });
  Beacon alone = good_beacon();
  alone.proposal.reset();
  EXPECT_TRUE(sane(alone)) << "most of the time nothing is proposed";
}

/// A course that is nonsense makes nonsense of whatever carries it.
void expect_each_course_refused(const Breakages<Course>& breakages) {
  for (const Breakages<Course>::value_type& breakage : breakages) {
    expect_each_refused<Beacon>(good_beacon(), {
                                                   [&](Beacon& b) { breakage(b.course); },
                                                   [&](Beacon& b) { breakage(*b.proposal); },
                                               });
    expect_each_refused<AgentStatus>(good_status(), {[&](AgentStatus& s) { breakage(s.course); }});
  }
}

TEST(Sanity, CoursesTransitions) {
  expect_each_course_refused({
      [](Course& c) { c.base.epoch = kNeverPlanned; },
      [](Course& c) { c.base.epoch = PlanTime(-kLongest / 2 - Duration(1)); },
      [](Course& c) { c.transitions[0].to.number = {}; },
      [](Course& c) { c.transitions[0].to.epoch = kNeverPlanned; },
      [](Course& c) { c.transitions[0].start = kNeverPlanned; },
      [](Course& c) { c.transitions[0].start = PlanTime(Duration::min()); },
      [](Course& c) { c.transitions[0].duration = Duration::zero(); },
      [](Course& c) { c.transitions[0].duration = Duration(-1); },
      [](Course& c) { c.transitions[0].duration = Duration::max(); },
      [](Course& c) { c.transitions.resize(kMaxTransitions + 1, c.transitions[0]); },
  });
}

TEST(Sanity, CoursesWishAndLease) {
  expect_each_course_refused({
      [](Course& c) { c.wish.pace = -1e-9; },
      [](Course& c) { c.wish.pace = 1.0 + 1e-9; },
      [](Course& c) { c.wish.pace = kNan; },
      [](Course& c) { c.wish.pace = kInfinity; },
      [](Course& c) { c.wish.by = static_cast<Wisher>(0); },
      [](Course& c) { c.wish.by = static_cast<Wisher>(6); },
      [](Course& c) { c.lease = kNever; },
      [](Course& c) { c.lease = SwarmTime(Duration::min()); },
      [](Course& c) { c.stopping = Duration::zero(); },
      [](Course& c) { c.stopping = Duration(-1); },
      [](Course& c) { c.stopping = Duration::max(); },
      [](Course& c) { c.stopping = Duration::min(); },
  });
  Beacon for_ever = good_beacon();
  for_ever.course.lease.reset();
  EXPECT_TRUE(sane(for_ever));
}

TEST(Sanity, CoursesRamps) {
  Breakages<Course> breakages{
      [](Course& c) { c.pace.ramps.clear(); },
      [](Course& c) {
        while (c.pace.ramps.size() <= kMaxRamps) {
          c.pace.ramps.push_back(c.pace.ramps.back());
          c.pace.ramps.back().start += Duration(1);
        }
      },
      [](Course& c) { c.pace.ramps[1].start = c.pace.ramps[0].start; },
      [](Course& c) { std::swap(c.pace.ramps[0], c.pace.ramps[1]); },
      [](Course& c) { c.pace.ramps[0].start = SwarmTime(Duration::min()); },
      [](Course& c) { c.pace.ramps[1].start = kNever; },
      [](Course& c) { c.pace.ramps[1].duration = Duration::max(); },
      [](Course& c) { c.pace.ramps[1].duration = Duration(-1); },
      [](Course& c) { c.pace.ramps[1].duration = Duration::min(); },
      [](Course& c) { c.pace.ramps[1].duration = Duration::zero(); },  // there at once, but it was elsewhere
      [](Course& c) { c.pace.ramps[1].from.at = kNeverPlanned; },
      [](Course& c) { c.pace.ramps[1].from.at = PlanTime(kLongest / 2 + Duration(1)); },
      [](Course& c) { c.pace.ramps[1].from.pace = 2.01; },
      [](Course& c) { c.pace.ramps[1].from.pace = -2.01; },
      [](Course& c) { c.pace.ramps[1].from.rate_1_s = 101.0; },
      [](Course& c) { c.pace.ramps[1].from.rate_1_s = -101.0; },
      [](Course& c) { c.pace.ramps[1].from.curvature_1_s2 = 1.01e4; },
      [](Course& c) { c.pace.ramps[1].from.curvature_1_s2 = -1.01e4; },
      [](Course& c) { c.pace.ramps[1].target = 1.01; },
      [](Course& c) { c.pace.ramps[1].target = -1.01; },
  };
  for (const double nonsense : {kNan, kInfinity, -kInfinity, 1e300}) {
    breakages.push_back([nonsense](Course& c) { c.pace.ramps[1].from.pace = nonsense; });
    breakages.push_back([nonsense](Course& c) { c.pace.ramps[1].from.rate_1_s = nonsense; });
    breakages.push_back([nonsense](Course& c) { c.pace.ramps[1].from.curvature_1_s2 = nonsense; });
    breakages.push_back([nonsense](Course& c) { c.pace.ramps[1].target = nonsense; });
  }
  expect_each_course_refused(breakages);
}

TEST(Sanity, OnlyAConstantPaceIsThereAtOnce) {
  Beacon beacon = good_beacon();
  beacon.course.pace = test::constant_pace(0.5);
  EXPECT_TRUE(sane(beacon));
  for (double PlanMoment::*figure : {&PlanMoment::pace, &PlanMoment::rate_1_s, &PlanMoment::curvature_1_s2}) {
    Beacon broken = beacon;
    broken.course.pace.ramps[0].from.*figure += 1e-9;
    EXPECT_FALSE(sane(broken));
  }
}

RC_GTEST_PROP(Sanity, EveryAxisOfOursIsSane, ()) {
  Beacon beacon = good_beacon();
  beacon.course.pace = test::random_axis(3);
  RC_PRE(beacon.course.pace.ramps.size() <= kMaxRamps);
  RC_ASSERT(sane(beacon));
  (void)settle(beacon.course, test::kAxisBegin + test::random_duration(0.0, 30.0));
  RC_ASSERT(sane(beacon));
}

/// One of the numbers that are sane, extremes more often than not.
double extreme(double most) {
  return *rc::gen::element(-most, most, 0.0, test::real(-most, most));
}
Duration extreme(Duration most) {
  return *rc::gen::element(-most, most, Duration(1), from_seconds(test::real(0.0, 100.0)));
}

// Whoever hears it evaluates it before anybody has confirmed anything. ASan's build would see a sum that overflows.
RC_GTEST_PROP(Sanity, WhatIsSaneCanBeEvaluatedAtAnyUsableTime, ()) {
  Beacon beacon = good_beacon();
  Course& course = beacon.course;
  course.pace.ramps.clear();
  for (int i = test::whole(1, 3); i > 0; --i) {
    Ramp ramp;
    ramp.start = SwarmTime(extreme(kLongest));
    ramp.duration = extreme(kLongest);
    ramp.from = {PlanTime(extreme(kLongest / 2)), extreme(2.0), extreme(100.0), extreme(1e4)};
    ramp.target = extreme(1.0);
    course.pace.ramps.push_back(ramp);
  }
  std::sort(course.pace.ramps.begin(), course.pace.ramps.end(),
            [](const Ramp& a, const Ramp& b) { return a.start < b.start; });
  course.lease = SwarmTime(extreme(kLongest));
  course.stopping = extreme(kLongest);
  course.base.epoch = PlanTime(extreme(kLongest / 2));
  RC_PRE(sane(beacon));
  for (const SwarmTime t : {SwarmTime(-kLongest), SwarmTime{}, SwarmTime(extreme(kLongest)), SwarmTime(kLongest)}) {
    const PlanMoment moment = course.moment(t);
    RC_ASSERT(std::isfinite(moment.pace) && std::isfinite(moment.rate_1_s) && std::isfinite(moment.curvature_1_s2));
    // Also as far from an epoch as that may be.
    const double since_epoch = static_cast<double>(moment.at.time_since_epoch().count()) -
                               static_cast<double>(course.base.epoch.time_since_epoch().count());
    RC_ASSERT(std::abs(since_epoch) < 4.0 * static_cast<double>(kLongest.count()));
    Course settled = course;
    (void)settle(settled, t);
  }
}

TEST(Sanity, PlanOffer) {
  const auto slice = [](PlanOffer& o) -> mechanics::CarrierSlice& { return o.slices[0].slice; };
  expect_each_refused<PlanOffer>(
      good_offer(),
      {
          [](PlanOffer& o) { o.carrier = 0; },
          [](PlanOffer& o) { o.carrier = kMaxCarrierId + 1; },
          [](PlanOffer& o) { o.slices[0].number = {}; },
          [](PlanOffer& o) { o.slices.resize(kMaxPlans + 1, o.slices[0]); },
          [&](PlanOffer& o) { ++slice(o).id; },
          [&](PlanOffer& o) { slice(o).rate_rad_s = 0.0; },
          [&](PlanOffer& o) { slice(o).cable_stiffness_n_m = -1.0; },
          [&](PlanOffer& o) { slice(o).winch_lag_s = -0.1; },
          [&](PlanOffer& o) { slice(o).vehicle_lag_s = -0.1; },
          [&](PlanOffer& o) { slice(o).incoming.direction *= 2.0; },
          [&](PlanOffer& o) { slice(o).law.direction.setZero(); },
          [&](PlanOffer& o) { slice(o).law.profile.harmonic.denominator = 0; },
          [&](PlanOffer& o) { slice(o).law.profile.harmonic.denominator = mechanics::kMaxDenominator + 1; },
          [&](PlanOffer& o) { slice(o).law.profile.harmonic.numerator = -1; },
          [&](PlanOffer& o) { slice(o).law.profile.harmonic.numerator = 0; },
          [&](PlanOffer& o) { slice(o).law.profile.harmonic.numerator = mechanics::kMaxNumerator + 1; },
          [&](PlanOffer& o) { slice(o).law.profile.harmonic.numerator = 1 << 20; },
      });
  expect_numbers_refused<PlanOffer>(good_offer(),
                                    {
                                        [&](PlanOffer& o) -> double& { return slice(o).attachment_w_m.y(); },
                                        [&](PlanOffer& o) -> double& { return slice(o).particular_force_w_n.z(); },
                                        [&](PlanOffer& o) -> double& { return slice(o).incoming.direction.x(); },
                                        [&](PlanOffer& o) -> double& { return slice(o).incoming.offset_n; },
                                        [&](PlanOffer& o) -> double& { return slice(o).outgoing.amplitude_n; },
                                        [&](PlanOffer& o) -> double& { return slice(o).outgoing.phase_rad; },
                                        [&](PlanOffer& o) -> double& { return slice(o).rate_rad_s; },
                                        [&](PlanOffer& o) -> double& { return slice(o).law.direction.z(); },
                                        [&](PlanOffer& o) -> double& { return slice(o).law.profile.mean; },
                                        [&](PlanOffer& o) -> double& { return slice(o).law.profile.swing; },
                                        [&](PlanOffer& o) -> double& { return slice(o).law.profile.phase_rad; },
                                        [&](PlanOffer& o) -> double& { return slice(o).cable_stiffness_n_m; },
                                        [&](PlanOffer& o) -> double& { return slice(o).winch_lag_s; },
                                        [&](PlanOffer& o) -> double& { return slice(o).vehicle_lag_s; },
                                    });
}

TEST(Sanity, AgentStatus) {
  expect_each_refused<AgentStatus>(good_status(), {
                                                      [](AgentStatus& s) { s.carrier = 0; },
                                                      [](AgentStatus& s) { s.state = static_cast<AgentState>(0); },
                                                      [](AgentStatus& s) { s.state = static_cast<AgentState>(9); },
                                                      [](AgentStatus& s) { s.swarm_time = kNever; },
                                                      [](AgentStatus& s) { s.clock_uncertainty = Duration(-1); },
                                                      [](AgentStatus& s) { s.clock_drift_ppm = kNan; },
                                                      [](AgentStatus& s) { s.accepted.resize(kMaxPlans + 1); },
                                                  });
}

TEST(Sanity, CountsThatNobodyHasComeTo) {
  for (const std::uint64_t most : {std::numeric_limits<std::uint64_t>::max(), (std::uint64_t{1} << 48) + 1}) {
    expect_each_refused<Beacon>(good_beacon(), {
                                                   [&](Beacon& b) { b.sequence = most; },
                                                   [&](Beacon& b) { b.term = b.course.term = b.proposal->term = most; },
                                                   [&](Beacon& b) { b.course.revision = most; },
                                                   [&](Beacon& b) { b.proposal->revision = most; },
                                                   [&](Beacon& b) { b.course.base.number.revision = most; },
                                                   [&](Beacon& b) { b.course.transitions[0].to.number.term = most; },
                                               });
    expect_each_refused<PlanOffer>(good_offer(), {
                                                     [&](PlanOffer& o) { o.sequence = most; },
                                                     [&](PlanOffer& o) { o.term = most; },
                                                     [&](PlanOffer& o) { o.slices[0].number.revision = most; },
                                                 });
    expect_each_refused<AgentStatus>(good_status(), {
                                                        [&](AgentStatus& s) { s.sequence = most; },
                                                        [&](AgentStatus& s) { s.term = most; },
                                                        [&](AgentStatus& s) { s.confirmed = most; },
                                                        [&](AgentStatus& s) { s.beacons_received = most; },
                                                        [&](AgentStatus& s) { s.course.revision = most; },
                                                        [&](AgentStatus& s) {
                                                          s.accepted = {{1, most}};
                                                        },
                                                        [&](AgentStatus& s) {
                                                          s.refused = {most, 1};
                                                        },
                                                    });
  }
  expect_each_refused<AgentStatus>(good_status(), {
                                                      [](AgentStatus& s) { s.course.term = s.term + 1; },
                                                      [](AgentStatus& s) { s.clock_drift_ppm = 1e6; },
                                                  });
}

TEST(Sanity, States) {
  expect_each_refused<CarrierState>(good_state(), {[](CarrierState& s) { s.carrier = 0; }});
  expect_numbers_refused<CarrierState>(good_state(),
                                       {
                                           [](CarrierState& s) -> double& { return s.position_w_m.x(); },
                                           [](CarrierState& s) -> double& { return s.velocity_w_m_s.y(); },
                                           [](CarrierState& s) -> double& { return s.tension_n; },
                                           [](CarrierState& s) -> double& { return s.cable_length_m; },
                                           [](CarrierState& s) -> double& { return s.winch_length_m; },
                                           [](CarrierState& s) -> double& { return s.winch_rate_m_s; },
                                       });
  expect_numbers_refused<LoadState>({}, {
                                            [](LoadState& s) -> double& { return s.position_w_m.x(); },
                                            [](LoadState& s) -> double& { return s.velocity_w_m_s.y(); },
                                            [](LoadState& s) -> double& { return s.orientation_w_b.x(); },
                                            [](LoadState& s) -> double& { return s.angular_velocity_b_rad_s.z(); },
                                        });
}

TEST(Sanity, Disturbance) {
  Disturbance good;
  good.process = "agent 3";
  expect_each_refused<Disturbance>(good, {
                                             [](Disturbance& d) { d.process.assign(kMaxTextBytes + 1, 'x'); },
                                             [](Disturbance& d) { d.kind = static_cast<DisturbanceKind>(0); },
                                             [](Disturbance& d) { d.kind = static_cast<DisturbanceKind>(4); },
                                             [](Disturbance& d) { d.share = -0.1; },
                                             [](Disturbance& d) { d.share = 1.1; },
                                             [](Disturbance& d) { d.shift = Duration::min(); },
                                             [](Disturbance& d) { d.shift = Duration::max(); },
                                             [](Disturbance& d) { d.duration = Duration(-1); },
                                             [](Disturbance& d) { d.duration = Duration::max(); },
                                         });
  expect_numbers_refused<Disturbance>(good, {
                                                [](Disturbance& d) -> double& { return d.share; },
                                                [](Disturbance& d) -> double& { return d.force_w_n.y(); },
                                            });
}

RC_GTEST_PROP(Sanity, EveryPlanOfOursIsSane, ()) {
  for (const mechanics::CarrierSlice& slice : mechanics::slices(mechanics::test::random_plan())) {
    RC_ASSERT(sane(PlanOffer{slice.id, 1, 1, {{{1, 1}, slice}}, {}}));
  }
}

RC_GTEST_PROP(Sanity, BitsThatFlipAreRefusedOrHarmless, (std::uint64_t bits)) {
  PlanOffer offer = good_offer();
  double& field = offer.slices[0].slice.law.profile.mean;
  static_assert(sizeof field == sizeof bits);
  std::memcpy(&field, &bits, sizeof bits);
  RC_ASSERT(sane(offer) == (std::isfinite(field) && std::abs(field) <= 1e7));
}

}  // namespace
}  // namespace gyre::protocol
