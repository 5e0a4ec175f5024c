// The words and the numbers of a certificate, from certificates made by hand.

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "common/base/angle.hpp"
#include "common/mechanics/reference.hpp"
#include "common/mission/mission.hpp"
#include "ground/check/certificate_json.hpp"
#include "ground/check/certificate_table.hpp"
#include "ground/check/motion_csv.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

using ground::certificate_json;
using ground::certificate_table;
using ground::motion_csv;

constexpr protocol::Silence kStop{std::chrono::seconds(7)};
constexpr protocol::Silence kFlyOn{std::nullopt};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

mechanics::Certificate one_bad_carrier() {
  mechanics::CarrierFigures figures;
  figures.id = 7;
  figures.tension_n = {1.25, 3.5};
  figures.length_m = {2.0, kInfinity};
  figures.winch_rate_m_s = {-0.75, 0.5};
  figures.speed_m_s = {0.0, kInfinity};
  figures.acceleration_max_m_s2 = kInfinity;
  figures.altitude_m = {4.0, 4.0};
  figures.vertical_cosine = {0.5, 0.75};
  mechanics::Certificate certificate;
  certificate.period_s = 12.5;
  certificate.carriers = {figures};
  certificate.reasons = {{mechanics::Rule::kDirectionCosine, CarrierId{7}, "carrier 7: word " + std::string(300, 'w')}};
  return certificate;
}

/// The line of the table that starts with these words.
std::string line_of(const std::string& table, const std::string& start) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.find(start) != std::string::npos) return line;
  }
  return {};
}

TEST(Table, VerdictFirst) {
  mechanics::Certificate certificate = one_bad_carrier();
  EXPECT_EQ(certificate_table("m", {}, certificate, kStop).rfind("m: REFUSED, 1 rule broken\n", 0), 0u);
  certificate.reasons.clear();
  EXPECT_EQ(certificate_table("m", {}, certificate, kStop).rfind("m: admissible\n", 0), 0u);
}

TEST(Table, FiguresOutsideTheirLimitsAreMarked) {
  mechanics::Limits limits;
  limits.tension_min_n = 1.0;
  limits.tension_max_n = 3.0;
  limits.winch_rate_max_m_s = 0.8;
  limits.acceleration_max_m_s2 = 5.0;
  limits.vertical_cosine_min = 0.6;
  const std::string table = certificate_table("m", limits, one_bad_carrier(), kStop);
  const std::string row = line_of(table, "carrier 7");
  EXPECT_NE(row.find("1.25 .. 3.5 !"), std::string::npos) << table;
  EXPECT_NE(row.find("2 .. unbounded "), std::string::npos) << table;
  EXPECT_NE(row.find("0.75 "), std::string::npos) << table;
  EXPECT_EQ(row.find("0.75 !"), std::string::npos) << table;
  EXPECT_NE(row.find("unbounded !"), std::string::npos) << table;
  EXPECT_NE(row.find("0.5 !"), std::string::npos) << table;
  const std::string limit_row = line_of(table, "limit");
  EXPECT_NE(limit_row.find("1 .. 3"), std::string::npos) << table;
  EXPECT_NE(limit_row.find("<= 0.8"), std::string::npos) << table;
  EXPECT_NE(limit_row.find(">= 0.6"), std::string::npos) << table;
}

TEST(Table, EveryRuleIsNamedWithItsText) {
  const std::string table = certificate_table("m", {}, one_bad_carrier(), kStop);
  EXPECT_NE(table.find("- direction cosine: carrier 7: word"), std::string::npos) << table;
}

