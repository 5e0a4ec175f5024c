// What winches pay out and vehicles pull: figures against dense sampling and against what is known by hand, and the
// rules that hold them to what a mission says its machines can do.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/judgement.hpp"
#include "common/mechanics/orbit_figures.hpp"
#include "common/mechanics/transition_figures.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/mechanics/track.hpp"

namespace gyre::mechanics::test {
namespace {

using Eigen::Vector3d;

constexpr double kAnything = std::numeric_limits<double>::infinity();

/// m (a + g e_z) + f.
Vector3d pull(const Reference& r, const VehicleWeight& vehicle) {
  return vehicle.mass_kg * (r.position_w_m.second + vehicle.gravity_m_s2 * Vector3d::UnitZ()) + r.force_w_n.value;
}

/// While the pace is 0.
Vector3d pull_at_rest(const Reference& r, const VehicleWeight& vehicle) {
  return vehicle.mass_kg * vehicle.gravity_m_s2 * Vector3d::UnitZ() + r.force_w_n.value;
}

double bank_rad(const Vector3d& pull_w_n) {
  return std::atan2(pull_w_n.head<2>().norm(), pull_w_n.z());
}

/// Sampled along a motion.
struct Machines {
  struct Pull {
    Track square_thrust, cosine;
  };
  Track paid_out, rate, square_acceleration, stretch, stretch_rate, stretch_acceleration;
  Pull at_rest, at_full_pace;
  double thrust_n = 0.0;

