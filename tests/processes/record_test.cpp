// `gyre record` beside real flights: ended in order, killed, and on a disk that is full.

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/page/event_stream.hpp"
#include "tests/processes/launched.hpp"
#include "tests/recording/judge.hpp"
#include "tests/recording/said_of.hpp"

namespace gyre::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kFlight_s = 60.0;  // a bound, not a measure

class RecordTest : public ProgramsTest {
 protected:
  /// Flying, on a domain that it has found for itself.
  Launched flight(const std::string& duration_s) {
    Launched launched = gyre({"fly", quick_mission(), "--duration", duration_s});
    EXPECT_TRUE(launched.says_within(kFlight_s, "on domain ")) << launched.said();
    const std::string said = launched.said();
    const std::size_t at = said.find("on domain ");
    domain = at == std::string::npos ? "0" : std::to_string(std::stoi(said.substr(at + 10)));
    return launched;
  }
  Launched recorder(const std::string& path, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"record", "-o", path, "--domain", domain};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Launched launched = gyre(arguments);
    EXPECT_TRUE(launched.says_within(kFlight_s, "recording to " + path)) << launched.said();
    return launched;
  }
  static std::uint64_t count(const json& said, const std::string& topic) {
    return said["topics"].value(topic, std::uint64_t{0});
  }

  std::string domain = "0";
};

/// Judged by the public readers; false, and why, where they are not to be had.
bool judged_by_others(const std::string& path, const json& said) {
  const std::string said_path = path + ".json";
  std::ofstream(said_path) << said.dump();
  return tests::judged("judge.mjs", path + " " + said_path);
}

TEST_F(RecordTest, AFlightIsRecordedAndAKilledRecorderLosesItsLastSecondOnly) {
  const std::string path = directory() + "/flight.mcap";
  const std::string killed_path = directory() + "/killed.mcap";
  Launched fly = flight("5");
  Launched in_order = recorder(path, {"--mission", quick_mission()});
  Launched killed = recorder(killed_path);
  ASSERT_TRUE(fly.says_within(kFlight_s, "flying")) << fly.said();
  std::this_thread::sleep_for(std::chrono::seconds(3));
  killed.send(SIGKILL);
  killed.end_within(5.0);
  EXPECT_EQ(fly.end_within(kFlight_s).exit_code, 0) << fly.said();
  in_order.send(SIGTERM);
  EXPECT_EQ(in_order.end_within(10.0).exit_code, 0) << in_order.said();
  EXPECT_THAT(in_order.said(), HasSubstr("/gyre/carrier_N/setpoint"));
  EXPECT_THAT(in_order.said(), HasSubstr("lost on the wire:"));

  const json whole = tests::said_of(path);
  EXPECT_TRUE(whole["whole"].get<bool>());
  EXPECT_EQ(whole["problems"].size(), 0U) << whole["problems"];
  for (const char* topic : {"/gyre/phase", "/gyre/load/state", "/gyre/coordinator/status", "/gyre/health",
                            "/gyre/mission", "/tf", "/gyre/scene", "/gyre/load_pose", "/gyre/orbits"}) {
    EXPECT_GT(count(whole, topic), 0U) << topic;
  }
  for (const char* id : {"1", "2", "3", "4"}) {
    for (const char* topic : {"plan", "held", "time_request", "time_reply", "status", "setpoint", "state"}) {
      const std::string name = "/gyre/carrier_" + std::string(id) + "/" + topic;
      EXPECT_GT(count(whole, name), 0U) << name;
    }
  }
  EXPECT_GT(count(whole, "/gyre/carrier_1/setpoint"), 300U) << "five seconds at 100 Hz, and more";
  EXPECT_EQ(whole["samples"]["/gyre/mission"]["text"].get<std::string>().find("name:"), 0U);
  const json last_word = whole["metadata"]["gyre_recording"];
  EXPECT_EQ(last_word["not_written"], "0");

  const json cut = tests::said_of(killed_path);
  EXPECT_FALSE(cut["whole"].get<bool>());
  EXPECT_EQ(cut["problems"].size(), 1U) << cut["problems"];
  EXPECT_THAT(cut["problems"].dump(), HasSubstr("cut off"));
  EXPECT_GT(count(cut, "/gyre/carrier_1/setpoint"), 100U) << "three seconds at 100 Hz, less the last one";

  // gyre report says of the recording what gyre fly said of the flight, and of the killed one as far as it goes.
  Launched report = gyre({"report", path, killed_path, "-o", directory() + "/report"});
  EXPECT_EQ(report.end_within(20.0).exit_code, 0) << report.said();
  EXPECT_THAT(report.said(), HasSubstr("GOOD: the flight stayed inside its certificate."));
  EXPECT_THAT(report.said(), HasSubstr("The file has no end"));
  EXPECT_TRUE(std::filesystem::exists(directory() + "/report/index.html"));

  // And gyre replay shows it again, as far as it goes.
  Launched replay = gyre({"replay", path, "--page", "--port", "0", "--speed", "4"});
  ASSERT_TRUE(replay.says_within(20.0, "#token=")) << replay.said();
  EventStream stream(std::stoi(replay.said().substr(replay.said().find("http://127.0.0.1:") + 17)));
  const auto hello = stream.until("hello", [](const json&) { return true; });
  ASSERT_TRUE(hello);
  EXPECT_EQ((*hello)["takes_orders"], false);
  const auto flying = stream.until("frame", [](const json& frame) { return frame["pace"] == 1.0; });
  ASSERT_TRUE(flying);
  EXPECT_EQ((*flying)["carriers"].size(), 4U);
  replay.send(SIGTERM);
  EXPECT_EQ(replay.end_within(10.0).exit_code, 0) << replay.said();
  // Each process decides again as it did, by its journal, though the recorder came a moment after it.
  for (const std::string who : {"--agent 1", "--agent 4", "--coordinator"}) {
    const std::size_t blank = who.find(' ');
    std::vector<std::string> words{"replay", path, who.substr(0, blank)};
    if (blank != std::string::npos) words.push_back(who.substr(blank + 1));
    Launched again = gyre(words);
    EXPECT_EQ(again.end_within(20.0).exit_code, 0) << again.said();
    EXPECT_THAT(again.said(), HasSubstr("It decides as it did then.")) << who;
  }
  Launched half = gyre({"replay", killed_path, "--agent", "1"});
  EXPECT_EQ(half.end_within(20.0).exit_code, 0) << "the second to record, and killed: " << half.said();
  EXPECT_THAT(half.said(), HasSubstr("The journal ends there: the recording was cut off."));
  Launched to_the_cut = gyre({"replay", killed_path, "--page", "--port", "0", "--speed", "100"});
  EXPECT_TRUE(to_the_cut.says_within(20.0, "the recording was cut off here")) << to_the_cut.said();

  const bool judged = judged_by_others(path, whole) && judged_by_others(killed_path, cut);
  if (!judged) GTEST_SKIP() << "all good, and not judged by others: no Node, or no npm";
}

