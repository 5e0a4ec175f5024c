// What the shell sees of `gyre check` and `gyre sample`: exit codes, the JSON contract, messages.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/ground/gyre_command.hpp"
#include "tests/places.hpp"

namespace gyre::test {
namespace {

using Json = nlohmann::json;

TEST(Check, AdmissibleIsZero) {
  const Answer answer = gyre("check " + shipped("paper"));
  EXPECT_EQ(answer.exit_code, 0) << answer.complaint;
  EXPECT_EQ(answer.output.rfind("paper: admissible\n", 0), 0u) << answer.output;
}

TEST(Check, RefusedIsOneAndSaysWhyAndWhatCures) {
  const Answer answer = gyre("check " + shipped("pair-level"));
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_EQ(answer.output.rfind("pair-level: REFUSED", 0), 0u) << answer.output;
  EXPECT_NE(answer.output.find("two-carrier obstruction: "), std::string::npos) << answer.output;
  EXPECT_NE(answer.output.find("add a third"), std::string::npos) << answer.output;
}

TEST(Check, CablesThatBraidAreRefusedInWords) {
  const Answer answer = gyre("check " + source_directory() + "/tests/data/missions/fixed-wing-braid.textproto");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_NE(answer.output.find("braid: carriers 1 and 2 wind around each other once per period"), std::string::npos)
      << answer.output;
  EXPECT_NE(answer.output.find("enclose each other"), std::string::npos) << answer.output;
}

TEST(Check, JsonKeepsItsContract) {
  const Answer answer = gyre("check --json " + shipped("tri-mixed"));
  ASSERT_EQ(answer.exit_code, 0) << answer.complaint;
  const Json json = Json::parse(answer.output);
  EXPECT_EQ(json.at("verdict"), "admissible");
  EXPECT_TRUE(json.at("reasons").empty());
  for (const char* key : {"period_s", "wrench_error_max_n", "carrier_separation_min_m", "cable_distance_min_m",
                          "clearance_min_m", "stiffness_min_1_s2", "swing_growth_1_s", "swing_growth_worst_1_s"}) {
    EXPECT_TRUE(json.at(key).is_number()) << key;
  }
  ASSERT_EQ(json.at("carriers").size(), 3u);
  for (const Json& carrier : json.at("carriers")) {
    for (const char* key : {"id", "tension_min_n", "tension_max_n", "length_min_m", "length_max_m",
                            "winch_rate_max_m_s", "speed_min_m_s", "speed_max_m_s", "altitude_swing_m",
                            "acceleration_max_m_s2", "altitude_min_m", "altitude_max_m", "vertical_cosine_min"}) {
      EXPECT_TRUE(carrier.at(key).is_number()) << key;
    }
  }
  EXPECT_TRUE(json["carriers"][0].at("direction_cosine_min").is_number());  // directional
  EXPECT_TRUE(json["carriers"][1].at("direction_cosine_min").is_number());  // level
  EXPECT_TRUE(json["carriers"][2].at("direction_cosine_min").is_null());    // fixed: projects on nothing
}

TEST(Check, TellsWhatTheMissionDoesInSilence) {
  const Answer stops = gyre("check " + shipped("paper"));
  EXPECT_NE(stops.output.find("silence            all stop together after 5 s\n"), std::string::npos) << stops.output;
  const Answer flies = gyre("check " + shipped("paper-enduring"));
  EXPECT_NE(flies.output.find("silence            all fly on, and the clock skew stays within its bound for "),
            std::string::npos)
      << flies.output;
  EXPECT_TRUE(
      Json::parse(gyre("check --json " + shipped("paper-enduring")).output).at("silence_stop_after_s").is_null());
}

TEST(Check, JsonOfARefusedMissionGivesRulesAndCarriers) {
  const Answer answer = gyre("check " + shipped("pair-level") + " --json");
  EXPECT_EQ(answer.exit_code, 1);
  const Json json = Json::parse(answer.output);
  EXPECT_EQ(json.at("verdict"), "refused");
  bool obstruction = false;
  for (const Json& reason : json.at("reasons")) {
    EXPECT_FALSE(reason.at("text").get<std::string>().empty());
    obstruction = obstruction || (reason.at("rule") == "two-carrier obstruction" && reason.at("carrier") == 1);
  }
  EXPECT_TRUE(obstruction) << answer.output;
}

TEST(Check, ASingleCarrierHasNoSeparation) {
  const Answer answer = gyre("check --json " + shipped("single"));
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_TRUE(Json::parse(answer.output).at("carrier_separation_min_m").is_null());
}

TEST(BadUsage, IsTwoWithAMessageAndNoOutput) {
  const std::string broken_file = ::testing::TempDir() + "gyre-broken-mission";
  std::ofstream(broken_file) << "load { mass_kg: -1 }\n";
  const struct {
    std::string arguments;
    std::string complaint;
  } cases[] = {
      {"", "Usage: gyre"},
      {"chekc", "chekc"},
      {"check", "MISSION is required"},
      {"check --jsno " + shipped("paper"), "--jsno"},
      {"check no-such-file", "no-such-file: no such file"},
      {"check '" + source_directory() + "'", "is a directory"},
      {"check '" + broken_file + "'", broken_file + ":1:8: load.mass_kg: is -1"},
      {"sample '" + broken_file + "'", broken_file + ":1:8: load.mass_kg: is -1"},
      {"sample --count 1 " + shipped("paper"), "--count"},
      {"sample --count 1000000000000 " + shipped("paper"), "--count"},
      {"sample --count many " + shipped("paper"), "--count"},
      {"pace", "PACE is required"},
      {"pace 1.1", "PACE"},
      {"pace -0.1", "-0.1"},
      {"pace half", "PACE"},
      {"pace nan", "PACE"},
      {"pace 0.5 0.7", "0.7"},
      {"release --phase", "--phase"},
      {"release --phase 361", "--phase"},
      {"release --phase north", "--phase"},
      {"engage now", "now"},
      {"record -o ''", "--output: an empty word says nothing; give it a value"},
      {"serve --token ''", "--token: an empty word"},
      {"serve --token 'a b'", "--token: it stands in an address"},
      {"fly --port 8480 " + shipped("paper"), "give --page, too"},
      {"fly --token secret " + shipped("paper"), "give --page, too"},
      {"fly --page --token 'a%20b' " + shipped("paper"), "--token: it stands in an address"},
  };
  for (const auto& bad : cases) {
    const Answer answer = gyre(bad.arguments);
    EXPECT_EQ(answer.exit_code, 2) << bad.arguments;
    EXPECT_EQ(answer.output, "") << bad.arguments;
    EXPECT_NE(answer.complaint.find(bad.complaint), std::string::npos) << bad.arguments << "\n" << answer.complaint;
  }
  std::filesystem::remove(broken_file);
}

TEST(Help, IsThereForEveryCommandThatAPageNames) {
  std::set<std::string> commands{""};
  for (const char* page : {"README.md", "ground/README.md", "deploy/README.md"}) {
    std::ostringstream read;
    read << std::ifstream(source_directory() + "/" + page).rdbuf();
    const std::string text = read.str();
    // `gyre check ...`, build/bin/gyre status | engage; not the image of `docker run gyre gyre-agent`
    const std::regex named("[ `/]gyre [a-z]+(?![\\w-])( \\| [a-z]+(?![\\w-]))*");
    const std::regex word("[a-z]+");
    for (std::sregex_iterator found(text.begin(), text.end(), named), none; found != none; ++found) {
      const std::string words = found->str();
      for (std::sregex_iterator w(words.begin() + 6, words.end(), word); w != none; ++w) commands.insert(w->str());
    }
  }
  EXPECT_GE(commands.size(), 9u);
  for (const std::string& command : commands) {
    const Answer answer = gyre(command + " --help");
    EXPECT_EQ(answer.exit_code, 0) << command;
    EXPECT_NE(answer.output.find("Usage: gyre " + command), std::string::npos) << answer.output;
  }
}

TEST(Sample, HasOneRowPerMomentAndCarrierBelowTheHeader) {
  const Answer answer = gyre("sample --count 7 " + shipped("hex-multirotor"));
  EXPECT_EQ(answer.exit_code, 0) << answer.complaint;
  EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1 + 7 * 6);
}

TEST(Sample, ShowsARefusedMotionAndSaysSo) {
  const Answer answer = gyre("sample --count 3 " + shipped("pair-level"));
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(std::count(answer.output.begin(), answer.output.end(), '\n'), 1 + 3 * 2);
  EXPECT_NE(answer.complaint.find("is refused"), std::string::npos);
}

}  // namespace
}  // namespace gyre::test