  void add(const Reference& r, double stiffness_n_m, const VehicleWeight& vehicle) {
    const double compliance = stiffness_n_m > 0.0 ? 1.0 / stiffness_n_m : 0.0;
    paid_out.add(r.length_m.value - compliance * r.tension_n.value);
    rate.add(r.length_m.first - compliance * r.tension_n.first);
    square_acceleration.add(std::pow(r.length_m.second - compliance * r.tension_n.second, 2));
    stretch.add(compliance * r.tension_n.value);
    stretch_rate.add(compliance * r.tension_n.first);
    stretch_acceleration.add(compliance * r.tension_n.second);
    const auto see = [this](Pull& tracks, const Vector3d& n) {
      tracks.square_thrust.add(n.squaredNorm());
      tracks.cosine.add(n.z() / n.norm());
      thrust_n = std::max(thrust_n, n.norm());
    };
    see(at_rest, pull_at_rest(r, vehicle));
    see(at_full_pace, pull(r, vehicle));
  }
  [[nodiscard]] double least_cosine() const {
    return std::min(at_rest.cosine.range().min, at_full_pace.cosine.range().min);
  }
};

/// How far a bound that is a sum of ranges may be from the truth: the stretch's swing.
double swing(const Track& stretch, bool projection) {
  return projection ? 0.0 : stretch.range().span() + stretch.missed();
}

RC_GTEST_PROP(Machines, every_figure_of_an_orbit_is_that_of_dense_sampling, ()) {
  RandomPlan wish;
  wish.carriers_max = 4;
  Plan plan = random_plan(wish);
  plan.cable.stiffness_n_m = std::pow(10.0, real(1.5, 4.0));  // from a rubber band to a rope
  plan.cable.compensate_stretch = whole(0, 3) != 0;
  const VehicleWeight vehicle{real(0.2, 5.0), plan.gravity_m_s2};
  for (const CarrierSlice& slice : slices(plan)) {
    const bool projects = slice.law.is_projection();
    const CarrierFigures f = orbit_figures(slice, vehicle);
    Machines sampled;
    sample(0.0, period_s(plan), 4000,
           [&](double t_s) { sampled.add(evaluate(slice, t_s), slice.cable_stiffness_n_m, vehicle); });
    check_holds(sampled.paid_out, f.paid_out_m, swing(sampled.stretch, projects));
    check_holds(sampled.rate, f.paid_out_rate_m_s, swing(sampled.stretch_rate, projects));
    const double acceleration = std::sqrt(sampled.square_acceleration.range().max);
    const double wide = acceleration + swing(sampled.stretch_acceleration, projects);
    check_holds(sampled.square_acceleration,
                {sampled.square_acceleration.range().min, std::pow(f.winch_acceleration_max_m_s2, 2)},
                wide * wide - acceleration * acceleration);
    // A free law's pull is enclosed, within its slack.
    const double slack = projects ? 0.0 : 1.1 * kAccelerationSlack;
    const double missed = std::max(sampled.at_rest.square_thrust.missed(), sampled.at_full_pace.square_thrust.missed());
    RC_ASSERT(f.thrust_max_n.value() >= sampled.thrust_n * (1.0 - 1e-12));
    RC_ASSERT(f.thrust_max_n.value() <=
              std::sqrt(sampled.thrust_n * sampled.thrust_n + missed) * (1.0 + slack + 1e-12));
    const double cosine = std::cos(f.bank_max_rad.value());
    const double turned = std::max(sampled.at_rest.cosine.missed(), sampled.at_full_pace.cosine.missed());
    RC_ASSERT(cosine <= sampled.least_cosine() + 1e-12);
    RC_ASSERT(cosine >= sampled.least_cosine() - turned - slack - 1e-12);
  }
}

RC_GTEST_PROP(Machines, what_is_enclosed_in_a_transition_holds_every_sample, ()) {
  RandomPlan wish;
  wish.carriers_max = 3;
  Plan below = random_plan(wish);
  below.cable.stiffness_n_m = std::pow(10.0, real(2.0, 4.0));
  const Plan above = random_motion(below);
  const std::vector<CarrierSlice> a = slices(below);
  const std::vector<CarrierSlice> b = slices(above);
  const std::size_t i = whole(0, a.size() - 1);
  const std::vector<TimedLayer> layers{{&a[i], real(-5.0, 5.0), 0.0, 0.0}, {&b[i], real(-5.0, 5.0), 0.0, 6.0}};
  const VehicleWeight vehicle{real(0.2, 5.0), below.gravity_m_s2};
  const CarrierFigures f = transition_figures(layers, 0.0, 6.0, vehicle);
  Machines sampled;
  sample(0.0, 6.0, 2000, [&](double t_s) {
    sampled.add(evaluate_course(layers.data(), layers.size(), t_s), a[i].cable_stiffness_n_m, vehicle);
  });
  check_holds(sampled.paid_out, f.paid_out_m, kAnything);
  check_holds(sampled.rate, f.paid_out_rate_m_s, kAnything);
  check_holds(sampled.square_acceleration,
              {sampled.square_acceleration.range().min, std::pow(f.winch_acceleration_max_m_s2, 2)}, kAnything);
  RC_ASSERT(f.thrust_max_n.value() >= sampled.thrust_n);
  RC_ASSERT(f.bank_max_rad.value() >= std::acos(sampled.least_cosine()) - 1e-9);
}

TEST(Machines, a_change_of_the_papers_motion_is_tight_in_all_of_them) {
  Plan headings = paper_plan();
  take_edge_headings(headings);
  const std::vector<CarrierSlice> a = slices(headings);
  const std::vector<CarrierSlice> b = slices(paper_plan());
  const VehicleWeight vehicle{0.5, 9.81};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::vector<TimedLayer> layers{{&a[i], 0.0, 0.0, 0.0}, {&b[i], 0.0, 0.0, 20.0}};
    const CarrierFigures f = transition_figures(layers, 0.0, 20.0, vehicle);
    Range paid_out, rate, acceleration, carrier, speed, thrust, bank;
    sample(0.0, 20.0, 20000, [&](double t_s) {
      const Reference r = evaluate_course(layers.data(), layers.size(), t_s);
      const Taylor<double> winch = mechanics::paid_out(r, a[i].cable_stiffness_n_m);
      paid_out.include(winch.value);
      rate.include(std::abs(winch.first));
      acceleration.include(std::abs(winch.second));
      carrier.include(r.position_w_m.second.norm());
      speed.include(r.position_w_m.first.norm());
      for (const Vector3d& n : {pull(r, vehicle), pull_at_rest(r, vehicle)}) {
        thrust.include(n.norm());
        bank.include(bank_rad(n));
      }
    });
    constexpr double kMissed = 1e-5;  // by the samples
    EXPECT_NEAR(f.paid_out_m.min, paid_out.min, kTransitionSlack * paid_out.max + kMissed);
    EXPECT_NEAR(f.paid_out_m.max, paid_out.max, kTransitionSlack * paid_out.max + kMissed);
    EXPECT_NEAR(f.paid_out_rate_max_m_s(), rate.max, kTransitionSlack * std::max(rate.max, speed.max) + kMissed);
    EXPECT_NEAR(f.winch_acceleration_max_m_s2, acceleration.max,
                kWinchAccelerationSlack * std::max(acceleration.max, carrier.max) + kMissed);
    EXPECT_NEAR(f.thrust_max_n.value(), thrust.max, kAccelerationSlack * thrust.max + kMissed);
    EXPECT_NEAR(f.bank_max_rad.value(), bank.max, kAccelerationSlack + kMissed);
  }
}

TEST(Machines, on_a_circle_thrust_and_bank_are_what_a_hand_finds) {
  // A level polygon by edge headings: f0 is upright, the force's horizontal part F turns with the carrier on its circle
  // of radius R, outward, and the acceleration w² R points inward. So a slow circle leans less than rest does, which is
  // F, and a fast one more.
  for (const double w : {0.5, 8.0}) {
    Plan plan = polygon_plan(4);
    plan.cycle.rate_rad_s = w;
    for (Carrier& carrier : plan.carriers) carrier.vehicle.mass_kg = 1.5;
    const std::vector<CarrierSlice> all = slices(plan);
    const Certificate certificate = certify(plan);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const CarrierFigures& f = certificate.carriers[i];
      const double outward_n = force(all[i], 0.0).value.head<2>().norm();
      const double inward_n = 1.5 * w * f.speed_m_s.max;
      ASSERT_EQ(inward_n > 2.0 * outward_n, w > 1.0) << "one of each kind";
      const double side_n = std::max(outward_n, inward_n - outward_n);
      const double up_n = (1.5 + plan.load.mass_kg / 4.0) * plan.gravity_m_s2;
      EXPECT_NEAR(f.thrust_max_n.value(), std::hypot(side_n, up_n), 1e-9 * side_n + 1e-9);
      EXPECT_NEAR(f.bank_max_rad.value(), std::atan2(side_n, up_n), 1e-6);
      EXPECT_NEAR(f.winch_acceleration_max_m_s2, 0.0, 1e-6);
    }
  }
}

