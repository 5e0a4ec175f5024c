// What a person at the page asks for: every order read, every mistake answered with the field it is in.

#include "ground/page/page_requests.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "common/base/angle.hpp"
#include "tests/ground/heard_swarm.hpp"

namespace gyre::ground {
namespace {

using protocol::CommandKind;
using testing::HasSubstr;
using testing::StartsWith;

std::string complaint_of_order(const std::string& json) {
  const auto order = order_of(json);
  return order ? "none" : order.error().text;
}
std::string complaint_of_hurt(const std::string& json) {
  const auto hurt = hurt_of(json);
  return hurt ? "none" : hurt.error().text;
}
std::string json_with_mission(const std::string& kind, const std::string& text) {
  nlohmann::json json{{"mission", text}};
  if (!kind.empty()) json["kind"] = kind;
  return json.dump();
}

TEST(PageOrders, EveryKindIsRead) {
  EXPECT_EQ(order_of(R"({"kind":"ENGAGE"})").value().kind, CommandKind::kEngage);
  EXPECT_EQ(order_of(R"({"kind":"FREEZE"})").value().kind, CommandKind::kFreeze);
  EXPECT_FALSE(order_of(R"({"kind":"RELEASE"})").value().phase_rad);
  EXPECT_NEAR(order_of(R"({"kind":"RELEASE","phase_deg":90})").value().phase_rad.value_or(0.0), kPi / 2.0, 1e-12);
  EXPECT_EQ(order_of(R"({"kind":"RELEASE","phase_deg":0})").value().phase_rad, 0.0) << "zero is a phase";
  EXPECT_EQ(order_of(R"({"kind":"PACE","pace":0.25})").value().pace, 0.25);
  EXPECT_EQ(order_of(R"({"kind":"PACE","pace":0.25})").value().kind, CommandKind::kPace);
}

TEST(PageOrders, ARetuneCarriesTheMissionAsTheHouseWritesIt) {
  const test::HeardSwarm swarm;
  const auto order = order_of(json_with_mission("RETUNE", "# a remark\n" + swarm.text.text));
  ASSERT_TRUE(order) << order.error().text;
  EXPECT_EQ(order.value().kind, CommandKind::kRetune);
  EXPECT_EQ(order.value().mission, swarm.text.text);
}

TEST(PageOrders, EveryMistakeIsNamed) {
  EXPECT_THAT(complaint_of_order("{}"), StartsWith("kind: "));
  EXPECT_THAT(complaint_of_order(R"({"kind":"NONE"})"), StartsWith("kind: "));
  EXPECT_THAT(complaint_of_order(R"({"kind":17})"), StartsWith("kind: "));
  EXPECT_THAT(complaint_of_order(R"({"kind":"DANCE"})"), HasSubstr("DANCE"));
  for (const char* pace : {"-0.1", "1.1", "1e300", "\"NaN\"", "\"Infinity\""}) {
    EXPECT_THAT(complaint_of_order(std::string(R"({"kind":"PACE","pace":)") + pace + "}"), StartsWith("pace: "))
        << pace;
  }
  for (const char* phase : {"361", "-361", "\"NaN\"", "\"-Infinity\""}) {
    EXPECT_THAT(complaint_of_order(std::string(R"({"kind":"RELEASE","phase_deg":)") + phase + "}"),
                StartsWith("phase_deg: "))
        << phase;
  }
  EXPECT_THAT(complaint_of_order(R"({"kind":"RETUNE"})"), StartsWith("mission:")) << "there is no mission in it";
  EXPECT_THAT(complaint_of_order(json_with_mission("RETUNE", "load { mass_kg: }")), StartsWith("mission:1:"));
}

TEST(PageOrders, WhatIsNoOrderIsSaidToBeNone) {
  for (const char* json : {"", "null", "[]", "7", "{", "{\"kind\":\"ENGAGE\"", "\xff", "{\"kind\":\"ENGAGE\"}x",
                           "{\"kind\":\"ENGAGE\",\"by\":\"me\"}", "{\"pace\":\"fast\"}", "{\"pace\":[1]}"}) {
    EXPECT_THAT(complaint_of_order(json), HasSubstr("not the JSON of a gyre.page.Order")) << json;
    EXPECT_THAT(complaint_of_hurt(json), HasSubstr("not the JSON of a gyre.page.HurtRequest")) << json;
  }
  EXPECT_NE(complaint_of_order(std::string(100'000, '[')), "none") << "nor is one that is nested without end";
  std::string nested = R"({"kind":)";
  for (int i = 0; i < 50'000; ++i) nested += "{\"a\":";
  EXPECT_NE(complaint_of_order(nested), "none");
}

TEST(PageOrders, AMissionThatARetuneCannotCarryIsRefusedWithItsSize) {
  test::HeardSwarm large(100);
  for (mechanics::Carrier& carrier : large.mission.plan.carriers) {
    carrier.radius_m = carrier.vehicle.time_constant_s = 0.0123456789012345;
    carrier.vehicle.mass_kg = carrier.vehicle.thrust_max_n = 10.123456789012345;
  }
  large.text.text = mission::to_text(large.mission);
  ASSERT_GT(large.text.text.size(), protocol::kMaxMissionBytes);
  EXPECT_THAT(complaint_of_order(json_with_mission("RETUNE", large.text.text)),
              testing::AllOf(HasSubstr("bytes are more than the 32768"), HasSubstr("fewer carriers")));
}

TEST(PageChecks, AVerdictSaysWhatGyreCheckSays) {
  const test::HeardSwarm swarm;
  const auto good = verdict_json(json_with_mission("", swarm.text.text));
  ASSERT_TRUE(good) << good.error().text;
  auto json = nlohmann::json::parse(good.value());
  EXPECT_EQ(json["readable"], true);
  EXPECT_EQ(json["name"], "polygon");
  EXPECT_THAT(json["text"].get<std::string>(), HasSubstr("tension"));
  mission::Mission slack = swarm.mission;
  for (auto& edge : slack.plan.cycle.edges) edge.amplitude_n = 100.0;
  slack.plan.limits.tension_max_n = 10.0;
  const auto refused = verdict_json(json_with_mission("", mission::to_text(slack)));
  ASSERT_TRUE(refused);
  json = nlohmann::json::parse(refused.value());
  EXPECT_EQ(json["readable"], true);
  EXPECT_EQ(json["admissible"], false);
  const auto unreadable = verdict_json(json_with_mission("", "load { mass_kg: }"));
  ASSERT_TRUE(unreadable);
  json = nlohmann::json::parse(unreadable.value());
  EXPECT_EQ(json["readable"], false);
  EXPECT_EQ(json["admissible"], false);
  EXPECT_THAT(json["text"].get<std::string>(), HasSubstr("mission:1:"));
  EXPECT_FALSE(verdict_json("{\"text\":\"\"}"));
}

TEST(PageHurts, EveryKindIsRead) {
  const std::vector<std::pair<std::string, HurtKind>> kinds{
      {"KILL", HurtKind::kKill},       {"STOP", HurtKind::kStop}, {"CONTINUE", HurtKind::kContinue},
      {"RESTART", HurtKind::kRestart}, {"LOSE", HurtKind::kLose}, {"SHIFT_CLOCK", HurtKind::kShiftClock}};
  for (const auto& [word, kind] : kinds) {
    const auto hurt = hurt_of(R"({"kind":")" + word + R"(","process":"agent 3","amount":30})");
    ASSERT_TRUE(hurt) << word << ": " << hurt.error().text;
    EXPECT_EQ(hurt.value().kind, kind);
    EXPECT_EQ(hurt.value().process, "agent 3");
    EXPECT_EQ(hurt.value().amount, 30.0);
  }
  const auto push = hurt_of(R"({"kind":"PUSH","force_w_n":[1,-2,3.5],"duration_s":0.5})");
  ASSERT_TRUE(push) << push.error().text;
  EXPECT_EQ(push.value().kind, HurtKind::kPush);
  EXPECT_EQ(push.value().force_w_n, Eigen::Vector3d(1.0, -2.0, 3.5));
  EXPECT_EQ(push.value().duration_s, 0.5);
}

TEST(PageHurts, EveryMistakeIsNamed) {
  EXPECT_THAT(complaint_of_hurt("{}"), StartsWith("kind: "));
  EXPECT_THAT(complaint_of_hurt(R"({"kind":8})"), StartsWith("kind: "));
  EXPECT_THAT(complaint_of_hurt(R"({"kind":-1})"), StartsWith("kind: "));
  EXPECT_THAT(complaint_of_hurt(R"({"kind":"KILL"})"), StartsWith("process: "));
  for (const char* amount : {"-1", "101", "\"NaN\""}) {
    EXPECT_THAT(complaint_of_hurt(std::string(R"({"kind":"LOSE","process":"agent 3","amount":)") + amount + "}"),
                StartsWith("amount: "))
        << amount;
  }
  EXPECT_THAT(complaint_of_hurt(R"({"kind":"SHIFT_CLOCK","process":"agent 3","amount":1e7})"), StartsWith("amount: "));
  EXPECT_EQ(complaint_of_hurt(R"({"kind":"SHIFT_CLOCK","process":"agent 3","amount":-3600})"), "none");
  for (const char* force : {"[]", "[1,2]", "[1,2,3,4]", "[1,2,\"NaN\"]", "[1e308,1e308,0]", "[0,0,2e6]"}) {
    EXPECT_THAT(complaint_of_hurt(std::string(R"({"kind":"PUSH","force_w_n":)") + force + R"(,"duration_s":1})"),
                StartsWith("force_w_n: "))
        << force;
  }
  for (const char* duration : {"-1", "10.5", "\"NaN\"", "\"Infinity\""}) {
    EXPECT_THAT(complaint_of_hurt(std::string(R"({"kind":"PUSH","force_w_n":[1,0,0],"duration_s":)") + duration + "}"),
                StartsWith("duration_s: "))
        << duration;
  }
}

TEST(PageAnswers, AreJson) {
  const auto json = nlohmann::json::parse(answer_json({true, "a \"word\"\nand a line"}));
  EXPECT_EQ(json, (nlohmann::json{{"done", true}, {"text", "a \"word\"\nand a line"}}));
  EXPECT_EQ(nlohmann::json::parse(answer_json({})), (nlohmann::json{{"done", false}, {"text", ""}}));
}

}  // namespace
}  // namespace gyre::ground
