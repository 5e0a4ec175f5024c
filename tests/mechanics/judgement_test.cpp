// Every rule can be broken, names its carrier, and says what would cure it; an absent limit is not judged.

#include "common/mechanics/judgement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/mechanics/plans.hpp"

namespace gyre::mechanics::test {
namespace {

/// The reference's pair, pulled apart: as it stands there its cables pass through each other.
Plan pair() {
  Plan plan = reference_plan("pair-unrestricted");
  plan.cycle.edges[0].offset_n = 8.0;
  return plan;
}

/// The plan's verdict has a reason of this rule (for this carrier, if one is given), with a cure.
void expect_broken(const Plan& plan, Rule rule, std::optional<CarrierId> carrier = std::nullopt) {
  SCOPED_TRACE(name(rule));
  const Certificate certificate = certify(plan);
  EXPECT_FALSE(certificate.admissible());
  const auto found = std::find_if(certificate.reasons.begin(), certificate.reasons.end(), [&](const Reason& reason) {
    return reason.rule == rule && (!carrier || reason.carrier == carrier);
  });
  ASSERT_NE(found, certificate.reasons.end());
  EXPECT_NE(found->text.find(';'), std::string::npos) << "no cure: " << found->text;
  if (found->carrier && rule != Rule::kOneCarrierImpossibility) {
    EXPECT_NE(found->text.find(std::to_string(*found->carrier)), std::string::npos) << found->text;
  }
}

/// What is no plan has no figures, and reasons that say nothing else.
void expect_malformed(const Plan& plan) {
  expect_broken(plan, Rule::kMalformedPlan);
  const Certificate certificate = certify(plan);
  for (const Reason& reason : certificate.reasons) EXPECT_EQ(reason.rule, Rule::kMalformedPlan) << reason.text;
  EXPECT_TRUE(certificate.carriers.empty());
  EXPECT_FALSE(certificate.separation || certificate.stiffness_min_1_s2 || certificate.skew);
  EXPECT_EQ(certificate.period_s, std::numeric_limits<double>::infinity());
}

TEST(Form, every_number_has_to_be_one) {
  const std::vector<std::function<double&(Plan&)>> numbers = {
      [](Plan& p) -> double& { return p.load.mass_kg; },
      [](Plan& p) -> double& { return p.load.inertia_b_kg_m2(1, 1); },
      [](Plan& p) -> double& { return p.load.position_w_m.x(); },
      [](Plan& p) -> double& { return p.load.orientation_w_b.w(); },
      [](Plan& p) -> double& { return p.gravity_m_s2; },
      [](Plan& p) -> double& { return p.cable.stiffness_n_m; },
      [](Plan& p) -> double& { return p.cable.damping_n_s_m; },
      [](Plan& p) -> double& { return p.carriers[2].attachment_b_m.z(); },
      [](Plan& p) -> double& { return p.carriers[2].law.direction.z(); },
      [](Plan& p) -> double& { return p.carriers[2].law.profile.mean; },
      [](Plan& p) -> double& { return p.carriers[2].law.profile.swing; },
      [](Plan& p) -> double& { return p.carriers[2].law.profile.phase_rad; },
      [](Plan& p) -> double& { return p.cycle.rate_rad_s; },
      [](Plan& p) -> double& { return p.cycle.edges[3].offset_n; },
      [](Plan& p) -> double& { return p.cycle.edges[3].amplitude_n; },
      [](Plan& p) -> double& { return p.cycle.edges[3].phase_rad; }};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    SCOPED_TRACE(i);
    for (const double nonsense : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e300}) {
      Plan plan = paper_plan();
      numbers[i](plan) = nonsense;
      expect_malformed(plan);
    }
  }
}

TEST(Form, what_has_to_be_positive_is) {
  for (const double x : {0.0, -1.0}) {
    Plan plan = paper_plan();
    plan.load.mass_kg = x;
    expect_malformed(plan);
    plan = paper_plan();
    plan.load.inertia_b_kg_m2(2, 2) = x;
    expect_malformed(plan);
    plan = paper_plan();
    plan.cycle.rate_rad_s = x;
    expect_malformed(plan);
  }
  Plan skewed = paper_plan();
  skewed.load.inertia_b_kg_m2(0, 1) = 1e-3;
  expect_malformed(skewed);
}

