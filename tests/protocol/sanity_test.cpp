// Nonsense is refused field by field; what an honest process says is not.

#include "common/protocol/sanity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "tests/mechanics/plans.hpp"

namespace gyre::protocol {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr SwarmTime kNever{Duration::max()};

Course good_course() {
  return {3, {{1, 1}, SwarmTime(Duration(5))}, {{1, {{1, 2}, {}}, {}, std::chrono::seconds(5), Stage::kGo}}};
}
Beacon good_beacon() {
  return {1, 1, {}, good_course()};
}
PlanOffer good_offer() {
  const auto slice = mechanics::slices(mechanics::test::polygon_plan(3))[0];
  return {slice.id, 1, {{{1, 1}, slice}}};
}
AgentStatus good_status() {
  AgentStatus s;
  s.carrier = 1;
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
  expect_each_refused<Beacon>(
      good_beacon(), {
                         [](Beacon& b) { b.swarm_time = kNever; },
                         [](Beacon& b) { b.skew_budget = Duration(-1); },
                         [](Beacon& b) { b.skew_budget = Duration::max(); },
                         [](Beacon& b) { b.course.base.epoch = kNever; },
                         [](Beacon& b) { b.course.transitions[0].to.number = {}; },
                         [](Beacon& b) { b.course.transitions[0].to.epoch = kNever; },
                         [](Beacon& b) { b.course.transitions[0].start = kNever; },
                         [](Beacon& b) { b.course.transitions[0].duration = Duration::zero(); },
                         [](Beacon& b) { b.course.transitions[0].duration = Duration::max(); },
                         [](Beacon& b) { b.course.transitions[0].stage = static_cast<Stage>(7); },
                         [](Beacon& b) { b.course.transitions.resize(kMaxTransitions + 1, b.course.transitions[0]); },
                     });
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
                                                      [](AgentStatus& s) { s.course.base.epoch = kNever; },
                                                      [](AgentStatus& s) { s.accepted.resize(kMaxPlans + 1); },
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

RC_GTEST_PROP(Sanity, EveryPlanOfOursIsSane, ()) {
  for (const mechanics::CarrierSlice& slice : mechanics::slices(mechanics::test::random_plan())) {
    RC_ASSERT(sane(PlanOffer{slice.id, 1, {{{1, 1}, slice}}}));
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