TEST(Table, WhatWasNotComputedIsADash) {
  mechanics::Certificate certificate = one_bad_carrier();
  for (const char* line : {"  separation ", "  cables apart ", "  clearance ", "  load stiffness ", "  swings ",
                           "  clock skew ", "  winches ", "  vehicles ", "  lag "}) {
    const std::string dash = line_of(certificate_table("m", {}, certificate, kStop), line);
    EXPECT_EQ(dash.find_first_not_of(' ', std::string(line).size()), dash.size() - 1) << dash;
    EXPECT_EQ(dash.back(), '-') << dash;
  }
  certificate.separation = mechanics::Approach{2.5, mechanics::Touch::kPlaces, 3, 4, 0.1};
  certificate.clearance = mechanics::Approach{0.5, mechanics::Touch::kCableAndLoad, 2, 0, 0.1};
  certificate.above_load_min_m = 7.0;
  certificate.stiffness_min_1_s2 = 1.5;
  certificate.skew = mechanics::SkewBudget{1.0, 2.0, 0.5, 9.0};
  const std::string table = certificate_table("m", {}, certificate, kStop);
  EXPECT_NE(line_of(table, "  separation ").find("2.5 m, carriers 3 and 4"), std::string::npos) << table;
  EXPECT_NE(line_of(table, "  clearance ").find("0.5 m, the cable of carrier 2 and the load; vehicles 7 m above"),
            std::string::npos)
      << table;
  mechanics::Limits limits;
  limits.clearance_min_m = 0.6;
  EXPECT_NE(line_of(certificate_table("m", limits, certificate, kStop), "  clearance ").find("(limit >= 0.6) !"),
            std::string::npos);
  EXPECT_NE(line_of(table, "  load stiffness ").find("1.5 1/s^2"), std::string::npos) << table;
  EXPECT_NE(line_of(table, "  clock skew ").find("up to 500 ms"), std::string::npos) << table;
}

TEST(Table, SwingsAreToldAsTheyAreAndWithAMargin) {
  mechanics::Certificate certificate = one_bad_carrier();
  const auto line = [&](double growth_1_s, double worst_1_s) {
    certificate.swings = mechanics::Swings{growth_1_s, worst_1_s, {}};
    return line_of(certificate_table("m", {}, certificate, kStop), "  swings ");
  };
  EXPECT_EQ(
      line(-0.02, -0.01),
      "  swings             all die out, the slowest by 0.02 1/s; within 5 % of rate and inertia all die out, the "
      "slowest by 0.01 1/s");
  EXPECT_EQ(line(-1e-5, 0.2), "  swings             none grows; within 5 % of rate and inertia one grows by 0.2 1/s !");
}

TEST(Table, SaysWhatMachinesHaveToDoAtTheirWorst) {
  mechanics::Certificate certificate = one_bad_carrier();
  mechanics::CarrierFigures other;
  other.paid_out_m = {1.0, 2.5};
  other.paid_out_rate_m_s = {-0.5, 0.25};
  other.winch_acceleration_max_m_s2 = 0.125;
  other.thrust_max_n = 40.0;
  other.bank_max_rad = radians(30.0);
  certificate.carriers = {other};
  certificate.lag_error_displacement_m = 0.0015;
  const std::string table = certificate_table("m", {}, certificate, kStop);
  EXPECT_EQ(line_of(table, "  winches "), "  winches            pay out 1 .. 2.5 m, by up to 0.5 m/s and 0.125 m/s^2");
  EXPECT_EQ(line_of(table, "  vehicles "), "  vehicles           pull up to 40 N, at up to 30 degrees");
  EXPECT_EQ(line_of(table, "  lag "), "  lag                lags that are 20 % off move the load by 1.5 mm");
  const auto json = certificate_json("m", certificate, kStop);
  EXPECT_EQ(json.at("lag_error_displacement_m"), 0.0015);
  const auto& carrier = json.at("carriers")[0];
  EXPECT_EQ(carrier.at("winch_paid_out_min_m"), 1.0);
  EXPECT_EQ(carrier.at("winch_paid_out_max_m"), 2.5);
  EXPECT_EQ(carrier.at("winch_paid_out_rate_max_m_s"), 0.5);
  EXPECT_EQ(carrier.at("winch_acceleration_max_m_s2"), 0.125);
  EXPECT_EQ(carrier.at("thrust_max_n"), 40.0);
  EXPECT_NEAR(carrier.at("bank_max_deg").get<double>(), 30.0, 1e-12);
}

TEST(Table, ToldWhatSilenceDoesAndHowLongFlyingOnIsGood) {
  mechanics::Certificate certificate = one_bad_carrier();
  const auto line = [&](const protocol::Silence& silence) {
    return line_of(certificate_table("m", {}, certificate, silence), "  silence ");
  };
  certificate.skew = mechanics::SkewBudget{1.0, 2.0, 0.5, 90.0};
  EXPECT_EQ(line(kStop), "  silence            all stop together after 7 s");
  EXPECT_EQ(
      line(kFlyOn),
      "  silence            all fly on, and the clock skew stays within its bound for 90 s with clocks 20 ppm apart");
  certificate.skew->holdover_s = kInfinity;
  EXPECT_EQ(line(kFlyOn), "  silence            all fly on");
  certificate.skew.reset();
  EXPECT_EQ(line(kFlyOn), "  silence            all fly on");
}

