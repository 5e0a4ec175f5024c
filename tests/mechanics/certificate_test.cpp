// The certificate against dense sampling, both ways: never inside the samples, and tight. And facts 1 and 2 of
// docs/design.md.

#include "common/mechanics/certificate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/mechanics/clearance.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/mechanics/track.hpp"

namespace gyre::mechanics::test {
namespace {

constexpr int kSamples = 4000;

CertifyOptions figures_only() {
  CertifyOptions options;
  options.separation = options.stiffness = false;
  return options;
}

RC_GTEST_PROP(Certificate, every_figure_is_that_of_dense_sampling, ()) {
  RandomPlan wish;
  wish.carriers_max = 6;
  const Plan plan = random_plan(wish);
  const Certificate certificate = certify(plan, figures_only());
  const std::vector<CarrierSlice> all = slices(plan);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const CarrierSlice& slice = all[i];
    Track tension, length, winch_rate, square_speed, square_acceleration, altitude, vertical, cosine;
    sample(0.0, certificate.period_s, kSamples, [&](double t_s) {
      const Reference r = evaluate(slice, t_s);
      tension.add(r.tension_n.value);
      length.add(r.length_m.value);
      winch_rate.add(r.length_m.first);
      square_speed.add(r.position_w_m.first.squaredNorm());  // smooth, unlike the norm where it nears zero
      square_acceleration.add(r.position_w_m.second.squaredNorm());
      altitude.add(r.position_w_m.value.z());
      vertical.add(r.direction_w.value.z());
      cosine.add(std::abs(slice.law.direction.dot(r.direction_w.value)));
    });
    const CarrierFigures& c = certificate.carriers[i];
    check_holds(tension, c.tension_n);
    check_holds(length, c.length_m);
    check_holds(winch_rate, c.winch_rate_m_s);
    check_holds(square_speed, {c.speed_m_s.min * c.speed_m_s.min, c.speed_m_s.max * c.speed_m_s.max});
    check_holds(square_acceleration,
                {square_acceleration.range().min, c.acceleration_max_m_s2 * c.acceleration_max_m_s2});
    check_holds(altitude, c.altitude_m);
    check_holds(vertical, c.vertical_cosine);
    RC_ASSERT(c.direction_cosine_min.has_value() == slice.law.is_projection());
    if (c.direction_cosine_min) check_holds(cosine, {*c.direction_cosine_min, cosine.range().max});
  }
}

RC_GTEST_PROP(Certificate, the_separation_is_below_every_sampled_distance_and_close_to_the_least, ()) {
  RandomPlan wish;
  wish.carriers_max = 6;
  const Plan plan = random_plan(wish);
  CertifyOptions options;
  options.stiffness = false;
  const Certificate certificate = certify(plan, options);
  const std::vector<CarrierSlice> all = slices(plan);
  double least = std::numeric_limits<double>::infinity();
  double speed = 0.0;
  for (const CarrierFigures& c : certificate.carriers) speed = std::max(speed, c.speed_m_s.max);
  sample(0.0, certificate.period_s, kSamples, [&](double t_s) {
    std::vector<Eigen::Vector3d> at;
    for (const CarrierSlice& slice : all) at.push_back(evaluate(slice, t_s).position_w_m.value);
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t k = i + 1; k < at.size(); ++k) least = std::min(least, (at[i] - at[k]).norm());
    }
  });
  RC_ASSERT(certificate.separation->min_m <= least);
  // Half a step of time at twice the greatest speed is all a sample can have missed.
  RC_ASSERT(certificate.separation->min_m >=
            least - speed * certificate.period_s / kSamples - 2.0 * kSeparationSlack_m);
  RC_ASSERT(certificate.separation->first != certificate.separation->second);
}

RC_GTEST_PROP(Certificate, the_pair_it_names_attains_the_separation, ()) {
  RandomPlan wish;
  wish.carriers_max = 5;
  const Plan plan = random_plan(wish);
  CertifyOptions options;
  options.stiffness = false;
  const Approach s = certify(plan, options).separation.value();
  std::vector<CarrierSlice> all = slices(plan);
  const auto distance = [&](double t_s) {
    return (evaluate(all.at(s.first - 1), t_s).position_w_m.value -
            evaluate(all.at(s.second - 1), t_s).position_w_m.value)
        .norm();
  };
  // Sampling, and then sampling again around the least.
  double centre = 0.0;
  double half = 0.5 * period_s(plan);
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 2; ++round) {
    double best = centre;
    sample(centre - half, centre + half, 20000, [&](double t_s) {
      if (distance(t_s) >= least) return;
      least = distance(t_s);
      best = t_s;
    });
    centre = best;
    half /= 5000.0;
  }
  RC_ASSERT(std::abs(least - s.min_m) < 1e-5);
}

// ------------------------------------------------------------------------------------------------------------ fact 2

