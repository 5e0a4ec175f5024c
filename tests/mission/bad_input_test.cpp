// Every kind of bad mission is answered with the place, what is wrong, and what would be right.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/mission/mission.hpp"
#include "tests/mission/sample_missions.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

std::string complaints_about(const std::string& text) {
  const Result<mission::Mission> result = mission::parse_mission(text, "bad.textproto");
  return result ? std::string() : result.error().text;
}

struct BadInput {
  const char* name;
  const char* what;
  const char* with;
  int line;
  const char* field;
  const char* cure;
};

void PrintTo(const BadInput& bad, std::ostream* out) {
  *out << bad.name;
}

class BadInputTest : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, IsAnsweredWithPlaceAndCure) {
  const BadInput& bad = GetParam();
  const std::string answer = complaints_about(replaced(kGoodMission, bad.what, bad.with));
  const std::string place = "bad.textproto:" + std::to_string(bad.line) + ":";
  bool found = false;
  std::istringstream lines(answer);
  for (std::string line; std::getline(lines, line);) {
    found = found || (line.rfind(place, 0) == 0 && line.find(bad.field) != std::string::npos &&
                      line.find(bad.cure) != std::string::npos);
  }
  EXPECT_TRUE(found) << "expected one line with " << place << ", " << bad.field << " and " << bad.cure << " in:\n"
                     << answer;
}

constexpr const char* kEdge1 = "edge { from: 1 to: 2 offset_n: 6 amplitude_n: 4 phase_rad: 0.1 }";
constexpr const char* kEdge2 = "edge { from: 2 to: 3";
constexpr const char* kEdge4 = "edge { from: 4 to: 1";

