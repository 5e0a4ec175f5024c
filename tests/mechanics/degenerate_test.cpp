// Plans at the edge of sense: nothing hangs, nothing crashes, no figure is NaN. And what there is no sense in asking.

#include <gtest/gtest.h>

#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/transition.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

/// Lengths, rates, speeds, altitudes may be infinite where a law has no bounded length; everything else is finite.
Certificate expect_numbers(const Plan& plan) {
  for (const bool non_stop : {true, false}) {
    const Certificate c = certify(plan, {true, true, non_stop});
    EXPECT_TRUE(!c.separation || std::isfinite(c.separation->min_m));
    EXPECT_EQ(c.skew.has_value(), c.stiffness_min_1_s2.has_value());
    EXPECT_FALSE(c.swings && !c.stiffness_min_1_s2);
    if (c.swings) {
      EXPECT_TRUE(std::isfinite(c.swings->growth_1_s) && std::isfinite(c.swings->worst_1_s));
      for (const PaceGrowth& p : c.swings->paces) EXPECT_TRUE(std::isfinite(p.growth_1_s)) << p.pace;
    }
    if (c.skew) {
      for (const double x : {*c.stiffness_min_1_s2, c.skew->residual_n_per_s, c.skew->budget_s,
                             c.skew->displacement_m_per_s, c.skew->holdover_s}) {
        EXPECT_FALSE(std::isnan(x));
      }
    }
    EXPECT_TRUE(std::isfinite(c.period_s));
    EXPECT_TRUE(std::isfinite(c.wrench_error_max_n));
    for (const CarrierFigures& f : c.carriers) {
      for (const Range& r : {f.length_m, f.winch_rate_m_s, f.speed_m_s, f.altitude_m}) EXPECT_LE(r.min, r.max);
      for (const Range& r : {f.tension_n, f.vertical_cosine}) {
        EXPECT_TRUE(std::isfinite(r.min) && std::isfinite(r.max));
        EXPECT_LE(r.min, r.max);
      }
      EXPECT_FALSE(std::isnan(f.acceleration_max_m_s2));
      EXPECT_FALSE(std::isnan(f.direction_cosine_min.value_or(0.0)));
    }
  }
  return certify(plan);
}

TEST(Degenerate, what_is_left_out_or_has_no_value_is_absent) {
  const Certificate whole = certify(paper_plan());
  EXPECT_TRUE(whole.separation && whole.stiffness_min_1_s2 && whole.skew);
  const Certificate no_pairs = certify(paper_plan(), {false, true, true});
  EXPECT_TRUE(!no_pairs.separation && no_pairs.stiffness_min_1_s2 && no_pairs.skew);
  const Certificate no_stiffness = certify(paper_plan(), {true, false, true});
  EXPECT_TRUE(no_stiffness.separation && !no_stiffness.stiffness_min_1_s2 && !no_stiffness.skew);

  Plan perpendicular = paper_plan();
  perpendicular.carriers[2].law = LengthLaw::directional(Eigen::Vector3d::UnitX(), {5.0, 0.0, {}, 0.0});
  const Certificate unbounded = certify(perpendicular);
  EXPECT_FALSE(unbounded.separation || unbounded.stiffness_min_1_s2 || unbounded.skew);
}

TEST(Degenerate, any_number_of_carriers) {
  for (const std::size_t n : {3U, 4U, 16U, 64U}) EXPECT_TRUE(expect_numbers(polygon_plan(n)).admissible()) << n;
  Plan pair = reference_plan("pair-unrestricted");
  pair.cycle.edges[0].offset_n = 8.0;  // or its cables would cross
  for (const Reason& reason : expect_numbers(pair).reasons) {
    EXPECT_EQ(reason.rule, Rule::kSwing) << reason.text;  // the reference has no moments of inertia
  }
  Plan single = polygon_plan(3);
  single.carriers.resize(1);
  single.carriers[0].attachment_b_m = Eigen::Vector3d::Zero();
  single.cycle.edges.clear();
  EXPECT_FALSE(expect_numbers(single).admissible());
}

TEST(Degenerate, attachments_in_one_line_and_in_one_point) {
  Plan plan = polygon_plan(4);
  for (Carrier& carrier : plan.carriers) carrier.attachment_b_m.y() = 0.0;
  expect_numbers(plan);
  for (Carrier& carrier : plan.carriers) carrier.attachment_b_m = {0.0, 0.0, 0.3};
  const Certificate one_point = expect_numbers(plan);
  EXPECT_FALSE(one_point.admissible());
  EXPECT_EQ(one_point.separation->min_m, 0.0);  // the carriers coincide for all time
}