TEST(Json, TellsWhenAllStop) {
  EXPECT_EQ(certificate_json("m", one_bad_carrier(), kStop).at("silence_stop_after_s"), 7.0);
  EXPECT_TRUE(certificate_json("m", one_bad_carrier(), kFlyOn).at("silence_stop_after_s").is_null());
}

TEST(Json, WhatIsInfiniteOrAbsentIsNull) {
  const nlohmann::ordered_json json = certificate_json("m", one_bad_carrier(), kStop);
  EXPECT_EQ(json.at("verdict"), "refused");
  EXPECT_EQ(json.at("reasons")[0].at("rule"), "direction cosine");
  EXPECT_EQ(json.at("reasons")[0].at("carrier"), 7);
  for (const char* key :
       {"carrier_separation_min_m", "carrier_separation_pair", "cable_distance_min_m", "cable_distance_pair",
        "clearance_min_m", "clearance_of", "clearance_pair", "clearance_at_s", "above_load_min_m", "stiffness_min_1_s2",
        "swing_growth_1_s", "swing_growth_worst_1_s", "swing_paces", "skew_budget_s", "skew_residual_n_per_s",
        "skew_displacement_m_per_s", "skew_moment_n_m_per_s", "lag_error_displacement_m", "holdover_s"}) {
    EXPECT_TRUE(json.at(key).is_null()) << key;
  }
  const auto& carrier = json.at("carriers")[0];
  EXPECT_EQ(carrier.at("length_min_m"), 2.0);
  EXPECT_TRUE(carrier.at("length_max_m").is_null());
  EXPECT_TRUE(carrier.at("speed_max_m_s").is_null());
  for (const char* key : {"direction_cosine_min", "thrust_max_n", "bank_max_deg"})
    EXPECT_TRUE(carrier.at(key).is_null());
  EXPECT_EQ(carrier.at("winch_rate_max_m_s"), 0.75);  // reeling in counts as much as paying out
}

TEST(Json, HasTheGrowthAtEveryPaceThatWasLookedAt) {
  mechanics::Certificate certificate = one_bad_carrier();
  certificate.swings = mechanics::Swings{-0.5, 0.25, {{0.0, 0.0}, {0.75, 0.125}, {1.0, -0.5}}};
  const nlohmann::ordered_json json = certificate_json("m", certificate, kStop);
  EXPECT_EQ(json.at("swing_growth_1_s"), -0.5);
  EXPECT_EQ(json.at("swing_growth_worst_1_s"), 0.25);
  ASSERT_EQ(json.at("swing_paces").size(), 3U);
  EXPECT_EQ(json.at("swing_paces")[1].at("pace"), 0.75);
  EXPECT_EQ(json.at("swing_paces")[1].at("growth_1_s"), 0.125);
}

TEST(Csv, NumbersReadBackToTheSameBits) {
  const auto mission = mission::read_mission_file(source_directory() + "/deploy/missions/tri-mixed.textproto");
  ASSERT_TRUE(mission.ok());
  const mechanics::Plan& plan = mission.value().plan;
  std::istringstream lines(motion_csv(plan, 3));
  std::string line;
  for (int skipped = 0; skipped < 5; ++skipped)
    std::getline(lines, line);  // header, three carriers, then t = period / 2
  std::istringstream cells(line);
  std::vector<double> row;
  for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  ASSERT_EQ(row.size(), 20u);
  const double t_s = mechanics::period_s(plan) / 2;
  const mechanics::Reference now = mechanics::evaluate(mechanics::slices(plan)[0], t_s);
  EXPECT_EQ(row[0], t_s);
  EXPECT_EQ(row[1], 1.0);
  EXPECT_EQ(row[5], now.tension_n.value);
  EXPECT_EQ(row[13], now.length_m.first);
  EXPECT_EQ(row[16], now.position_w_m.value.z());
  EXPECT_EQ(row[19], now.position_w_m.first.z());
}

}  // namespace
}  // namespace gyre::test