// clang-format off
const BadInput kBadInputs[] = {
    {"SyntaxError", "mass_kg: 6", "mass_kg 6", 3, "", "\":\""},
    {"UnclosedBlock", "duration_s: 20 }\nsilence { fly_on {} }\n", "duration_s: 20\n", 25, "ends inside a block", "close every { with a }"},
    {"UnknownField", "mass_kg: 6", "mass: 6", 3, "mass: no such field", "mass_kg"},
    {"UnknownFieldDeepInside", "altitude_m: 14", "height_m: 14", 10, "height_m: no such field", "altitude_m"},
    {"FieldTwice", "mass_kg: 6", "mass_kg: 6 mass_kg: 7", 3, "mass_kg", "multiple times"},
    {"TwoLaws", "level { altitude_m: 14 }", "level { altitude_m: 14 } fixed { length_m: 2 }", 10, "fixed", "level"},
    {"NoLaw", "fixed { length_m: 11 }", "", 11, "carrier[1]", "one of level { altitude_m }, directional"},
    {"ZeroMass", "mass_kg: 6", "mass_kg: 0", 3, "load.mass_kg", "from 1e-06"},
    {"NegativeMass", "mass_kg: 6", "mass_kg: -6", 3, "load.mass_kg", "from 1e-06"},
    {"NotANumber", "mass_kg: 6", "mass_kg: nan", 3, "load.mass_kg: is nan", "give a number"},
    {"Infinite", "mass_kg: 6", "mass_kg: inf", 3, "load.mass_kg: is inf", "give a number"},
    {"Overflowing", "mass_kg: 6", "mass_kg: 1e999", 3, "load.mass_kg: is inf", "give a number"},
    {"Absurd", "mass_kg: 6", "mass_kg: 1e80", 3, "load.mass_kg: is 1e+80", "to 1000000 kg"},
    {"AbsurdPlace", "y: 0.1 z: 0.3", "y: 0.1 z: 1e30", 10, "carrier[0].attachment_m.z", "to 100000 m"},
    {"NanPlace", "y: 0.8 z: 0.35", "y: nan z: 0.35", 11, "carrier[1].attachment_m.y: is nan", "give a number"},
    {"MassMissing", "mass_kg: 6", "", 2, "load.mass_kg: is missing", "give a number"},
    {"InertiaMissing", "inertia_kg_m2 { x: 0.8 y: 0.8 z: 1.2 }", "", 2, "load.inertia_kg_m2: is missing", "give inertia_kg_m2"},
    {"InertiaNegative", "x: 0.8 y: 0.8 z: 1.2", "x: -0.8 y: 0.8 z: 1.2", 4, "load.inertia_kg_m2", "have to be positive"},
    {"InertiaProductsTooLarge", "x: 0.8 y: 0.8 z: 1.2", "x: 0.8 y: 0.8 z: 1.2 xy: 0.9", 4, "load.inertia_kg_m2", "have to be positive"},
    {"InertiaOfNoBody", "x: 0.8 y: 0.8 z: 1.2", "x: 0.8 y: 0.8 z: 1.7", 4, "load.inertia_kg_m2", "sum of the other two"},
    {"NotUnit", "w: 1 x: 0 y: 0 z: 0", "w: 1 x: 1 y: 0 z: 0", 6, "load.orientation: has norm 1.41421356", "w: 0.707106781 x: 0.707106781"},
    {"ZeroQuaternion", "w: 1 x: 0 y: 0 z: 0", "w: 0", 6, "load.orientation: has norm 0", "unit quaternion"},
    {"NoGravity", "gravity_m_s2: 9.81", "gravity_m_s2: 0", 8, "gravity_m_s2", "from 0.001"},
    {"SlackCable", "stiffness_n_m: 1e4", "stiffness_n_m: 0", 9, "cable.stiffness_n_m", "from 0.001"},
    {"DuplicateId", "id: 2 att", "id: 1 att", 11, "carrier[1].id: is 1", "its own id"},
    {"IdZero", "id: 2 att", "id: 0 att", 11, "carrier[1].id: is 0", "from 1 to 100"},
    {"IdTooLarge", "id: 2 att", "id: 101 att", 11, "carrier[1].id: is 101", "from 1 to 100"},
    {"IdNegative", "id: 2 att", "id: -2 att", 11, "", "integer"},
    {"IdMissing", "id: 2 att", "att", 11, "carrier[1].id: is missing", "from 1 to 100"},
    {"AttachmentMissing", "attachment_m { x: 0 y: 0.8 z: 0.35 }", "", 11, "carrier[1].attachment_m: is missing", "body frame"},
    {"NoDirection", "x: 0.3 y: 0.1 z: 2", "", 13, "carrier[3].directional.direction: has no length", "{ x: 0 y: 0 z: 1 }"},
    {"WayOnSilenceUnknown", "length_m: 11 }", "length_m: 11 } vehicle { on_silence: LAND }", 11, "on_silence: is \"LAND\"", "give one of GO_ON, HOLD"},
    {"WayOnSilenceNumbered", "length_m: 11 }", "length_m: 11 } vehicle { on_silence: 2 }", 11, "on_silence: is \"2\"", "give one of GO_ON, HOLD"},
    {"VehicleUnknownField", "length_m: 11 }", "length_m: 11 } vehicle { hold: true }", 11, "hold: no such field", "on_silence"},
    {"NegativeLength", "length_m: 11", "length_m: -11", 11, "carrier[1].fixed.length_m", "from 0"},
    {"NoPeriod", "rate_rad_s: 1.5", "rate_rad_s: 1.4142", 12, "carrier[2].sine.rate_rad_s: is 1.4142 times", "is 1.4"},
    {"NegativeProfileRate", "rate_rad_s: 1.5", "rate_rad_s: -1.5", 12, "carrier[2].sine.rate_rad_s", "from 1e-06"},
    {"ZeroRate", "rate_rad_s: 1\n", "rate_rad_s: 0\n", 15, "cycle.rate_rad_s", "from 1e-06"},
    {"NegativeRate", "rate_rad_s: 1\n", "rate_rad_s: -1\n", 15, "cycle.rate_rad_s", "from 1e-06"},
    {"RateMissing", "rate_rad_s: 1\n", "\n", 14, "cycle.rate_rad_s: is missing", "give a number"},
    {"AmplitudeMissing", "amplitude_n: 4", "", 16, "cycle.edge[0].amplitude_n: is missing", "give a number"},
    {"PhaseMissing", "phase_rad: 0.1", "", 16, "cycle.edge[0].phase_rad: is missing", "give a number"},
    {"Stranger", kEdge2, "edge { from: 2 to: 9", 17, "cycle.edge[1].to: no carrier has id 9", "there are carriers 1, 2, 3 and 4"},
    {"EdgeToItself", kEdge2, "edge { from: 2 to: 2", 17, "cycle.edge[1].to", "two different carriers"},
    {"OutOfOrder", kEdge2, "edge { from: 3 to: 2", 17, "cycle.edge[1].from: starts at 3", "in order of travel"},
    {"VisitedTwice", kEdge4, "edge { from: 3 to: 1", 14, "carrier 3 is visited twice", "visits every carrier exactly once"},
    {"NeverVisited", kEdge4, "edge { from: 3 to: 1", 14, "carrier 4 is visited never", "visits every carrier exactly once"},
    {"EdgeMissing", kEdge1, "", 14, "carrier 1 is visited never", "has 4 edges"},
    {"SameAttachment", "x: 0 y: 0.8 z: 0.35", "x: 0.9 y: 0.1 z: 0.3", 16, "cycle.edge[0]: carriers 1 and 2", "move one of the attachments"},
    {"LimitsCrossed", "tension_min_n: 1", "tension_min_n: 70", 21, "limits.tension_min_n: is 70, above tension_max_n", "raise the one or lower the other"},
    {"NegativeLimit", "length_min_m: 2", "length_min_m: -2", 21, "limits.length_min_m", "from 0"},
    {"NegativeTimeConstant", "time_constant_s: 0.05", "time_constant_s: -1", 22, "winch.time_constant_s", "from 0"},
    {"NegativeWinch", "acceleration_max_m_s2: 9", "acceleration_max_m_s2: -9", 22, "winch.acceleration_max_m_s2", "from 0"},
    {"BoxWithoutHeight", " z_m: 0.35", "", 6, "load.shape.box.z_m: is missing", "give a number"},
    {"BoxTurnedInsideOut", "x_m: 1.8", "x_m: -1.8", 6, "load.shape.box.x_m: is -1.8", "from 1e-06"},
    {"ShapeThatSaysNothing", "box { x_m: 1.8 y_m: 1.7 z_m: 0.35 centre_m { z: 0.075 } }", "", 6, "load.shape: says nothing", "box { x_m"},
    {"HullOfThree", "box { x_m: 1.8 y_m: 1.7 z_m: 0.35 centre_m { z: 0.075 } }", "hull { vertex_m { x: 1 } vertex_m { y: 1 } vertex_m { z: 1 } }", 6, "there are 3", "4 to 64"},
    {"HullWithoutThickness", "box { x_m: 1.8 y_m: 1.7 z_m: 0.35 centre_m { z: 0.075 } }", "hull { vertex_m { x: 1 } vertex_m { y: 1 } vertex_m { x: -1 } vertex_m { y: -1 } }", 6, "in one plane", "thickness"},
    {"AttachedInside", "attachment_m { x: 0 y: 0.8 z: 0.35 }", "attachment_m { x: 0 y: 0.8 z: 0.2 }", 11, "carrier[1].attachment_m: is inside the load's shape", "give a place on it"},
    {"NegativeRadius", "radius_m: 0.4", "radius_m: -0.4", 10, "carrier[0].radius_m", "from 0"},
    {"ThrustOfNoMass", "mass_kg: 2.5", "", 10, "carrier[0].vehicle.thrust_max_n: cannot be judged", "give mass_kg"},
    {"BankBeyondTheHorizon", "bank_max_deg: 35", "bank_max_deg: 120", 10, "carrier[0].vehicle.bank_max_deg: is 120", "to 90 deg"},
    {"NegativeClearance", "clearance_min_m: 0.5", "clearance_min_m: -0.5", 21, "limits.clearance_min_m", "from 0"},
    {"LagsThatRunBackwards", "lag_error: 0.2", "lag_error: -1", 23, "simulation.lag_error", "from -0.9"},
    {"GustWithoutTime", "gust_time_s: 2", "gust_time_s: 0", 23, "simulation.wind.gust_time_s", "from 0.001"},
    {"TransitionTooShort", "duration_s: 20", "duration_s: 0", 24, "transition.duration_s", "from 0.1"},
    {"SilenceAsItWas", "silence { fly_on {} }", "agent_loss: CONTINUE", 25, "agent_loss: is not read any more", "silence { fly_on {} } for CONTINUE"},
    {"SilenceThatSaysNothing", "silence { fly_on {} }", "silence {}", 25, "silence: says nothing", "stop_after_s: 5 or fly_on {}"},
    {"SilenceBothWays", "fly_on {}", "fly_on {} stop_after_s: 5", 25, "stop_after_s", "fly_on"},
    {"SilenceTooShort", "fly_on {}", "stop_after_s: 1.99", 25, "silence.stop_after_s: is 1.99", "from 2 to 600 s"},
    {"SilenceTooLong", "fly_on {}", "stop_after_s: 601", 25, "silence.stop_after_s: is 601", "from 2 to 600 s"},
    {"SilenceNegative", "fly_on {}", "stop_after_s: -5", 25, "silence.stop_after_s: is -5", "from 2 to 600 s"},
    {"SilenceNotANumber", "fly_on {}", "stop_after_s: nan", 25, "silence.stop_after_s: is nan", "give a number"},
    {"SilenceEndless", "fly_on {}", "stop_after_s: inf", 25, "silence.stop_after_s: is inf", "give a number"},
    {"SilenceUnknown", "fly_on {}", "fly {}", 25, "fly: no such field", "fly_on"},
    {"NameEmpty", "\"good\"", "\"\"", 1, "name", "short name"},
    {"NameUnprintable", "\"good\"", "\"a\\nb\"", 1, "name", "short name"},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Table, BadInputTest, ::testing::ValuesIn(kBadInputs),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadInput, TheGoodMissionIsGood) {
  EXPECT_EQ(complaints_about(kGoodMission), "");
}

