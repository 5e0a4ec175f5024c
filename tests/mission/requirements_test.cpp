// Requirements are read by the code that reads missions: what is left out is open, and what is wrong is answered.

#include <gtest/gtest.h>

#include "common/mission/requirements.hpp"
#include "tests/mission/sample_missions.hpp"

namespace gyre::test {
namespace {

using mission::parse_requirements;

const std::string kRequirements = R"(name: "wanted"
load { mass_kg: 6 inertia_kg_m2 { x: 1 y: 1 z: 1 } }
carrier { id: 1 attachment_m { x: 1 } }
carrier { id: 2 attachment_m { y: 1 } level {} }
carrier { id: 3 attachment_m { x: -1 } level { altitude_m: 4 } }
carrier { id: 4 attachment_m { y: -1 } sine { mean_m: 3 } }
want { speed_min_m_s: 2 clearance_min_m: 1 }
limits { length_max_m: 9 speed_min_m_s: 1 }
)";
const std::string kCycle = R"(cycle {
  rate_rad_s: 1
  edge { from: 1 to: 2 amplitude_n: 3 }
  edge { from: 2 to: 3 offset_n: 1 phase_rad: 2 }
  edge { from: 3 to: 4 }
  edge { from: 4 to: 1 }
}
)";

mission::Requirements read(const std::string& text) {
  const Result<mission::Requirements> result = parse_requirements(text, "wanted.textproto");
  EXPECT_TRUE(result) << (result ? "" : result.error().text);
  return result ? result.value() : mission::Requirements();
}

std::string complaints_about(const std::string& text) {
  const Result<mission::Requirements> result = parse_requirements(text, "wanted.textproto");
  return result ? std::string() : result.error().text;
}

TEST(Requirements, WhatIsLeftOutIsOpenAndWhatIsThereIsGiven) {
  const mission::Requirements found = read(kRequirements + kCycle);
  ASSERT_EQ(found.open.laws.size(), 4u);
  EXPECT_TRUE(found.open.laws[0].kind);
  EXPECT_FALSE(found.open.laws[1].kind);
  EXPECT_TRUE(found.open.laws[1].mean);
  EXPECT_FALSE(found.open.laws[2].mean);
  EXPECT_EQ(found.mission.plan.carriers[2].law.profile.mean, 4.0);
  EXPECT_FALSE(found.open.laws[3].mean);
  EXPECT_TRUE(found.open.laws[3].swing && found.open.laws[3].phase);
  EXPECT_FALSE(found.open.rate);
  EXPECT_FALSE(found.open.order);
  ASSERT_EQ(found.open.edges.size(), 4u);
  EXPECT_TRUE(found.open.edges[0].offset && found.open.edges[0].phase && !found.open.edges[0].amplitude);
  EXPECT_TRUE(!found.open.edges[1].offset && !found.open.edges[1].phase && found.open.edges[1].amplitude);
}

TEST(Requirements, AttachmentsAreLeftOutByAllOrByNone) {
  const std::string carriers = "carrier { id: 1 } carrier { id: 2 } carrier { id: 3 }";
  const std::string load = "load { mass_kg: 6 inertia_kg_m2 { x: 1 y: 1 z: 1 }";
  const std::string rest = " want { speed_min_m_s: 2 }";
  EXPECT_TRUE(read(load + " shape { box { x_m: 1 y_m: 1 z_m: 1 } } }" + carriers + rest).open.attachments);
  EXPECT_FALSE(read(kRequirements).open.attachments);
  EXPECT_NE(complaints_about(load + " }" + carriers + rest).find("load.shape: is missing"), std::string::npos);
  const std::string some = "carrier { id: 1 attachment_m { x: 1 } } carrier { id: 2 } carrier { id: 3 }";
  const std::string answer = complaints_about(load + " }" + some + rest);
  EXPECT_NE(answer.find("carrier[1].attachment_m"), std::string::npos) << answer;
  EXPECT_NE(answer.find("carrier[2].attachment_m"), std::string::npos) << answer;
}

