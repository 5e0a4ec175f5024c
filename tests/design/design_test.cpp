// Designs are what was asked for: certified, within every limit, and as good as closed forms say they can be.

#include <gtest/gtest.h>

#include "common/mechanics/certificate.hpp"
#include "tests/design/asked.hpp"

namespace gyre::design {
namespace {

using test::designed;
using test::polygon;
using test::slowest_m_s;
using test::winch_rate_m_s;
using test::wings;

bool obstructed_by(const Design& design, mechanics::Rule rule) {
  const std::vector<mechanics::Reason>& reasons = design.certificate.reasons;
  return !design.plan && design.certificate.carriers.empty() &&
         std::any_of(reasons.begin(), reasons.end(), [rule](const mechanics::Reason& r) { return r.rule == rule; });
}

/// The paper's load, altitudes, order and rate; amplitudes as great as the paper's.
Requirements papers() {
  Requirements out;
  out.given = mechanics::test::paper_plan();
  out.given.limits = {};
  out.open.laws.assign(4, {});
  out.open.edges.assign(4, {true, true, true});
  out.want.objective = Objective::kGreatestSpeed;
  out.want.amplitude_max_n = 1.2;
  return out;
}

TEST(Design, ThePapersLoadFliesSevenTimesFasterOnAnEighthOfItsWinches) {
  const mechanics::Certificate paper = mechanics::certify(mechanics::test::paper_plan());
  Requirements asked = papers();
  asked.given.limits.winch_rate_max_m_s = winch_rate_m_s(paper) / 8.0;
  for (const bool offsets : {false, true}) {
    for (OpenEdge& edge : asked.open.edges) edge.offset = offsets;
    const Design design = designed(asked);
    ASSERT_TRUE(design.plan);
    EXPECT_GE(slowest_m_s(design.certificate), 7.2 * slowest_m_s(paper));
    EXPECT_LE(winch_rate_m_s(design.certificate), winch_rate_m_s(paper) / 8.0);
    EXPECT_NEAR(design.figure, slowest_m_s(design.certificate), 1e-3 * design.figure);
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_LE(design.plan->cycle.edges[j].amplitude_n, 1.2);
      if (!offsets) {
        EXPECT_EQ(design.plan->cycle.edges[j].offset_n, 0.0) << "it was given";
      }
      EXPECT_EQ(design.plan->carriers[j].law.profile.mean, asked.given.carriers[j].law.profile.mean) << "it was given";
    }
    EXPECT_EQ(design.plan->cycle.rate_rad_s, 0.08) << "it was given";
  }
}

class Polygons : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Polygons, FlyAtConstantSpeed) {
  const std::size_t n = GetParam();
  // Of many carriers the families are enough: what is searched beyond them is no better by much.
  const Design design = gyre::design::design(polygon(n, 1.5, 0.5), 1, [n](const Progress& progress) {
    return n <= 4 || progress.doing != "all that is open";
  });
  ASSERT_TRUE(design.plan);
  EXPECT_TRUE(mechanics::certify(*design.plan).admissible());
  for (const mechanics::CarrierFigures& carrier : design.certificate.carriers) {
    EXPECT_GE(carrier.speed_m_s.min, 1.5);
    EXPECT_LE(carrier.speed_m_s.max - carrier.speed_m_s.min, 1e-9) << "carrier " << carrier.id;
  }
  EXPECT_GE(design.certificate.clearance->min_m, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Three, Polygons, ::testing::Range<std::size_t>(3, 13));

TEST(Design, WingsDoNotBraid) {
  const Design design = designed(wings());
  ASSERT_TRUE(design.plan);
  EXPECT_TRUE(design.certificate.admissible());
  EXPECT_GE(slowest_m_s(design.certificate), 12.0);
  EXPECT_GE(design.certificate.clearance->min_m, 3.0);
  for (const mechanics::CarrierFigures& carrier : design.certificate.carriers) {
    EXPECT_LE(carrier.acceleration_max_m_s2, 10.0);
    EXPECT_LE(carrier.length_m.max, 80.0);
  }
}

TEST(Design, WhatVehiclesAndWinchesCanDoIsKeptAndCosts) {
  Requirements asked = polygon(3, 1.2, 0.5);
  for (mechanics::Carrier& carrier : asked.given.carriers) carrier.vehicle.mass_kg = 3.0;
  const Design easy = designed(asked);
  ASSERT_TRUE(easy.plan);
  const mechanics::CarrierFigures& worst = easy.certificate.carriers.front();
  Requirements banked = asked;
  for (mechanics::Carrier& carrier : banked.given.carriers) carrier.vehicle.bank_max_rad = 0.8 * *worst.bank_max_rad;
  Requirements wound = asked;
  wound.given.winch.rate_max_m_s = 0.5 * worst.paid_out_rate_max_m_s();
  for (const Requirements& tighter : {banked, wound}) {
    const Design design = designed(tighter);
    ASSERT_TRUE(design.plan);
    EXPECT_TRUE(design.certificate.admissible());
    EXPECT_GT(design.figure, easy.figure);
  }
}

TEST(Design, GreatestClearanceIsOfAllThatMayTouch) {
  Requirements asked = polygon(3, 0.8, 0.1);
  asked.given.load.hull_b_m = mechanics::box_hull({1.0, 1.0, 0.3}, Eigen::Vector3d::Zero());
  asked.given.limits.length_max_m = 8.0;
  for (mechanics::Carrier& carrier : asked.given.carriers) carrier.radius_m = 0.3;
  asked.want.objective = Objective::kGreatestClearance;
  const Design design = designed(asked);
  ASSERT_TRUE(design.plan);
  const double certified_m = std::min(design.certificate.clearance->min_m, *design.certificate.above_load_min_m);
  EXPECT_NEAR(certified_m, design.figure, 0.02 * design.figure);
  asked.want.objective = Objective::kLeastEverything;  // nor is there one with a tenth more, as far as a search sees
  asked.given.limits.clearance_min_m = 1.1 * certified_m;
  EXPECT_FALSE(designed(asked).plan);
}

TEST(Design, ChoosesAttachmentsOnTheLoadsUpperFace) {
  Requirements asked = polygon(4, 0.5, 0.05);
  asked.given.load.hull_b_m = mechanics::box_hull({0.6, 0.4, 0.2}, {0.1, 0.0, 0.0});
  for (mechanics::Carrier& carrier : asked.given.carriers) carrier.attachment_b_m.setZero();
  asked.open.attachments = true;
  const Design design = designed(asked);
  ASSERT_TRUE(design.plan);
  EXPECT_TRUE(design.certificate.admissible());
  for (const mechanics::Carrier& carrier : design.plan->carriers) {
    EXPECT_DOUBLE_EQ(carrier.attachment_b_m.z(), 0.2);
    EXPECT_LE(std::abs(carrier.attachment_b_m.x() - 0.1), 0.6);
    EXPECT_LE(std::abs(carrier.attachment_b_m.y()), 0.4);
  }
}

TEST(Design, OfTwoRowsOfAttachmentsFindsAnOrderThatLetsEveryCarrierTurn) {
  Requirements asked = polygon(6, 0.8, 0.3);
  for (std::size_t i = 0; i < 6; ++i) {
    const double along = 0.6 * (static_cast<double>(i % 3) - 1.0);
    asked.given.carriers[i].attachment_b_m = {along, i < 3 ? -0.3 : 0.3, 0.2};
  }
  const Design design = designed(asked);
  ASSERT_TRUE(design.plan);
  EXPECT_TRUE(design.certificate.admissible());
  EXPECT_GE(design.certificate.clearance->min_m, 0.3);

  asked.open.order = false;  // around the load, the middle ones of both rows move to and fro only
  const CarrierId around[] = {1, 2, 3, 6, 5, 4};
  for (std::size_t j = 0; j < 6; ++j)
    asked.given.cycle.edges.push_back({around[j], around[(j + 1) % 6], 0.0, 0.0, 0.0});
  asked.open.edges.assign(6, {true, true, true});
  EXPECT_TRUE(obstructed_by(designed(asked), mechanics::Rule::kRank));
}

TEST(Design, OfTwoCarriersIsTheConstructionPulledApart) {
  Requirements asked = polygon(2, 0.3, 0.5);
  asked.given.limits.length_max_m = 5.0;
  const Design design = designed(asked);
  ASSERT_TRUE(design.plan);
  EXPECT_GE(slowest_m_s(design.certificate), 0.3);
  EXPECT_EQ(design.plan->carriers[0].law.kind, mechanics::LengthLaw::Kind::kSine);
}

TEST(Design, OfOneCarrierIsImpossible) {
  EXPECT_TRUE(obstructed_by(designed(polygon(1, 0.3, 0.5)), mechanics::Rule::kOneCarrierImpossibility));
}

TEST(Design, IsTheSameForTheSameSeed) {
  const Design one = designed(wings(), 7);
  const Design other = designed(wings(), 7);
  ASSERT_TRUE(one.plan && other.plan);
  EXPECT_EQ(mechanics::slices(*one.plan), mechanics::slices(*other.plan));
  EXPECT_EQ(one.figure, other.figure);
}

TEST(Design, PricesAreWhatALimitCosts) {
  const Design design = designed(wings());
  ASSERT_FALSE(design.prices.empty());
  for (const Price& price : design.prices)
    EXPECT_LT(price.figure, design.figure) << price.name << ": easier to keep, and yet dearer";
  const auto named = [&](const std::string& name) {
    return std::any_of(design.prices.begin(), design.prices.end(), [&](const Price& p) { return p.name == name; });
  };
  EXPECT_TRUE(named("speed_min_m_s"));
  EXPECT_FALSE(named("tension_max_n")) << "nobody asked for it";
}

TEST(Design, OfWhatIsImpossibleNamesWhatCannotBeMetTogether) {
  Requirements asked = wings();
  asked.given.limits.acceleration_max_m_s2 = 2.0;  // a circle of 72 m
  asked.given.limits.length_max_m = 20.0;
  asked.given.limits.tension_max_n = 1000.0;
  const Design design = designed(asked);
  EXPECT_FALSE(design.plan);
  ASSERT_FALSE(design.conflict.empty());
  const auto named = [&](const std::string& name) {
    return std::any_of(design.conflict.begin(), design.conflict.end(),
                       [&](const std::string& words) { return words.rfind(name, 0) == 0; });
  };
  EXPECT_TRUE(named("speed_min_m_s 12 m/s"));
  EXPECT_TRUE(named("acceleration_max_m_s2 2 m/s^2"));
  EXPECT_FALSE(named("tension_max_n")) << "without it nothing is easier";
}

TEST(Design, WithoutAnyOfAConflictTheRestCanBeMet) {
  Requirements asked = wings();
  asked.given.limits.acceleration_max_m_s2 = 2.0;
  ASSERT_FALSE(designed(asked).plan);
  asked.given.limits.acceleration_max_m_s2.reset();
  EXPECT_TRUE(designed(asked).plan);
}

TEST(Design, AnInterruptedConflictLeavesNothingOutThatItHasNotTried) {
  Requirements asked = wings();
  asked.given.limits.acceleration_max_m_s2 = 2.0;
  const Design whole = designed(asked);
  ASSERT_FALSE(whole.conflict.empty());
  const Design cut = gyre::design::design(
      asked, 1, [](const Progress& progress) { return progress.doing != "what cannot be met together"; });
  EXPECT_TRUE(cut.interrupted);
  for (const std::string& demand : whole.conflict) {
    EXPECT_EQ(std::count(cut.conflict.begin(), cut.conflict.end(), demand), 1) << demand;
  }
}

TEST(Design, InterruptedGivesTheBestSoFar) {
  const Requirements asked = polygon(6, 1.5, 0.5);
  int steps = 0;
  bool found = false;
  const Design design = gyre::design::design(asked, 1, [&](const Progress& progress) {
    found = found || progress.best.has_value();
    return !found || ++steps < 50;
  });
  EXPECT_TRUE(design.interrupted);
  ASSERT_TRUE(design.plan);
  EXPECT_TRUE(mechanics::certify(*design.plan).admissible());
}

TEST(Design, InterruptedAtOnceGivesNothingAndEnds) {
  const Design design = gyre::design::design(wings(), 1, [](const Progress&) { return false; });
  EXPECT_TRUE(design.interrupted);
  EXPECT_FALSE(design.plan);
  EXPECT_TRUE(design.conflict.empty()) << "it does not know";
}

}  // namespace
}  // namespace gyre::design