TEST(Form, a_profile_repeats_with_the_cycle) {
  for (const Harmonic harmonic : {Harmonic{0, 1}, Harmonic{-1, 1}, Harmonic{1, 0}, Harmonic{kMaxNumerator + 1, 1},
                                  Harmonic{1, kMaxDenominator + 1}}) {
    Plan plan = paper_plan();
    plan.carriers[0].law = LengthLaw::sine({1.0, 0.1, harmonic, 0.0});
    expect_malformed(plan);
  }
}

TEST(Form, edges_are_a_cycle_through_every_carrier) {
  Plan none = paper_plan();
  none.carriers.clear();
  expect_malformed(none);

  const std::vector<std::function<void(Plan&)>> breakages = {
      [](Plan& p) { p.carriers[1].id = 1; },                           // two of one number
      [](Plan& p) { p.cycle.edges[1].to = 9; },                        // nobody
      [](Plan& p) { p.cycle.edges[1].from = 9; },                      //
      [](Plan& p) { p.cycle.edges[1].to = 2; },                        // to itself
      [](Plan& p) { p.cycle.edges.pop_back(); },                       // open
      [](Plan& p) { p.cycle.edges.clear(); },                          //
      [](Plan& p) { p.cycle.edges.push_back(p.cycle.edges[0]); },      // twice
      [](Plan& p) { std::swap(p.cycle.edges[0], p.cycle.edges[1]); },  // not as travelled
      [](Plan& p) {
        p.carriers.push_back({5, {0.0, 0.0, 0.3}, LengthLaw::level(1.0)});
      },  // one left out
      [](Plan& p) {
        p.cycle.edges = {{1, 2}, {2, 1}, {3, 4}, {4, 3}};
      },  // two cycles
      [](Plan& p) {
        p.cycle.edges = {{1, 2}, {1, 3}, {1, 4}, {4, 1}};
      }};  // a star
  for (std::size_t i = 0; i < breakages.size(); ++i) {
    SCOPED_TRACE(i);
    Plan plan = paper_plan();
    breakages[i](plan);
    expect_malformed(plan);
  }
  Plan two = pair();
  two.cycle.edges.push_back({2, 1, 0.0, 1.0, 0.0});
  expect_malformed(two);
  Plan single = pair();
  single.carriers.resize(1);
  expect_malformed(single);
}

TEST(Rules, one_carrier_cannot_be_non_stop) {
  Plan plan = pair();
  plan.carriers.resize(1);
  plan.carriers[0].attachment_b_m = {0.0, 0.0, 0.3};
  plan.cycle.edges.clear();
  expect_broken(plan, Rule::kOneCarrierImpossibility, 1);
}

TEST(Rules, two_level_carriers_both_stop_whenever_the_force_turns_back) {
  Plan plan = pair();
  for (Carrier& carrier : plan.carriers) carrier.law = LengthLaw::level(9.0);
  expect_broken(plan, Rule::kTwoCarrierObstruction, 1);
  expect_broken(plan, Rule::kTwoCarrierObstruction, 2);
  expect_broken(plan, Rule::kNonStop, 1);
  for (const double theta : {0.5 * kPi, 1.5 * kPi}) {  // d(lambda)/dt = 0
    const double t_s = (theta - plan.cycle.edges[0].phase_rad) / plan.cycle.rate_rad_s;
    for (const CarrierSlice& slice : slices(plan)) EXPECT_LT(evaluate(slice, t_s).position_w_m.first.norm(), 1e-12);
  }
}

TEST(Rules, two_carriers_need_a_length_that_swings_out_of_step) {
  CertifyOptions forces_only;  // the reference has no moments of inertia
  forces_only.swings = false;
  EXPECT_TRUE(certify(pair(), forces_only).admissible());
  Plan plan = pair();
  plan.carriers[1].law = LengthLaw::fixed(3.0);
  expect_broken(plan, Rule::kTwoCarrierConstruction, 2);
  plan = pair();
  plan.cycle.edges[0].phase_rad = 0.0;  // length and direction now stop together
  expect_broken(plan, Rule::kNonStop, 1);
}

TEST(Rules, two_carriers_need_a_force_off_the_line_between_them) {
  Plan plan = pair();
  plan.carriers[0].attachment_b_m = {0.0, 0.0, 1.0};
  plan.carriers[1].attachment_b_m = {0.0, 0.0, -1.0};
  plan.cycle.edges[0].amplitude_n = 2.0;
  expect_broken(plan, Rule::kTwoCarrierConstruction, 1);
}