RC_GTEST_PROP(EdgeHeadings, carriers_of_any_planar_polygon_fly_circles_at_constant_speed_and_length, ()) {
  RandomPlan wish;
  wish.tilted = false;
  wish.mixed_laws = false;
  Plan plan = random_plan(wish);
  const double amplitude = plan.cycle.edges.front().amplitude_n;
  for (Carrier& carrier : plan.carriers) carrier.attachment_b_m.z() = 0.3;
  for (Edge& edge : plan.cycle.edges) {
    edge.amplitude_n = amplitude;
    edge.offset_n = 0.0;
  }
  take_edge_headings(plan);
  const Certificate certificate = certify(plan, figures_only());
  // Levelling the attachments moved the forces: a carrier may now have to hold the load from below.
  for (const CarrierFigures& c : certificate.carriers) RC_PRE(c.vertical_cosine.min > 0.1);
  for (const CarrierFigures& c : certificate.carriers) {
    RC_ASSERT(c.speed_m_s.span() < 1e-8 * c.speed_m_s.max);
    RC_ASSERT(c.length_m.span() < 1e-11 * c.length_m.max);
    RC_ASSERT(c.winch_rate_max_m_s() < 1e-10);
    RC_ASSERT(c.tension_n.span() < 1e-11 * c.tension_n.max);
    RC_ASSERT(c.speed_m_s.min > 0.0);
  }
  for (const CarrierSlice& slice : slices(plan)) {
    // A circle: the acceleration has constant size and is square to the velocity.
    const Reference r = evaluate(slice, real(0.0, 1.0) * period_s(plan));
    const auto& v = r.position_w_m.first;
    const auto& a = r.position_w_m.second;
    RC_ASSERT(std::abs(v.dot(a)) < 1e-10 * v.norm() * a.norm());
    RC_ASSERT(std::abs(a.norm() - plan.cycle.rate_rad_s * v.norm()) < 1e-10 * a.norm());
  }
}

struct Phases {
  const char* name;
  double least_speed, winch_rate, tension_min, tension_max, length_min, length_max;
};

/// The paper's load with other phases, computed independently of this code.
void expect_row(const Plan& plan, const Phases& row) {
  SCOPED_TRACE(row.name);
  Range tension, length;
  double least_speed = std::numeric_limits<double>::infinity();
  double winch_rate = 0.0;
  for (const CarrierFigures& c : certify(plan, figures_only()).carriers) {
    tension.include(c.tension_n);
    length.include(c.length_m);
    least_speed = std::min(least_speed, c.speed_m_s.min);
    winch_rate = std::max(winch_rate, c.winch_rate_max_m_s());
  }
  EXPECT_NEAR(least_speed, row.least_speed, 6e-5);
  EXPECT_NEAR(winch_rate, row.winch_rate, 6e-5);
  EXPECT_NEAR(tension.min, row.tension_min, 6e-4);
  EXPECT_NEAR(tension.max, row.tension_max, 6e-4);
  EXPECT_NEAR(length.min, row.length_min, 6e-4);
  EXPECT_NEAR(length.max, row.length_max, 6e-4);
}

TEST(PaperLoad, its_figures_with_other_phases_are_those_of_the_table) {
  Plan plan = paper_plan();
  expect_row(plan, {"paper", 0.0059, 0.0761, 0.707, 1.916, 0.371, 1.442});
  for (std::size_t j = 0; j < 4; ++j) plan.cycle.edges[j].phase_rad = static_cast<double>(j) * kPi / 4.0;
  expect_row(plan, {"quarter steps of pi", 0.0231, 0.0539, 0.955, 1.803, 0.474, 1.327});
  for (std::size_t j = 0; j < 4; ++j) plan.cycle.edges[j].phase_rad = static_cast<double>(j) * kPi / 2.0;
  expect_row(plan, {"half steps of pi", 0.0428, 0.0093, 1.294, 1.470, 0.645, 1.010});
  take_edge_headings(plan);
  expect_row(plan, {"edge headings", 0.0428, 0.0089, 1.327, 1.446, 0.645, 1.042});
}

TEST(PaperLoad, edge_headings_multiply_the_guaranteed_speed_and_divide_the_winch_rate) {
  Plan plan = paper_plan();
  const auto worst = [](const Plan& p) {
    double speed = std::numeric_limits<double>::infinity();
    double winch_rate = 0.0;
    for (const CarrierFigures& c : certify(p, figures_only()).carriers) {
      speed = std::min(speed, c.speed_m_s.min);
      winch_rate = std::max(winch_rate, c.winch_rate_max_m_s());
    }
    return std::make_pair(speed, winch_rate);
  };
  const auto before = worst(plan);
  take_edge_headings(plan);
  const auto after = worst(plan);
  EXPECT_NEAR(after.first / before.first, 7.2, 0.05);
  EXPECT_NEAR(before.second / after.second, 8.6, 0.06);
}

TEST(PaperLoad, fixed_cables_swing_the_altitude_by_several_decimetres_and_level_ones_not_at_all) {
  Range fixed;
  for (const CarrierFigures& c : certify(reference_plan("paper-fixed"), figures_only()).carriers) {
    fixed.include(c.altitude_m.span());
  }
  EXPECT_NEAR(fixed.min, 0.571, 6e-4);
  EXPECT_NEAR(fixed.max, 0.653, 6e-4);
  for (const CarrierFigures& c : certify(paper_plan(), figures_only()).carriers) EXPECT_EQ(c.altitude_m.span(), 0.0);
}

}  // namespace
}  // namespace gyre::mechanics::test
