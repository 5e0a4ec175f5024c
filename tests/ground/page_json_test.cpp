// What the page is told, as idl/page.proto says it: every field there, numbers that are none as words, triples as
// three.

#include "ground/page/page_json.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "common/mechanics/load_hull.hpp"
#include "ground/page/metrics.hpp"
#include "tests/ground/heard_swarm.hpp"
#include "tests/places.hpp"

namespace gyre::ground {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::HeardSwarm;

/// The schema: of each message its fields, and of each field its type. Optional ones are left out.
using Fields = std::map<std::string, std::string>;
std::map<std::string, Fields> schema() {
  std::ifstream file(gyre::test::source_directory() + "/idl/page.proto");
  const std::regex begin(R"(message (\w+) \{)"), field(R"(\s*(repeated )?(\w+) (\w+) = \d+;.*)");
  std::map<std::string, Fields> messages;
  std::string message;
  std::smatch found;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, found, begin)) {
      message = found[1];
    } else if (std::regex_match(line, found, field)) {
      messages[message][found[3]] = found[2];
    }
  }
  return messages;
}

/// Whether `told` has the fields of the message, all of them and no other, down to the last one within.
void expect_whole(const json& told, const std::string& message) {
  static const auto kMessages = schema();
  const Fields& fields = kMessages.at(message);
  ASSERT_TRUE(told.is_object()) << message;
  for (const auto& [name, type] : fields) {
    // Protobuf leaves out a message that was never set: a page has to do without.
    if (kMessages.count(type) > 0 && !told.contains(name)) continue;
    ASSERT_TRUE(told.contains(name)) << message << "." << name;
    if (kMessages.count(type) == 0) continue;
    if (!told[name].is_array()) {
      expect_whole(told[name], type);
    } else {
      for (const json& one : told[name]) expect_whole(one, type);
    }
  }
  for (const auto& [name, value] : told.items()) EXPECT_EQ(fields.count(name), 1U) << message << "." << name;
}

std::vector<double> numbers(const json& list) {
  return list.get<std::vector<double>>();
}

class PageJsonTest : public testing::Test {
 protected:
  PageJsonTest() {
    swarm_.mission.plan.load.hull_b_m = mechanics::box_hull({0.5, 0.4, 0.1}, Eigen::Vector3d::Zero());
    swarm_.mission.plan.limits.tension_min_n = 0.5;
    swarm_.text.text = mission::to_text(swarm_.mission);
    swarm_.tell_all(view_);
    known_ = know(swarm_.text);
  }
  [[nodiscard]] Shown shown() const { return {view_, known_ ? &*known_ : nullptr, swarm_.now, LocalTime(seconds(90))}; }
  [[nodiscard]] json frame(const LoadWindow& window = {}) const { return json::parse(frame_json(shown(), window)); }
  [[nodiscard]] json mission() const { return json::parse(mission_json(shown())); }
  [[nodiscard]] json status(const std::vector<OwnProcess>& own = {}) const {
    return json::parse(status_json(shown(), std::nullopt, LoadWindow{}, own, std::nullopt));
  }
  static json process(const json& status, const std::string& name) {
    for (const json& one : status["processes"]) {
      if (one["name"] == name) return one;
    }
    return {};
  }

  HeardSwarm swarm_;
  SwarmView view_;
  std::optional<KnownMission> known_;
};

TEST_F(PageJsonTest, TheSchemaIsReadAtAll) {
  EXPECT_EQ(schema().at("Range").size(), 2U);
  EXPECT_EQ(schema().at("Frame").at("carriers"), "FrameCarrier");
}

TEST_F(PageJsonTest, EveryFieldOfEveryMessageIsThere) {
  expect_whole(json::parse(hello_json({"s", 3, true, false, ""})), "Hello");
  expect_whole(mission(), "Mission");
  expect_whole(frame(), "Frame");
  expect_whole(status(), "Status");
  known_.reset();
  expect_whole(mission(), "Mission");
  view_ = SwarmView();
  expect_whole(mission(), "Mission");
  expect_whole(frame(), "Frame");
  expect_whole(status(), "Status");
  expect_whole(json::parse(happening_json({})), "Happening");
}

