// Plans at the edge of sense: nothing hangs, nothing crashes, no figure is NaN.

#include <gtest/gtest.h>

#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/rest_plan.hpp"
#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

/// Lengths, rates, speeds, altitudes may be infinite where a law has no bounded length; everything else is finite.
Certificate expect_numbers(const Plan& plan) {
  for (const bool non_stop : {true, false}) {
    const Certificate c = certify(plan, {true, true, non_stop});
    for (const double x : {c.separation.min_m, c.stiffness_min_1_s2, c.skew.residual_n_per_s, c.skew.budget_s,
                           c.skew.displacement_m_per_s, c.skew.holdover_s}) {
      EXPECT_FALSE(std::isnan(x));
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

TEST(Degenerate, any_number_of_carriers) {
  for (const std::size_t n : {3U, 4U, 16U, 64U}) EXPECT_TRUE(expect_numbers(polygon_plan(n)).admissible()) << n;
  EXPECT_TRUE(expect_numbers(reference_plan("pair-unrestricted")).admissible());
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
  EXPECT_EQ(one_point.separation.min_m, 0.0);  // the carriers coincide for all time
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
    EXPECT_NEAR(scaled.separation.min_m / k, metre.separation.min_m, 1e-3);
  }
}

TEST(Degenerate, feathers_and_ships_obey_the_same_laws) {
  const Certificate paper = certify(paper_plan());
  for (const double k : {1e-6, 1e6}) {
    Plan plan = paper_plan();
    plan.load.mass_kg *= k;
    for (Edge& edge : plan.cycle.edges) edge.amplitude_n *= k;
    const Certificate scaled = expect_numbers(plan);
    EXPECT_TRUE(scaled.admissible());
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
  EXPECT_GE(close.separation.min_m, 0.0);
}

}  // namespace
}  // namespace gyre::mechanics::test