TEST(Rules, edges_in_one_line_have_rank_one) {
  Plan plan = polygon_plan(3);
  plan.carriers[0].attachment_b_m = {-1.0, 0.0, 0.3};
  plan.carriers[1].attachment_b_m = {0.0, 0.0, 0.3};
  plan.carriers[2].attachment_b_m = {1.0, 0.0, 0.3};
  expect_broken(plan, Rule::kRank, 2);
}

TEST(Rules, a_force_in_the_plane_of_its_edges_cannot_leave_it) {
  Plan plan = polygon_plan(3);
  plan.carriers[0].attachment_b_m = {-1.0, 0.0, 0.3};
  plan.carriers[1].attachment_b_m = {0.0, 0.0, 1.0};
  plan.carriers[2].attachment_b_m = {1.0, 0.0, 0.3};
  expect_broken(plan, Rule::kPlane, 2);
}

TEST(Rules, adjacent_phases_must_not_differ_by_a_multiple_of_pi) {
  Plan plan = polygon_plan(4);
  plan.cycle.edges[1].phase_rad = plan.cycle.edges[0].phase_rad + kPi;
  expect_broken(plan, Rule::kPhaseCondition, 2);
  plan = polygon_plan(4);
  plan.cycle.edges[2].amplitude_n = 0.0;
  expect_broken(plan, Rule::kPhaseCondition, 3);
}

TEST(Rules, attachments_must_be_able_to_hold_the_load) {
  Plan plan = pair();
  for (Carrier& carrier : plan.carriers) carrier.attachment_b_m.y() = 0.5;  // both on one side of the centre of mass
  expect_broken(plan, Rule::kInfeasibleEquilibrium);
}

TEST(Rules, a_slack_cable_is_refused_without_a_limit) {
  Plan plan = pair();
  plan.carriers[0].attachment_b_m = {0.0, 0.0, 1.0};
  plan.carriers[1].attachment_b_m = {0.0, 0.0, -1.0};
  plan.cycle.edges[0].amplitude_n = 20.0;  // along the force: through zero
  expect_broken(plan, Rule::kTension, 1);
}

TEST(Rules, a_cable_across_its_laws_direction_is_refused_without_a_limit) {
  Plan plan = paper_plan();
  plan.carriers[2].law = LengthLaw::directional(Eigen::Vector3d::UnitX(), {5.0, 0.0, {}, 0.0});
  expect_broken(plan, Rule::kDirectionCosine, 3);
  Plan tilted = polygon_plan(3);
  tilted.load.orientation_w_b = Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitX());
  for (Edge& edge : tilted.cycle.edges) edge.amplitude_n = 40.0;
  expect_broken(tilted, Rule::kVerticalCosine);
}

TEST(Rules, a_cable_is_longer_than_nothing) {
  Plan plan = paper_plan();
  plan.carriers[3].law = LengthLaw::level(0.1);  // below its attachment
  expect_broken(plan, Rule::kLengthBounds, 4);
}

TEST(Rules, a_load_that_its_cables_do_not_pull_back_is_a_caution) {
  Plan plan = pair();
  for (Carrier& carrier : plan.carriers) carrier.attachment_b_m.z() = -0.5;  // the load stands on its head
  CertifyOptions no_swings;
  no_swings.swings = false;
  const Certificate certificate = certify(plan, no_swings);
  ASSERT_EQ(certificate.cautions.size(), 1U);
  EXPECT_EQ(certificate.cautions[0].rule, Rule::kStiffness);
  EXPECT_LT(certificate.stiffness_min_1_s2.value(), 0.0);
  EXPECT_TRUE(certificate.admissible()) << "of single moments";
  EXPECT_FALSE(certify(plan).admissible()) << "and over a period, it falls over";
}

