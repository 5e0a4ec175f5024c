// Transitions: mixtures hold the load (docs/design.md, fact 3), their derivatives are exact from end to end, and the
// enclosures of their figures are proofs and tight.

#include "common/mechanics/transition.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/mechanics/grasp.hpp"
#include "common/mechanics/transition_figures.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/mechanics/track.hpp"

namespace gyre::mechanics::test {
namespace {

/// Plans that hold the same load, each coming in over the one below; carrier i's course is `layers(i)`.
struct Stack {
  std::vector<Plan> plans;
  std::vector<std::vector<CarrierSlice>> slices_of;
  std::vector<TimedLayer> times;

  void add(Plan plan, double epoch_s, double start_s, double duration_s) {
    slices_of.push_back(slices(plan));
    plans.push_back(std::move(plan));
    times.push_back({nullptr, epoch_s, start_s, duration_s});
  }
  [[nodiscard]] std::vector<TimedLayer> layers(std::size_t carrier) const {
    std::vector<TimedLayer> out = times;
    for (std::size_t i = 0; i < out.size(); ++i) out[i].slice = &slices_of[i][carrier];
    return out;
  }
  [[nodiscard]] std::size_t carriers() const { return plans.front().carriers.size(); }
};

Reference at(const std::vector<TimedLayer>& layers, double now_s) {
  return evaluate_course(layers.data(), layers.size(), now_s);
}

/// Transitions that overlap, between motions of different cycles, rates and length laws.
Stack random_stack(std::size_t count, std::size_t carriers_max = 5) {
  RandomPlan wish;
  wish.carriers_max = carriers_max;
  Stack stack;
  stack.add(random_plan(wish), real(-5.0, 5.0), 0.0, 0.0);
  for (std::size_t i = 1; i < count; ++i) {
    stack.add(random_motion(stack.plans.front()), real(-5.0, 5.0), real(0.0, 4.0), real(2.0, 8.0));
  }
  return stack;
}

// ------------------------------------------------------------------------------------------------------------ fact 3

RC_GTEST_PROP(Mixture, it_holds_the_load_at_every_moment_whatever_the_plans, ()) {
  const Stack stack = random_stack(whole(2, kMaxLayers), 12);
  const double now_s = real(-1.0, 13.0);
  std::vector<Eigen::Vector3d> forces;
  for (std::size_t i = 0; i < stack.carriers(); ++i) forces.push_back(at(stack.layers(i), now_s).force_w_n.value);
  const Plan& plan = stack.plans.front();
  const Vector6d weight = holding_wrench(plan.load.mass_kg, plan.gravity_m_s2);
  RC_ASSERT((wrench(plan, forces) - weight).norm() < 1e-12 * weight.norm());
}

RC_GTEST_PROP(Mixture, before_it_is_the_plan_below_and_after_the_plan_above, ()) {
  const Stack stack = random_stack(2);
  const TimedLayer& above = stack.times.back();
  for (std::size_t i = 0; i < stack.carriers(); ++i) {
    const double before_s = above.start_s - real(0.0, 3.0);
    const double after_s = above.start_s + above.duration_s + real(0.001, 3.0);
    const auto expect = [&](double now_s, std::size_t layer) {
      const Reference mixed = at(stack.layers(i), now_s);
      const Reference alone = evaluate(stack.slices_of[layer][i], now_s - stack.times[layer].epoch_s);
      RC_ASSERT(mixed.position_w_m.value == alone.position_w_m.value);
      RC_ASSERT(mixed.position_w_m.second == alone.position_w_m.second);
      RC_ASSERT(mixed.length_m.value == alone.length_m.value);
    };
    expect(before_s, 0);
    expect(after_s, 1);
  }
}

RC_GTEST_PROP(Mixture, a_complete_transition_hides_all_that_is_below, ()) {
  Stack stack = random_stack(3);
  stack.times[2].start_s = 20.0;
  stack.times[2].duration_s = 1.0;
  Stack top;
  top.add(stack.plans[2], stack.times[2].epoch_s, 0.0, 0.0);
  for (std::size_t i = 0; i < stack.carriers(); ++i) {
    const double now_s = 21.0 + real(0.0, 9.0);
    const Eigen::Vector3d difference =
        at(stack.layers(i), now_s).position_w_m.value - at(top.layers(i), now_s).position_w_m.value;
    RC_ASSERT(difference.norm() < 1e-12);
  }
}

RC_GTEST_PROP(Mixture, the_derivatives_are_exact_through_the_whole_transition_and_its_ends, ()) {
  const Stack stack = random_stack(whole(2, 3));
  const TimedLayer& top = stack.times.back();
  const double h = 2e-5;
  // The third derivative jumps where a transition starts or ends, by sixty gaps over T cubed: there a difference of
  // rates is off by its step times that, so its step has to be short.
  const double h_rate = 2e-6;
  for (const double share : {0.0, real(0.02, 0.98), 1.0}) {
    const double now_s = top.start_s + share * top.duration_s;
    for (std::size_t i = 0; i < stack.carriers(); ++i) {
      const std::vector<TimedLayer> layers = stack.layers(i);
      const Reference before = at(layers, now_s - h);
      const Reference now = at(layers, now_s);
      const Reference after = at(layers, now_s + h);
      const Reference just_before = at(layers, now_s - h_rate);
      const Reference just_after = at(layers, now_s + h_rate);
      const auto check = [](const auto& slope, const auto& derivative, double tolerance) {
        RC_ASSERT((slope - derivative).norm() < tolerance * (1.0 + derivative.norm()));
      };
      check((after.position_w_m.value - before.position_w_m.value) / (2.0 * h), now.position_w_m.first, 1e-5);
      check((after.direction_w.value - before.direction_w.value) / (2.0 * h), now.direction_w.first, 1e-5);
      check((after.force_w_n.value - before.force_w_n.value) / (2.0 * h), now.force_w_n.first, 1e-5);
      check((just_after.position_w_m.first - just_before.position_w_m.first) / (2.0 * h_rate), now.position_w_m.second,
            2e-2);
      check((just_after.force_w_n.first - just_before.force_w_n.first) / (2.0 * h_rate), now.force_w_n.second, 2e-2);
      RC_ASSERT(std::abs((after.length_m.value - before.length_m.value) / (2.0 * h) - now.length_m.first) <
                1e-5 * (1.0 + std::abs(now.length_m.first)));
    }
  }
}

RC_GTEST_PROP(Mixture, lengths_follow_each_law_on_the_mixed_direction, ()) {
  RandomPlan level;
  level.mixed_laws = false;
  const Plan below = random_plan(level);
  const Plan above = random_motion(below, false);
  Stack stack;
  stack.add(below, 0.0, 0.0, 0.0);
  stack.add(above, 0.0, 0.0, 4.0);
  const double now_s = real(0.0, 4.0);
  const double x = smooth_step(now_s, 4.0).value;
  for (std::size_t i = 0; i < stack.carriers(); ++i) {
    // Two altitudes: the carrier climbs from one to the other as the smooth step does, whatever its direction does.
    const double altitude = (1.0 - x) * below.carriers[i].law.profile.mean + x * above.carriers[i].law.profile.mean;
    RC_ASSERT(std::abs(at(stack.layers(i), now_s).position_w_m.value.z() - altitude) < 1e-11);
  }
}

// -------------------------------------------------------------------------------------------------------- enclosures

void check_figures(const Stack& stack, double begin_s, double end_s) {
  const std::vector<TimedLayer> layers = stack.layers(whole(0, stack.carriers() - 1));
  const CarrierFigures claim = transition_figures(layers, begin_s, end_s);
  Track tension, length, winch_rate, speed, acceleration, altitude, vertical;
  double grip = 1.0;  // of the laws that project, on the mixed direction
  sample(begin_s, end_s, 2000, [&](double t_s) {
    const Reference r = at(layers, t_s);
    tension.add(r.tension_n.value);
    length.add(r.length_m.value);
    winch_rate.add(r.length_m.first);
    speed.add(r.position_w_m.first.norm());
    acceleration.add(r.position_w_m.second.norm());
    altitude.add(r.position_w_m.value.z());
    vertical.add(r.direction_w.value.z());
    for (const TimedLayer& layer : layers) {
      const LengthLaw& law = layer.slice->law;
      if (law.is_projection()) grip = std::min(grip, law.direction.dot(r.direction_w.value));
    }
  });
  // A mixed direction may lose the grip that each plan has: lengths run away there, and claims may be loose, or
  // infinite, but never wrong.
  const double loose = grip < 0.5 ? std::numeric_limits<double>::infinity() : 0.0;
  const auto check = [loose](const Track& track, const Range& range, double slack) {
    check_holds(track, range, 1.001 * slack + loose);
  };
  check(tension, claim.tension_n, kTransitionSlack * tension.size());
  check(length, claim.length_m, kTransitionSlack * length.size());
  check(winch_rate, claim.winch_rate_m_s, kTransitionSlack * std::max(winch_rate.size(), speed.size()));
  check(speed, claim.speed_m_s, kTransitionSlack * speed.size());
  // Safe always; how tight depends on how wildly random plans are mixed (see the paper's engagement below).
  check_holds(acceleration, {acceleration.range().min, claim.acceleration_max_m_s2},
              std::numeric_limits<double>::infinity());
  check(altitude, claim.altitude_m, kTransitionSlack * std::max(altitude.size(), length.size()));
  check(vertical, claim.vertical_cosine, kTransitionSlack * vertical.size());
}

RC_GTEST_PROP(TransitionFigures, they_hold_every_sample_and_are_tight, ()) {
  const Stack stack = random_stack(2, 3);
  const TimedLayer& top = stack.times.back();
  check_figures(stack, top.start_s, top.start_s + top.duration_s);
}

RC_GTEST_PROP(TransitionFigures, they_do_so_for_three_layers_that_overlap, ()) {
  const Stack stack = random_stack(3, 3);
  check_figures(stack, -0.5, 12.5);
}

TEST(TransitionFigures, a_change_of_the_papers_motion_is_tight_in_its_acceleration_too) {
  Plan headings = paper_plan();
  take_edge_headings(headings);
  Stack stack;
  stack.add(headings, 0.0, 0.0, 0.0);
  stack.add(paper_plan(), 0.0, 0.0, 20.0);
  for (std::size_t i = 0; i < stack.carriers(); ++i) {
    double sampled = 0.0;
    sample(0.0, 20.0, 20000,
           [&](double t_s) { sampled = std::max(sampled, at(stack.layers(i), t_s).position_w_m.second.norm()); });
    const double claim = transition_figures(stack.layers(i), 0.0, 20.0).acceleration_max_m_s2;
    EXPECT_GE(claim, sampled);
    EXPECT_LE(claim, sampled * (1.0 + kAccelerationSlack) * (1.0 + 1e-4));
  }
}

TEST(TransitionFigures, a_carrier_that_does_not_move_has_figures_without_width) {
  const Plan rest = still_plan(paper_plan(), 1.0);
  Stack stack;
  stack.add(rest, 0.0, 0.0, 0.0);
  stack.add(rest, 3.0, 1.0, 5.0);
  for (std::size_t i = 0; i < stack.carriers(); ++i) {
    const CarrierFigures f = transition_figures(stack.layers(i), 0.0, 7.0);
    const Reference r = at(stack.layers(i), 3.0);
    const auto expect = [](const Range& range, double value) {
      EXPECT_NEAR(range.min, value, 1e-12 + kTransitionSlack * std::abs(value));
      EXPECT_NEAR(range.max, value, 1e-12 + kTransitionSlack * std::abs(value));
    };
    expect(f.tension_n, r.tension_n.value);
    expect(f.length_m, r.length_m.value);
    expect(f.altitude_m, r.position_w_m.value.z());
    expect(f.vertical_cosine, r.direction_w.value.z());
    EXPECT_LT(f.speed_m_s.max, 1e-12);
  }
}

TEST(TransitionFigures, a_cable_through_the_horizontal_has_no_bounded_length) {
  // One carrier holds from above, then from below: the level law loses its grip half-way.
  Plan above = polygon_plan(3);
  Plan below = above;
  const double push = 40.0;  // edges in a vertical plane would do; offsets along a tilted triangle turn a cable over
  above.load.orientation_w_b = below.load.orientation_w_b = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX());
  for (Edge& edge : above.cycle.edges) edge.offset_n = push;
  for (Edge& edge : below.cycle.edges) edge.offset_n = -push;
  Stack stack;
  stack.add(above, 0.0, 0.0, 0.0);
  stack.add(below, 0.0, 0.0, 5.0);
  int turned_over = 0;
  for (std::size_t i = 0; i < stack.carriers(); ++i) {
    const CarrierFigures f = transition_figures(stack.layers(i), 0.0, 5.0);
    for (const double figure :
         {f.tension_n.min, f.tension_n.max, f.length_m.min, f.length_m.max, f.speed_m_s.min, f.speed_m_s.max,
          f.winch_rate_m_s.min, f.winch_rate_m_s.max, f.altitude_m.min, f.altitude_m.max, f.acceleration_max_m_s2}) {
      EXPECT_FALSE(std::isnan(figure));
    }
    if (f.vertical_cosine.min > 0.0 || f.vertical_cosine.max < 0.0) continue;
    ++turned_over;
    EXPECT_EQ(f.length_m.max, std::numeric_limits<double>::infinity());
  }
  EXPECT_GT(turned_over, 0);
}

}  // namespace
}  // namespace gyre::mechanics::test