TEST_F(RecordTest, AFullDiskIsSaidAndSurvived) {
  const std::string disk = directory() + "/disk";
  const std::string path = disk + "/flight.mcap";
  const std::string kept = directory() + "/kept.mcap";
  ::mkdir(disk.c_str(), 0700);
  Launched fly = flight("6");
  const std::string record = built("gyre") + " record -o " + path + " --domain " + domain;
  // A disk of its own, of which a filler leaves a little: the file system goes with its last process.
  Launched in_its_mounts =
      launch({"/usr/bin/unshare", "-m", "sh", "-c",
              "mount -t tmpfs -o size=1m tmpfs " + disk + " || exit 77; head -c 900k /dev/zero > " + disk +
                  "/filler; " + record + "; code=$?; cp " + path + " " + kept + "; exit $code"});
  if (!in_its_mounts.says_within(kFlight_s, "recording to")) {
    fly.send(SIGTERM);
    fly.end_within(kFlight_s);
    GTEST_SKIP() << "a disk of one's own needs root: " << in_its_mounts.said();
  }
  EXPECT_TRUE(in_its_mounts.says_within(20.0, "the disk is full; make room on it")) << in_its_mounts.said();
  const auto recorders = marked("record -o " + path + " --domain");
  ASSERT_FALSE(recorders.empty());
  const pid_t recorder = recorders.back();
  std::filesystem::remove("/proc/" + std::to_string(recorder) + "/root" + disk + "/filler");
  EXPECT_TRUE(in_its_mounts.says_within(20.0, "it can be written again")) << in_its_mounts.said();
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  ::kill(recorder, SIGTERM);
  EXPECT_EQ(in_its_mounts.end_within(10.0).exit_code, 1) << "not all was written";
  EXPECT_THAT(in_its_mounts.said(), HasSubstr("not written, because the disk was full"));
  EXPECT_EQ(fly.end_within(kFlight_s).exit_code, 0) << "nobody else noticed: " << fly.said();
  const json said = tests::said_of(kept);
  EXPECT_TRUE(said["whole"].get<bool>());
  EXPECT_EQ(said["problems"].size(), 0U) << said["problems"];
  EXPECT_GT(said["messages"].get<int>(), 100);
  EXPECT_NE(said["metadata"]["gyre_recording"]["not_written"], "0");
}

TEST_F(RecordTest, WhatCannotBeWrittenIsBadUsage) {
  const std::string there = directory() + "/there.mcap";
  std::ofstream(there) << "precious";
  const auto words_of = [&](const std::string& path, const std::string& words) {
    Launched refused = gyre({"record", "-o", path, "--duration", "1", "--domain", "98"});
    EXPECT_EQ(refused.end_within(10.0).exit_code, 2);
    EXPECT_THAT(refused.said(), HasSubstr(words));
  };
  words_of(there, "--force");
  words_of(directory() + "/nowhere/a.mcap", "there is no such folder");
  Launched forced = gyre({"record", "-o", there, "--duration", "0.2", "--domain", "98", "--force"});
  EXPECT_EQ(forced.end_within(10.0).exit_code, 0) << forced.said();
  const json said = tests::said_of(there);
  EXPECT_TRUE(said["whole"].get<bool>()) << "nobody spoke, and it is a recording all the same";
  EXPECT_EQ(said["messages"], 0);
}

TEST_F(RecordTest, AFileThatIsDeletedMeanwhileIsSaidOnceAndTheRecordingGoesOn) {
  const std::string path = directory() + "/deleted.mcap";
  domain = "98";  // where nobody flies
  Launched record = recorder(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(record.says_within(kFlight_s, path + " was deleted")) << record.said();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  record.send(SIGTERM);
  EXPECT_EQ(record.end_within(10.0).exit_code, 1) << record.said();
  const std::string said = record.said();
  EXPECT_EQ(said.find(" was deleted"), said.rfind(" was deleted")) << said;
  EXPECT_THAT(said, HasSubstr("0 messages")) << "and it has ended in order";
}

}  // namespace
}  // namespace gyre::test