TEST_F(PageJsonTest, HelloTellsWhatTheServerIs) {
  const json hello = json::parse(hello_json({"abc", 42, false, true, "paper.textproto"}));
  EXPECT_EQ(hello, (json{{"server", "abc"},
                         {"domain", 42},
                         {"takes_orders", false},
                         {"owns_processes", true},
                         {"mission_file", "paper.textproto"}}));
}

TEST_F(PageJsonTest, AKnownMissionIsWhole) {
  const json told = mission();
  EXPECT_EQ(told["complete"], true);
  EXPECT_EQ(told["name"], "polygon");
  EXPECT_EQ(told["plan"], "1.2");
  EXPECT_EQ(numbers(told["position_w_m"]), (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_EQ(numbers(told["orientation_w_b"]), (std::vector<double>{1.0, 0.0, 0.0, 0.0})) << "w first";
  EXPECT_EQ(told["hull_b_m"].size(), 24U);
  EXPECT_EQ(told["hull_faces"].size(), 36U);
  ASSERT_EQ(told["carriers"].size(), 4U);
  EXPECT_EQ(numbers(told["carriers"][0]["attachment_b_m"]), (std::vector<double>{2.0, 0.0, 0.3}));
  EXPECT_EQ(told["carriers"][0]["orbit_w_m"].size(), 3U * 128U);
  EXPECT_NEAR(told["carriers"][0]["certified"]["altitude_m"]["min"].get<double>(), 3.0, 1e-6) << "level";
}

TEST_F(PageJsonTest, ABoundThatIsNotThereIsAWord) {
  const json limits = mission()["limits"];
  EXPECT_EQ(limits["tension_n"]["min"], 0.5);
  EXPECT_EQ(limits["tension_n"]["max"], "Infinity");
  EXPECT_EQ(limits["winch_rate_m_s"]["min"], "-Infinity");
  EXPECT_EQ(limits["altitude_m"]["min"], "-Infinity");
  known_.reset();
  EXPECT_EQ(mission()["clearance_m"], "Infinity");
}

TEST_F(PageJsonTest, WithoutItsTextAMissionIsWhatTheAgentsHoldOfIt) {
  const json whole = mission();
  known_.reset();
  const json told = mission();
  EXPECT_EQ(told["complete"], false);
  EXPECT_EQ(told["name"], "polygon");
  EXPECT_TRUE(told["hull_b_m"].empty());
  EXPECT_NEAR(told["period_s"].get<double>(), whole["period_s"].get<double>(), 1e-9);
  ASSERT_EQ(told["carriers"].size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto here = numbers(told["carriers"][i]["orbit_w_m"]), there = numbers(whole["carriers"][i]["orbit_w_m"]);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t k = 0; k < here.size(); ++k) EXPECT_NEAR(here[k], there[k], 2e-6);
    EXPECT_EQ(told["carriers"][i]["attachment_b_m"].size(), 3U);
  }
}

TEST_F(PageJsonTest, AFrameSaysWhereEverybodyIsAndShouldBe) {
  swarm_.vehicles.at(2).position_w_m.z() += 0.25;
  view_.step(swarm_.now, swarm_.vehicles.at(2));
  LoadWindow window;
  window.samples = 4;
  window.displacement_max_m = 0.002;
  window.displaced_w_m = {0.0, -0.002, 0.0};
  window.rotation_max_deg = 0.1;
  window.residual_max = 1e-4;
  const json told = frame(window);
  EXPECT_EQ(told["server_time_s"], 10.0);
  EXPECT_EQ(told["swarm_time_s"], 5000.0);
  EXPECT_EQ(told["pace"], 1.0);
  EXPECT_EQ(numbers(told["load_w_m"]), (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_EQ(numbers(told["load_orientation_w_b"]), (std::vector<double>{1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(numbers(told["displacement_w_m"]), (std::vector<double>{0.0, -0.002, 0.0}));
  EXPECT_EQ(told["rotation_deg"], 0.1);
  EXPECT_EQ(told["residual"], 1e-4);
  ASSERT_EQ(told["carriers"].size(), 4U);
  const json& two = told["carriers"][1];
  EXPECT_EQ(two["id"], 2);
  EXPECT_EQ(two["heard"], true);
  EXPECT_NEAR(two["position_w_m"][2].get<double>() - two["planned_w_m"][2].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(two["deviation_m"].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(told["carriers"][0]["deviation_m"].get<double>(), 0.0, 1e-9);
  EXPECT_EQ(two["tension_n"], 5.0);
  EXPECT_NEAR(two["speed_m_s"].get<double>(), swarm_.vehicles.at(2).velocity_w_m_s.norm(), 1e-12);
  const double turns = told["plan_time_s"].get<double>() / known_->certificate.period_s;
  EXPECT_NEAR(told["phase_rad"].get<double>(), 2.0 * kPi * (turns - std::floor(turns)), 1e-6);
}

TEST_F(PageJsonTest, WhatWasNeverHeardIsEmptyNegativeOrAWord) {
  view_ = SwarmView();
  known_.reset();
  const json told = frame();
  EXPECT_EQ(told["swarm_time_s"], -1.0);
  EXPECT_TRUE(told["load_w_m"].empty());
  EXPECT_TRUE(told["displacement_w_m"].empty());
  EXPECT_TRUE(told["carriers"].empty());
  EXPECT_EQ(told["closest_m"], "Infinity");
  EXPECT_TRUE(told["closest"].empty());
  view_.step(swarm_.now, swarm_.status);
  const json one = frame()["carriers"][0];
  EXPECT_EQ(one["heard"], false);
  EXPECT_TRUE(one["position_w_m"].empty());
  EXPECT_TRUE(one["planned_w_m"].empty());
}

TEST_F(PageJsonTest, TheClosestTwoAreOfThoseThatAreHeard) {
  const auto place = [this](CarrierId id, double x) {
    swarm_.vehicles.at(id).position_w_m = {x, 0.0, 5.0};
    view_.step(swarm_.now, swarm_.vehicles.at(id));
  };
  place(1, 0.0), place(2, 3.0), place(3, 4.5), place(4, 10.0);
  EXPECT_EQ(frame()["closest_m"], 1.5);
  EXPECT_EQ(frame()["closest"], (json{2, 3}));
  swarm_.pass(seconds(2));
  place(1, 0.0), place(3, 4.5), place(4, 10.0);
  EXPECT_EQ(frame()["closest_m"], 4.5) << "nobody knows where carrier 2 is";
  EXPECT_EQ(frame()["closest"], (json{1, 3}));
  EXPECT_EQ(frame()["carriers"][1]["heard"], false);
}

TEST_F(PageJsonTest, AStatusHasEachProcessAndWhatIsMissing) {
  json told = status();
  EXPECT_EQ(told["connected"], true);
  EXPECT_EQ(told["calm"], true);
  EXPECT_EQ(told["complaint"], "");
  EXPECT_EQ(told["course"], "motion");
  EXPECT_EQ(told["term"], "1") << "64 bits are a string in Protobuf's mapping";
  EXPECT_EQ(told["lease_left_s"], 5.0);
  EXPECT_EQ(told["skew_s"], 0.001);
  EXPECT_EQ(told["skew_budget_s"], 0.01);
  EXPECT_TRUE(told["missing"].empty());
  const json agent = process(told, "agent 2");
  EXPECT_EQ(agent["state"], "flying");
  EXPECT_EQ(agent["well"], true);
  EXPECT_EQ(agent["plan"], "the mission's");
  EXPECT_EQ(agent["carrier"], 2);
  EXPECT_EQ(agent["heard_age_s"], 0.0);
  EXPECT_NEAR(agent["clock_uncertainty_s"].get<double>(), 5e-5, 1e-12);
  EXPECT_EQ(agent["pid"], 0);
  EXPECT_EQ(process(told, "coordinator")["clock_uncertainty_s"], -1.0);
  swarm_.status.carriers.push_back(7);
  swarm_.beacon.course.lease.reset();
  view_.step(swarm_.now, swarm_.status);
  view_.step(swarm_.now, swarm_.beacon);
  told = status();
  EXPECT_EQ(process(told, "agent 7")["heard_age_s"], -1.0);
  EXPECT_EQ(told["missing"], (json{{{"who", "agent 7"}, {"what", "is not heard"}}}));
  EXPECT_EQ(told["lease_left_s"], "Infinity");
}

TEST_F(PageJsonTest, OwnProcessesHaveAPidOrHaveEndedOrHang) {
  const json told = status({{"agent 1", 4711, false}, {"agent 2", 0, false}, {"agent 3", 4713, true}});
  EXPECT_EQ(process(told, "agent 1")["pid"], 4711);
  EXPECT_EQ(process(told, "agent 1")["state"], "flying");
  EXPECT_EQ(process(told, "agent 2")["state"], "ended");
  EXPECT_EQ(process(told, "agent 2")["well"], false);
  EXPECT_EQ(process(told, "agent 3")["state"], "stopped");
  EXPECT_EQ(process(told, "agent 3")["well"], false);
}

TEST_F(PageJsonTest, AnOwnProcessThatWasNeverHeardHasALineAllTheSame) {
  const json told = status({{"simulator", 0, false}, {"agent 1", 4711, false}});
  EXPECT_EQ(process(told, "simulator")["state"], "ended") << "or nobody could start it again";
  EXPECT_EQ(process(told, "simulator")["well"], false);
}

TEST_F(PageJsonTest, AHurtIsToldWithWhatCameOfIt) {
  HurtOutcome hurt{3, "agent 3 was killed", seconds(2), 0.001, 0.004, milliseconds(1500)};
  const auto told = [&] { return json::parse(status_json(shown(), "it is", {}, {}, hurt)); };
  EXPECT_EQ(told()["hurt"], (json{{"number", "3"},
                                  {"text", "agent 3 was killed"},
                                  {"since_s", 2.0},
                                  {"before_m", 0.001},
                                  {"moved_max_m", 0.004},
                                  {"calm_after_s", 1.5}}));
  EXPECT_EQ(told()["calm"], false);
  EXPECT_EQ(told()["complaint"], "it is");
  hurt.calm_after.reset();
  EXPECT_EQ(told()["hurt"]["calm_after_s"], -1.0);
  EXPECT_EQ(status()["hurt"]["number"], "0") << "nothing was hurt yet";
}

TEST_F(PageJsonTest, HappeningsHaveALevelInAWord) {
  Happening one{7, SwarmTime(seconds(12)), Notice::Level::kWarning, "agent 3", "line\nbreak and \"quotes\""};
  json told = json::parse(happening_json(one));
  EXPECT_EQ(told["number"], "7");
  EXPECT_EQ(told["swarm_time_s"], 12.0);
  EXPECT_EQ(told["level"], "WARNING");
  EXPECT_EQ(told["text"], one.text);
  EXPECT_EQ(happening_json(one).find('\n'), std::string::npos) << "a line of a stream";
  one.level = Notice::Level::kError;
  one.at.reset();
  told = json::parse(happening_json(one));
  EXPECT_EQ(told["level"], "ERROR");
  EXPECT_EQ(told["swarm_time_s"], -1.0);
}

TEST_F(PageJsonTest, BytesThatAreNoTextMakeNoHarm) {
  const std::string bytes = "caf\xe9 \xff\xc0\x80 \xed\xa0\x80";
  swarm_.status.news = swarm_.status.mission = bytes;
  swarm_.agents.at(1).address = bytes;
  view_.step(swarm_.now, swarm_.status);
  view_.step(swarm_.now, swarm_.agents.at(1));
  view_.step(swarm_.now, HeardSwarm::health("agent 2", bytes));
  view_.step(swarm_.now, HeardSwarm::health(bytes, bytes));
  known_.reset();
  testing::internal::CaptureStderr();
  const json told = status();  // throws where it is no UTF-8
  EXPECT_EQ(told["news"].get<std::string>().substr(0, 3), "caf");
  EXPECT_EQ(process(told, "agent 1")["carrier"], 1);
  EXPECT_EQ(mission()["name"].get<std::string>().substr(0, 3), "caf");
  const json line = json::parse(happening_json({1, std::nullopt, Notice::Level::kInfo, bytes, bytes}));
  EXPECT_EQ(line["who"], "caf? ??? ???");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "nor may anybody fill the log";
  const std::string words = "z\u00e9\u20ac\U0001F681";
  EXPECT_EQ(json::parse(happening_json({1, std::nullopt, Notice::Level::kInfo, words, ""}))["who"], words);
}

TEST_F(PageJsonTest, TimeIsInSeconds) {
  EXPECT_EQ(json::parse(time_json(1.5)), (json{{"server_time_s", 1.5}}));
}

// ------------------------------------------------------------------------------------------------------ for Prometheus

class MetricsTest : public PageJsonTest {
 protected:
  /// Every sample of the text, "name{labels}" -> value; each line has to be a sample or a comment.
  std::map<std::string, double> samples(const LoadWindow& window = {}) const {
    std::istringstream text(metrics_text(view_, known_ ? &*known_ : nullptr, window, std::nullopt, swarm_.now));
    const std::regex sample(R"(([a-z_]+(\{[a-z]+="[^"]*"(,[a-z]+="[^"]*")*\})?) (\S+))");
    std::map<std::string, double> samples;
    std::smatch found;
    for (std::string line; std::getline(text, line);) {
      if (line.empty() || line[0] == '#') continue;
      EXPECT_TRUE(std::regex_match(line, found, sample)) << line;
      samples[found[1]] = std::stod(found[4]);
    }
    return samples;
  }
};

TEST_F(MetricsTest, TellWhatIsHeard) {
  view_.step(swarm_.now, HeardSwarm::health("agent 2"));
  LoadWindow window;
  window.samples = 100;
  window.displacement_max_m = 0.003;
  const auto told = samples(window);
  EXPECT_EQ(told.at("gyre_calm"), 1.0);
  EXPECT_EQ(told.at("gyre_pace"), 1.0);
  EXPECT_EQ(told.at("gyre_coordinator_term"), 1.0);
  EXPECT_EQ(told.at("gyre_load_displacement_meters"), 0.003);
  EXPECT_EQ(told.at("gyre_cable_tension_newtons{carrier=\"3\"}"), 5.0);
  EXPECT_EQ(told.at("gyre_cable_tension_margin_newtons{carrier=\"3\"}"), 4.5);
  EXPECT_EQ(told.at("gyre_process_well{process=\"agent 1\"}"), 1.0);
  EXPECT_EQ(told.count("gyre_process_dropped{process=\"agent 2\",reason=\"late\"}"), 1U);
}

TEST_F(MetricsTest, WhatIsNotHeardAnyMoreIsNotTold) {
  samples({});
  swarm_.pass(seconds(5));
  swarm_.vehicles.erase(3);
  swarm_.agents.erase(3);
  for (const auto& [id, vehicle] : swarm_.vehicles) view_.step(swarm_.now, vehicle);
  view_.step(swarm_.now, swarm_.beacon);
  const auto told = samples();
  EXPECT_EQ(told.count("gyre_cable_tension_newtons{carrier=\"1\"}"), 1U);
  EXPECT_EQ(told.count("gyre_cable_tension_newtons{carrier=\"3\"}"), 0U) << "an old figure is a wrong one";
  EXPECT_EQ(told.count("gyre_load_displacement_meters"), 0U);
  EXPECT_EQ(told.at("gyre_process_well{process=\"agent 3\"}"), 0.0);
}

TEST_F(MetricsTest, AClockThatNobodyKnowsHasNoFigure) {
  swarm_.status.skew = std::chrono::hours(24 * 365);
  swarm_.agents.at(1).clock_uncertainty = std::chrono::hours(24 * 365);
  view_.step(swarm_.now, swarm_.status);
  view_.step(swarm_.now, swarm_.agents.at(1));
  const auto told = samples();
  EXPECT_EQ(told.count("gyre_clock_skew_seconds"), 0U);
  EXPECT_EQ(told.count("gyre_agent_clock_uncertainty_seconds{carrier=\"1\"}"), 0U);
  EXPECT_EQ(told.count("gyre_agent_clock_uncertainty_seconds{carrier=\"2\"}"), 1U);
}

TEST_F(MetricsTest, NamesOnTheWireBreakNoLine) {
  view_.step(swarm_.now, HeardSwarm::health("a\"b\\c\nd", "x"));
  std::istringstream text(metrics_text(view_, nullptr, {}, std::nullopt, swarm_.now));
  for (std::string line; std::getline(text, line);) {
    EXPECT_TRUE(line.rfind("gyre_", 0) == 0 || line.rfind("# ", 0) == 0) << line;
  }
}

}  // namespace
}  // namespace gyre::ground