TEST(Machines, a_vehicle_at_rest_under_an_upright_cable_pulls_its_weight_and_the_loads) {
  Plan plan;
  plan.load.mass_kg = 2.0;
  plan.load.inertia_b_kg_m2 = 0.1 * Eigen::Matrix3d::Identity();
  plan.gravity_m_s2 = 10.0;
  plan.cable = {1e3, 1e2};
  plan.cycle.rate_rad_s = 1.0;
  plan.carriers.push_back({1, Vector3d::Zero(), LengthLaw::fixed(3.0), 0.0, {0.0, 1.5, std::nullopt, std::nullopt}});
  const CarrierFigures f = certify(plan, {true, true, false}).carriers.front();
  EXPECT_NEAR(f.thrust_max_n.value(), 35.0, kAccelerationSlack * 35.0);
  EXPECT_LT(f.bank_max_rad.value(), kAccelerationSlack);
  EXPECT_NEAR(f.paid_out_m.max, 3.0 - 20.0 / 1e3, 1e-12);
  EXPECT_FALSE(orbit_figures(slices(plan).front()).thrust_max_n.has_value()) << "of a vehicle whose mass is not known";
}

// ----------------------------------------------------------------------------------------------------------- judgement

/// The paper's plan with vehicles of half a kilogram, and what is worst in it.
struct PaperMachines {
  Plan plan = paper_plan();
  double rate = 0.0, acceleration = 0.0, thrust = 0.0, bank = 0.0, paid_out = kAnything;