TEST(Requirements, WithoutACycleItsRateAndOrderAreOpen) {
  const mission::Requirements found = read(kRequirements);
  EXPECT_TRUE(found.open.rate);
  EXPECT_TRUE(found.open.order);
  EXPECT_FALSE(read(kRequirements + "cycle { rate_rad_s: 1 }").open.rate);
  EXPECT_TRUE(read(kRequirements + "cycle { rate_rad_s: 1 }").open.order);
}

TEST(Requirements, WantedSpeedAndClearanceAreLimitsTheStricterCounts) {
  const mission::Requirements found = read(kRequirements);
  EXPECT_EQ(found.mission.plan.limits.speed_min_m_s, 2.0);
  EXPECT_EQ(found.mission.plan.limits.clearance_min_m, 1.0);
  const std::string slower = replaced(kRequirements, "want { speed_min_m_s: 2", "want { speed_min_m_s: 0.5");
  EXPECT_EQ(read(slower).mission.plan.limits.speed_min_m_s, 1.0);
}

TEST(Requirements, AMissionIsNoneAndNeitherAreTheyAMission) {
  EXPECT_NE(complaints_about(kGoodMission).find("want: is missing"), std::string::npos)
      << complaints_about(kGoodMission);
  const Result<mission::Mission> mission = mission::parse_mission(kRequirements, "wanted.textproto");
  ASSERT_FALSE(mission);
  EXPECT_EQ(mission.error().text.rfind("wanted.textproto:7:", 0), 0u) << mission.error().text;
  EXPECT_NE(mission.error().text.find("gyre design"), std::string::npos) << mission.error().text;
}

struct BadRequirement {
  const char* name;
  const char* what;
  const char* with;
  int line;
  const char* words;
};
void PrintTo(const BadRequirement& bad, std::ostream* out) {
  *out << bad.name;
}

class BadRequirementTest : public ::testing::TestWithParam<BadRequirement> {};

TEST_P(BadRequirementTest, IsAnsweredWithPlaceAndCure) {
  const BadRequirement& bad = GetParam();
  const std::string answer = complaints_about(replaced(kRequirements + kCycle, bad.what, bad.with));
  EXPECT_EQ(answer.rfind("wanted.textproto:" + std::to_string(bad.line) + ":", 0), 0u) << answer;
  EXPECT_NE(answer.find(bad.words), std::string::npos) << answer;
}

constexpr const char* kWant =
    "want { speed_min_m_s: 2 clearance_min_m: 1 }\nlimits { length_max_m: 9 speed_min_m_s: 1 }";

const std::string kWantUpToRate = std::string(kWant) + "\ncycle {\n  rate_rad_s: 1\n";
const char* const kWantAndRate = kWantUpToRate.c_str();

// clang-format off
INSTANTIATE_TEST_SUITE_P(All, BadRequirementTest, ::testing::ValuesIn(std::vector<BadRequirement>{
    {"NoSpeed", kWant, "want {}\n", 7, "standing still costs least"},
    {"EndlessSpeed", kWantAndRate, "want { objective: GREATEST_SPEED }\n\ncycle {\n", 7, "nothing bounds the speed"},
    {"EndlessClearance", kWant, "want { speed_min_m_s: 2 objective: GREATEST_CLEARANCE }\n", 7, "length_max_m"},
    {"Altitudes", "want {", "want { altitude_min_m: 9 altitude_max_m: 8", 7, "altitude_max_m, 8"},
    {"Speeds", "speed_min_m_s: 1 }", "speed_max_m_s: 1 }", 7, "limits.speed_max_m_s, 1"},
    {"Rate", "want {", "want { rate_max_rad_s: 0.5", 7, "below cycle.rate_rad_s, 1"},
    {"Objective", "want {", "want { objective: BEST", 7, "LEAST_EVERYTHING"},
    {"UnknownField", "want {", "want { speed: 3", 7, "speed_min_m_s"},
    {"Negative", "clearance_min_m: 1", "clearance_min_m: -1", 7, "clearance_min_m"},
    {"NotAFlag", "amplitude_n: 3", "amplitude_n: nan", 11, "amplitude_n"},
    {"NoCycle", "edge { from: 4 to: 1 }", "edge { from: 4 to: 2 }", 11, "starts at 1, but the last edge ends at 2"},
}), [](const auto& bad) { return std::string(bad.param.name); });
// clang-format on

}  // namespace
}  // namespace gyre::test