TEST(Rules, each_has_a_name_of_its_own) {
  std::vector<std::string> names;
  for (int rule = 0; rule <= static_cast<int>(Rule::kSwing); ++rule) {
    names.emplace_back(name(static_cast<Rule>(rule)));
    EXPECT_NE(names.back(), "unknown");
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

// ------------------------------------------------------------------------------------------------------------ limits

struct Limit {
  Rule rule;
  std::optional<double> Limits::*limit;
  double figure;  ///< the paper plan's worst
  double worse;   ///< the direction in which the limit begins to bite
};

TEST(LimitsOfAPlan, each_is_kept_to_the_figure_and_broken_beyond_it) {
  const Certificate c = certify(paper_plan());
  double tension_min = 1e9, tension_max = 0, length_min = 1e9, length_max = 0, winch = 0, speed_min = 1e9,
         speed_max = 0, acceleration = 0, cosine = 1;
  for (const CarrierFigures& f : c.carriers) {
    tension_min = std::min(tension_min, f.tension_n.min);
    tension_max = std::max(tension_max, f.tension_n.max);
    length_min = std::min(length_min, f.paid_out_m.min);  // what is paid out is the shorter one
    length_max = std::max(length_max, f.length_m.max);
    winch = std::max(winch, f.winch_rate_max_m_s());
    speed_min = std::min(speed_min, f.speed_m_s.min);
    speed_max = std::max(speed_max, f.speed_m_s.max);
    acceleration = std::max(acceleration, f.acceleration_max_m_s2);
    cosine = std::min(cosine, f.vertical_cosine.min);
  }
  const Limit limits[] = {{Rule::kTension, &Limits::tension_min_n, tension_min, 1.0},
                          {Rule::kTension, &Limits::tension_max_n, tension_max, -1.0},
                          {Rule::kLengthBounds, &Limits::length_min_m, length_min, 1.0},
                          {Rule::kLengthBounds, &Limits::length_max_m, length_max, -1.0},
                          {Rule::kWinchRate, &Limits::winch_rate_max_m_s, winch, -1.0},
                          {Rule::kSpeed, &Limits::speed_min_m_s, speed_min, 1.0},
                          {Rule::kSpeed, &Limits::speed_max_m_s, speed_max, -1.0},
                          {Rule::kAcceleration, &Limits::acceleration_max_m_s2, acceleration, -1.0},
                          {Rule::kSeparation, &Limits::separation_min_m, c.separation->min_m, 1.0},
                          {Rule::kVerticalCosine, &Limits::vertical_cosine_min, cosine, 1.0}};
  for (const Limit& limit : limits) {
    SCOPED_TRACE(name(limit.rule));
    Plan plan = paper_plan();
    plan.limits.*limit.limit = limit.figure;
    EXPECT_TRUE(certify(plan).admissible());
    plan.limits.*limit.limit = limit.figure * (1.0 + limit.worse * 1e-6);
    expect_broken(plan, limit.rule);
    for (const Reason& reason : certify(plan).reasons) EXPECT_EQ(reason.rule, limit.rule) << reason.text;
  }
}

TEST(LimitsOfAPlan, a_cable_may_point_down_as_steeply_as_up_and_not_turn_over) {
  const auto kept = [](double least, double greatest, double limit) {
    CarrierFigures figures;
    figures.tension_n = {1.0, 2.0};
    figures.length_m = {1.0, 2.0};
    figures.vertical_cosine = {least, greatest};
    Limits limits;
    limits.vertical_cosine_min = limit;
    std::vector<Reason> reasons;
    judge_carrier(figures, limits, false, reasons);
    return reasons.empty();
  };
  for (const double limit : {0.0, 0.5, 0.8}) {
    EXPECT_TRUE(kept(0.8, 0.9, limit));
    EXPECT_TRUE(kept(-0.9, -0.8, limit));
  }
  EXPECT_FALSE(kept(0.8, 0.9, 0.81));
  EXPECT_FALSE(kept(-0.9, -0.8, 0.81));
  EXPECT_FALSE(kept(-0.9, 0.9, 0.1)) << "in between it is level";
}

TEST(LimitsOfAPlan, a_plan_meant_to_stand_still_is_not_asked_to_move) {
  Plan still = still_plan(paper_plan(), 0.7);
  still.limits.speed_min_m_s = 1.0;
  EXPECT_FALSE(certify(still).admissible());
  EXPECT_TRUE(certify(still, {true, true, false}).admissible());
}

TEST(FixedLength, it_keeps_a_profile_only_where_the_direction_keeps_its_height) {
  // s* − u·B = l u·q(t) for all t: on circles q_z is constant and a level carrier's cable is a fixed one.
  const Plan circles = polygon_plan(5);
  for (const CarrierFigures& f : certify(circles).carriers) EXPECT_LT(f.length_m.span(), 1e-11);
  const Plan fixed = reference_plan("paper-fixed");
  for (const CarrierFigures& f : certify(fixed).carriers) {
    EXPECT_NEAR(f.altitude_m.span(), f.length_m.max * f.vertical_cosine.span(), 1e-11);
    EXPECT_GT(f.altitude_m.span(), 0.1);
  }
}

}  // namespace
}  // namespace gyre::mechanics::test