  PaperMachines() {
    for (Carrier& carrier : plan.carriers) carrier.vehicle.mass_kg = 0.5;
    for (const CarrierFigures& f : certify(plan).carriers) {
      rate = std::max(rate, f.paid_out_rate_max_m_s());
      acceleration = std::max(acceleration, f.winch_acceleration_max_m_s2);
      thrust = std::max(thrust, f.thrust_max_n.value());
      bank = std::max(bank, f.bank_max_rad.value());
      paid_out = std::min(paid_out, f.paid_out_m.min);
    }
  }
  /// Admissible with `limit` at its figure, refused by `rule` alone just beyond it.
  template <class Set>
  void expect_judged(Rule rule, double figure, double worse, Set set) const {
    SCOPED_TRACE(name(rule));
    Plan kept = plan;
    set(kept, figure);
    EXPECT_TRUE(certify(kept).admissible());
    Plan broken = plan;
    set(broken, figure * (1.0 + worse * 1e-6));
    const Certificate certificate = certify(broken);
    EXPECT_FALSE(certificate.admissible());
    for (const Reason& reason : certificate.reasons) EXPECT_EQ(reason.rule, rule) << reason.text;
  }
};

TEST(LimitsOfMachines, each_is_kept_to_the_figure_and_broken_beyond_it) {
  const PaperMachines paper;
  paper.expect_judged(Rule::kWinch, paper.rate, -1.0, [](Plan& p, double x) { p.winch.rate_max_m_s = x; });
  paper.expect_judged(Rule::kWinch, paper.acceleration, -1.0,
                      [](Plan& p, double x) { p.winch.acceleration_max_m_s2 = x; });
  paper.expect_judged(Rule::kLengthBounds, paper.paid_out, 1.0, [](Plan& p, double x) { p.limits.length_min_m = x; });
  paper.expect_judged(Rule::kThrust, paper.thrust, -1.0, [](Plan& p, double x) {
    for (Carrier& c : p.carriers) c.vehicle.thrust_max_n = x;
  });
  paper.expect_judged(Rule::kBank, paper.bank, -1.0, [](Plan& p, double x) {
    for (Carrier& c : p.carriers) c.vehicle.bank_max_rad = x;
  });
}

TEST(LimitsOfMachines, a_winch_that_is_too_slow_for_its_plan_is_refused) {
  Plan plan = paper_plan();
  plan.winch.rate_max_m_s = 0.02;  // it needs 0.076
  EXPECT_FALSE(certify(plan).admissible());
}

TEST(LimitsOfMachines, cables_so_soft_that_more_than_all_of_them_is_wound_in_are_refused) {
  Plan plan = paper_plan();
  plan.cable.stiffness_n_m = 2.0;
  const Certificate certificate = certify(plan);
  ASSERT_FALSE(certificate.admissible());
  double least = kAnything;
  for (const CarrierFigures& f : certificate.carriers) least = std::min(least, f.paid_out_m.min);
  EXPECT_NEAR(least, -0.108, 1e-3);
  EXPECT_EQ(certificate.reasons.front().rule, Rule::kLengthBounds);
  plan.cable.compensate_stretch = false;
  EXPECT_TRUE(certify(plan).admissible()) << "it pays out what the plan says, and the load sags";
}

TEST(LimitsOfMachines, a_vehicle_whose_mass_is_not_known_is_not_judged_by_its_thrust) {
  Plan plan = paper_plan();
  for (Carrier& carrier : plan.carriers) carrier.vehicle.thrust_max_n = 1e-3;
  EXPECT_TRUE(certify(plan).admissible());
}

TEST(LimitsOfMachines, figures_without_bounds_break_them) {
  CarrierFigures figures;
  figures.tension_n = {1.0, 2.0};
  figures.paid_out_m = figures.paid_out_rate_m_s = {-kAnything, kAnything};
  figures.winch_acceleration_max_m_s2 = kAnything;
  std::vector<Reason> reasons;
  judge_machines(figures, {0.0, 1e6, 1e6}, {}, reasons);
  EXPECT_EQ(reasons.size(), 2U);
}

}  // namespace
}  // namespace gyre::mechanics::test