TEST(Degenerate, no_amplitude_equal_phases_and_no_motion_at_all) {
  Plan plan = paper_plan();
  for (Edge& edge : plan.cycle.edges) edge.phase_rad = 0.0;
  expect_numbers(plan);
  for (Edge& edge : plan.cycle.edges) edge.amplitude_n = 0.0;
  expect_numbers(plan);
  EXPECT_TRUE(certify(plan, {true, true, false}).admissible());
}

TEST(Degenerate, cables_through_zero_tension_and_through_the_horizontal) {
  for (const double amplitude : {5.0, 50.0, 500.0}) {
    Plan plan = reference_plan("penta-tilted");
    for (Edge& edge : plan.cycle.edges) edge.amplitude_n = amplitude;
    expect_numbers(plan);
    for (Carrier& carrier : plan.carriers) carrier.law = LengthLaw::fixed(10.0);
    expect_numbers(plan);
  }
  Plan vertical = reference_plan("pair-unrestricted");
  vertical.carriers[0].attachment_b_m = {0.0, 0.0, 1.0};
  vertical.carriers[1].attachment_b_m = {0.0, 0.0, -1.0};
  for (const double amplitude : {0.0, 1.0, 9.81, 20.0}) {  // below, at and above the force along the edge
    vertical.cycle.edges[0].amplitude_n = amplitude;
    expect_numbers(vertical);
  }
}

TEST(Degenerate, cables_without_length_and_carriers_below) {
  for (const double altitude : {-2.0, 0.256, 0.3}) {  // below, at one attachment's height, between
    Plan plan = paper_plan();
    for (Carrier& carrier : plan.carriers) carrier.law = LengthLaw::level(altitude);
    EXPECT_FALSE(expect_numbers(plan).admissible());
  }
  Plan plan = paper_plan();
  for (Carrier& carrier : plan.carriers) carrier.law = LengthLaw::fixed(0.0);
  EXPECT_FALSE(expect_numbers(plan).admissible());
}

TEST(Degenerate, a_load_upside_down) {
  Plan plan = paper_plan();
  plan.load.orientation_w_b = Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX());
  expect_numbers(plan);
}

TEST(Degenerate, millimetres_and_kilometres_obey_the_same_laws) {
  // Lengths by k and time as it is: forces stay, lengths, speeds and accelerations scale.
  const Certificate metre = certify(paper_plan());
  for (const double k : {1e-3, 1e3}) {
    Plan plan = paper_plan();
    for (Carrier& carrier : plan.carriers) {
      carrier.attachment_b_m *= k;
      carrier.law.profile.mean *= k;
    }
    const Certificate scaled = expect_numbers(plan);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(scaled.carriers[i].tension_n.min, metre.carriers[i].tension_n.min, 1e-9);
      EXPECT_NEAR(scaled.carriers[i].speed_m_s.min / k, metre.carriers[i].speed_m_s.min, 1e-9);
      EXPECT_NEAR(scaled.carriers[i].length_m.max / k, metre.carriers[i].length_m.max, 1e-9);
      EXPECT_NEAR(scaled.carriers[i].acceleration_max_m_s2 / k, metre.carriers[i].acceleration_max_m_s2, 1e-9);
    }
    EXPECT_NEAR(scaled.separation->min_m / k, metre.separation->min_m, 1e-3);
  }
}

TEST(Degenerate, feathers_and_ships_obey_the_same_laws) {
  const Certificate paper = certify(paper_plan());
  for (const double k : {1e-6, 1e6}) {
    Plan plan = paper_plan();
    plan.load.mass_kg *= k;
    plan.load.inertia_b_kg_m2 *= k;
    plan.cable.stiffness_n_m *= k;  // no rope of the paper's holds a ship
    plan.cable.damping_n_s_m *= k;
    for (Edge& edge : plan.cycle.edges) edge.amplitude_n *= k;
    const Certificate scaled = expect_numbers(plan);
    EXPECT_TRUE(scaled.admissible());
    EXPECT_NEAR(scaled.swings->growth_1_s, paper.swings->growth_1_s, 1e-6);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(scaled.carriers[i].speed_m_s.min, paper.carriers[i].speed_m_s.min, 1e-10);
      EXPECT_NEAR(scaled.carriers[i].tension_n.max / k, paper.carriers[i].tension_n.max, 1e-10);
    }
  }
}

TEST(Degenerate, carriers_that_meet_or_fly_in_each_others_place) {
  Plan plan = polygon_plan(4);
  plan.carriers[2].law = plan.carriers[0].law;
  for (Carrier& carrier : plan.carriers) carrier.attachment_b_m *= 1e-9;
  const Certificate close = expect_numbers(plan);
  EXPECT_GE(close.separation->min_m, 0.0);
}

// -------------------------------------------------------------------------------------------------- reference, slices