TEST(BadInput, AllComplaintsComeAtOnce) {
  std::string text = replaced(kGoodMission, "mass_kg: 6", "mass_kg: -6");
  text = replaced(text, "length_m: 11", "length: 11");
  text = replaced(text, kEdge2, "edge { from: 2 to: 9");
  text = replaced(text, "tension_min_n: 1", "tension_min_n: 70");
  const std::string answer = complaints_about(text);
  for (const char* expected : {"load.mass_kg", "length: no such field", "no carrier has id 9", "tension_min_n"}) {
    EXPECT_NE(answer.find(expected), std::string::npos) << expected << " in:\n" << answer;
  }
}

TEST(BadInput, AWrongCycleRateIsOneComplaint) {  // and not one more per profile that is judged against it
  const std::string answer = complaints_about(replaced(kGoodMission, "rate_rad_s: 1\n", "rate_rad_s: -1\n"));
  EXPECT_EQ(std::count(answer.begin(), answer.end(), '\n'), 0) << answer;
}

TEST(BadInput, ManyComplaintsAreCountedNotListed) {
  std::string text = "load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } }\ncycle { rate_rad_s: 1 }\n";
  for (int i = 0; i < 50; ++i) text += "carrier { id: 200 }\n";
  const std::string answer = complaints_about(text);
  EXPECT_EQ(std::count(answer.begin(), answer.end(), '\n'), 20) << answer;
  EXPECT_NE(answer.find("... and 130 more"), std::string::npos) << answer;  // id, attachment and law of each, less 20
}

