// The five reference cases, computed independently: the motion to 1e-9, and extremes that are at least as extreme as
// densely sampled ones and within 1e-6 of them.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/mechanics/certificate.hpp"
#include "common/mechanics/grasp.hpp"
#include "tests/mechanics/plans.hpp"
#include "tests/places.hpp"

namespace gyre::mechanics::test {
namespace {

using Json = nlohmann::json;

std::ifstream open(const std::string& file) {
  return std::ifstream(gyre::test::source_directory() + "/tests/data/reference/" + file);
}

class ReferenceCase : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] Plan plan() const { return reference_plan(GetParam()); }
  [[nodiscard]] Json summary() const {
    std::ifstream file = open(std::string(GetParam()) + ".summary.json");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    // The files write NaN where a law has no direction; JSON has another word for what is absent.
    for (std::size_t at = 0; (at = text.find("NaN", at)) != std::string::npos;) text.replace(at, 3, "null");
    return Json::parse(text);
  }
};

std::vector<double> numbers(const std::string& line) {
  std::vector<double> out;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) out.push_back(std::stod(cell));
  return out;
}

/// The columns of the reference files after time and carrier.
std::array<double, 18> columns(const Reference& r) {
  const auto& f = r.force_w_n.value;
  const auto& q = r.direction_w.value;
  const auto& dq = r.direction_w.first;
  const auto& p = r.position_w_m.value;
  const auto& v = r.position_w_m.first;
  return {f.x(),
          f.y(),
          f.z(),
          r.tension_n.value,
          q.x(),
          q.y(),
          q.z(),
          dq.x(),
          dq.y(),
          dq.z(),
          r.length_m.value,
          r.length_m.first,
          p.x(),
          p.y(),
          p.z(),
          v.x(),
          v.y(),
          v.z()};
}

TEST_P(ReferenceCase, the_motion_is_the_reference_to_1e_minus_9) {
  const std::vector<CarrierSlice> all = slices(plan());
  std::ifstream file = open(std::string(GetParam()) + ".csv");
  std::string line;
  std::getline(file, line);
  int rows = 0;
  for (; std::getline(file, line); ++rows) {
    const std::vector<double> row = numbers(line);
    ASSERT_EQ(row.size(), 20U);
    const Reference r = evaluate(all.at(static_cast<std::size_t>(row[1]) - 1), row[0]);
    const std::array<double, 18> ours = columns(r);
    for (std::size_t c = 0; c < ours.size(); ++c) {
      EXPECT_NEAR(ours[c], row[c + 2], 1e-9 * std::max(1.0, std::abs(row[c + 2])))
          << "t " << row[0] << " carrier " << row[1] << " column " << c + 2;
    }
  }
  EXPECT_GT(rows, 90);
}

TEST_P(ReferenceCase, the_particular_force_is_the_pseudo_inverse) {
  const Plan p = plan();
  const ParticularForce ours = particular_force(lever_arms(p), holding_wrench(p.load.mass_kg, p.gravity_m_s2));
  const Json theirs = summary().at("particular_force_N");
  ASSERT_EQ(ours.forces_w_n.size(), theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(ours.forces_w_n[i][static_cast<Eigen::Index>(k)], theirs[i][k].get<double>(), 1e-9);
    }
  }
}

/// An exact greatest value is not below a sampled one, and not above it by more than sampling can miss.
void expect_reaches(double exact, double sampled, const char* what) {
  EXPECT_GE(exact, sampled - 1e-12 * std::max(1.0, std::abs(sampled))) << what;
  EXPECT_LE(exact, sampled + 1e-6) << what;
}

TEST_P(ReferenceCase, the_extremes_hold_the_sampled_ones_tightly) {
  const Certificate certificate = certify(plan());
  const Json s = summary();
  EXPECT_NEAR(certificate.period_s, s.at("period_s").get<double>(), 1e-9);
  for (std::size_t i = 0; i < certificate.carriers.size(); ++i) {
    SCOPED_TRACE(i + 1);
    const CarrierFigures& c = certificate.carriers[i];
    const auto at = [&](const char* key) { return s.at(key).at(i).get<double>(); };
    expect_reaches(-c.tension_n.min, -at("tension_min_N"), "tension min");
    expect_reaches(c.tension_n.max, at("tension_max_N"), "tension max");
    expect_reaches(-c.length_m.min, -at("length_min_m"), "length min");
    expect_reaches(c.length_m.max, at("length_max_m"), "length max");
    expect_reaches(c.winch_rate_max_m_s(), at("winch_rate_max_mps"), "winch rate");
    expect_reaches(-c.speed_m_s.min, -at("speed_min_mps"), "speed min");
    expect_reaches(c.speed_m_s.max, at("speed_max_mps"), "speed max");
    expect_reaches(c.altitude_m.span(), at("altitude_swing_m"), "altitude swing");
    ASSERT_EQ(c.direction_cosine_min.has_value(), !s.at("directional_cosine_min").at(i).is_null());
    if (c.direction_cosine_min) {
      expect_reaches(-*c.direction_cosine_min, -at("directional_cosine_min"), "direction cosine");
    }
  }
}

TEST_P(ReferenceCase, the_formation_keeps_the_reference_separation_and_holds_the_load) {
  CertifyOptions no_swings;  // the cases have no moments of inertia
  no_swings.swings = false;
  const Certificate certificate = certify(plan(), no_swings);
  const Json s = summary();
  EXPECT_NEAR(certificate.separation->min_m, s.at("carrier_separation_min_m").get<double>(), 1e-6);
  EXPECT_LT(certificate.wrench_error_max_n, 1e-12 * plan().load.mass_kg * plan().gravity_m_s2);
  // The pair's cables lie across each other for a quarter of the period; the reference knows nothing of cables.
  const bool crosses = GetParam() == std::string("pair-unrestricted");
  ASSERT_EQ(certificate.reasons.size(), crosses ? 1U : 0U) << certificate.reasons.front().text;
  for (const Reason& reason : certificate.reasons) EXPECT_EQ(reason.rule, Rule::kClearance);
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceCase,
                         ::testing::Values("pair-unrestricted", "paper-fixed", "paper-level", "penta-tilted",
                                           "tri-mixed"));

}  // namespace
}  // namespace gyre::mechanics::test