CarrierSlice hanging(const LengthLaw& law) {
  CarrierSlice slice = slices(paper_plan()).front();
  slice.law = law;
  return slice;
}

bool finite(const TaylorVector<double>& v) {
  return v.value.allFinite() && v.first.allFinite() && v.second.allFinite();
}

TEST(Senseless, a_slack_cable_has_a_force_and_no_direction) {
  for (const LengthLaw& law : {LengthLaw::fixed(1.0), LengthLaw::level(1.0)}) {
    CarrierSlice slice = hanging(law);
    slice.particular_force_w_n.setZero();
    slice.incoming.amplitude_n = slice.outgoing.amplitude_n = 0.0;
    EXPECT_EQ(force(slice, 0.3).value, Eigen::Vector3d(0.0, 0.0, 0.0));
    const Reference r = evaluate(slice, 0.3);
    EXPECT_TRUE(finite(r.force_w_n));
    EXPECT_EQ(r.tension_n.value, 0.0);
    EXPECT_TRUE(r.direction_w.value.array().isNaN().all());
    EXPECT_TRUE(r.position_w_m.value.array().isNaN().all());
    EXPECT_EQ(std::isnan(r.length_m.value), law.is_projection());
  }
}

TEST(Senseless, a_cable_across_its_law_has_no_finite_length) {
  CarrierSlice slice = hanging(LengthLaw::level(1.0));
  slice.particular_force_w_n = {1.0, 0.0, 0.0};
  slice.incoming.amplitude_n = slice.outgoing.amplitude_n = 0.0;
  const Reference r = evaluate(slice, 0.3);
  EXPECT_EQ(r.direction_w.value, Eigen::Vector3d::UnitX().eval());
  EXPECT_EQ(r.tension_n.value, 1.0);
  EXPECT_FALSE(std::isfinite(r.length_m.value));
  EXPECT_FALSE(r.position_w_m.value.allFinite());
}

TEST(Senseless, what_is_no_number_makes_no_position) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const LengthLaw& law : {LengthLaw::sine({1.0, 0.1, {}, 0.0}), LengthLaw::level(1.0)}) {
    for (const double nonsense : {kNan, kInfinity, -kInfinity}) {
      const CarrierSlice good = hanging(law);
      EXPECT_TRUE(evaluate(good, 0.3).position_w_m.value.allFinite());
      EXPECT_FALSE(evaluate(good, nonsense).position_w_m.value.allFinite());
      const TimedLayer layer{&good};
      EXPECT_FALSE(evaluate_course(&layer, 1, nonsense).position_w_m.value.allFinite());
      for (double EdgePush::*number : {&EdgePush::offset_n, &EdgePush::amplitude_n, &EdgePush::phase_rad}) {
        CarrierSlice bad = good;
        bad.incoming.*number = nonsense;
        EXPECT_FALSE(evaluate(bad, 0.3).position_w_m.value.allFinite());
      }
      CarrierSlice bad = good;
      bad.rate_rad_s = nonsense;
      EXPECT_FALSE(evaluate(bad, 0.3).position_w_m.value.allFinite());
      bad = good;
      bad.law.profile.mean = nonsense;
      EXPECT_FALSE(evaluate(bad, 0.3).position_w_m.value.allFinite());
      bad = good;
      bad.attachment_w_m.z() = nonsense;
      EXPECT_FALSE(evaluate(bad, 0.3).position_w_m.value.allFinite());
    }
  }
}

TEST(Senseless, nobody_has_no_slices) {
  Plan plan = paper_plan();
  plan.carriers.clear();
  plan.cycle.edges.clear();
  EXPECT_TRUE(slices(plan).empty());
}

TEST(SenselessDeathTest, an_edge_to_a_stranger_and_a_course_of_nothing_are_bugs) {
  Plan plan = paper_plan();
  plan.cycle.edges[1].to = 9;
  EXPECT_DEATH(static_cast<void>(slices(plan)), "both ends of an edge");

  const CarrierSlice slice = hanging(LengthLaw::level(1.0));
  const std::vector<TimedLayer> layers(kMaxLayers + 1, {&slice, 0.0, 0.0, 1.0});
  const auto evaluated = [](const std::vector<TimedLayer>& course) {
    static_cast<void>(evaluate_course(course.data(), course.size(), 0.0));
  };
  EXPECT_DEATH(evaluated({}), "a course has a bottom");
  EXPECT_DEATH(evaluated(layers), "a bounded number of layers");
  EXPECT_DEATH(evaluated({{}}), "flown whole");
  EXPECT_DEATH(evaluated({{&slice}, {&slice, 0.0, 0.0, 0.0}}), "takes time");
}

}  // namespace
}  // namespace gyre::mechanics::test