TEST(BadInput, NoCarriers) {
  const std::string answer =
      complaints_about("load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } } cycle { rate_rad_s: 1 }");
  EXPECT_NE(answer.find("carrier: is missing; a mission has at least one carrier"), std::string::npos) << answer;
}

TEST(BadInput, NoCycleAndNoLoad) {
  const std::string answer = complaints_about("carrier { id: 1 attachment_m {} fixed { length_m: 1 } }");
  EXPECT_NE(answer.find("load: is missing; a mission has load {"), std::string::npos) << answer;
  EXPECT_NE(answer.find("cycle: is missing; a mission has cycle {"), std::string::npos) << answer;
}

TEST(BadInput, TenThousandCarriersAreOneComplaint) {
  std::string text = "load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } } cycle { rate_rad_s: 1 }\n";
  for (int i = 1; i <= 10000; ++i) text += "carrier { id: " + std::to_string(i) + " }\n";
  EXPECT_EQ(complaints_about(text), "bad.textproto: carrier: there are 10000; a mission has at most 100");
}

TEST(BadInput, TwoCarriersHaveOneEdge) {
  const std::string head =
      "load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } }\n"
      "carrier { id: 1 attachment_m { x: 1 } fixed { length_m: 1 } }\n"
      "carrier { id: 2 attachment_m { x: -1 } fixed { length_m: 1 } }\n";
  const std::string there = "edge { from: 1 to: 2 amplitude_n: 1 phase_rad: 0 } ";
  const std::string back = "edge { from: 2 to: 1 amplitude_n: 1 phase_rad: 0 } ";
  EXPECT_EQ(complaints_about(head + "cycle { rate_rad_s: 1 " + there + "}"), "");
  for (const std::string& edges : {std::string(), there + back}) {
    const std::string answer = complaints_about(head + "cycle { rate_rad_s: 1 " + edges + "}");
    EXPECT_NE(answer.find("bad.textproto:4:"), std::string::npos) << answer;
    EXPECT_NE(answer.find("write edge { from: 1 to: 2 }"), std::string::npos) << answer;
  }
}

TEST(BadInput, OneCarrierHasNoEdge) {
  const std::string answer = complaints_about(
      "load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } }\n"
      "carrier { id: 1 attachment_m { x: 1 } fixed { length_m: 1 } }\n"
      "cycle { rate_rad_s: 1 edge { from: 1 to: 1 amplitude_n: 1 phase_rad: 0 } }");
  EXPECT_NE(answer.find("a single carrier has no edge"), std::string::npos) << answer;
}

TEST(BadInput, TwoSeparateCyclesAreNotOne) {
  std::string text = "load { mass_kg: 1 inertia_kg_m2 { x: 1 y: 1 z: 1 } }\n";
  for (int i = 1; i <= 6; ++i) {
    text += "carrier { id: " + std::to_string(i) + " attachment_m { x: " + std::to_string(i * i) +
            " y: " + std::to_string(i) + " } fixed { length_m: 1 } }\n";
  }
  text += "cycle { rate_rad_s: 1\n";
  for (const auto& [from, to] : {std::pair(1, 2), {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}}) {
    text += "edge { from: " + std::to_string(from) + " to: " + std::to_string(to) + " amplitude_n: 1 phase_rad: 0 }\n";
  }
  const std::string answer = complaints_about(text + "}");
  EXPECT_NE(answer.find("bad.textproto:12:"), std::string::npos) << answer;  // 4 -> 5 after 3 -> 1
  EXPECT_NE(answer.find("starts at 4, but the edge before it ends at 1"), std::string::npos) << answer;
}

TEST(BadInput, WhatIsNoMissionAtAll) {
  EXPECT_NE(complaints_about("").find("is empty"), std::string::npos);
  EXPECT_NE(complaints_about(" \n\t\n").find("is empty"), std::string::npos);
  EXPECT_NE(complaints_about(std::string("load\0{", 6)).find("is not text"), std::string::npos);
  EXPECT_NE(complaints_about(std::string(mission::kMaxMissionBytes + 1, '#')).find("larger than 1 MiB"),
            std::string::npos);
  for (const char* block : {"a{", "load{", "a<", "[x]{", "carrier{level{"}) {
    std::string text;
    while (text.size() < 500000) text += block;
    EXPECT_NE(complaints_about(text), "") << block;
  }
}

TEST(BadInput, BracesInCommentsAndNamesAreNotNesting) {
  const std::string braces(100, '{');
  EXPECT_EQ(
      complaints_about("# " + braces + "\n" + replaced(kGoodMission, "\"good\"", "\"" + braces.substr(0, 60) + "\"")),
      "");
}

TEST(BadInput, FilesThatAreNone) {
  const auto complaint = [](const std::string& path) { return mission::read_mission_file(path).error().text; };
  EXPECT_NE(complaint("no/such/file").find("no/such/file: no such file"), std::string::npos);
  EXPECT_NE(complaint(source_directory()).find("is a directory"), std::string::npos);
  EXPECT_NE(complaint("/dev/zero").find("larger than 1 MiB"), std::string::npos);
}

}  // namespace
}  // namespace gyre::test
