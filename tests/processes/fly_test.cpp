// `gyre fly` with the real programs: good flights, and every way for one to go wrong.

#include "tests/processes/launched.hpp"

namespace gyre::test {
namespace {

using testing::HasSubstr;

constexpr double kFlight_s = 60.0;  // a bound, not a measure: the quick mission takes a fifth of it

class FlyTest : public ProgramsTest {
 protected:
  Launched fly(const std::vector<std::string>& more = {"--duration", "2"}) {
    std::vector<std::string> arguments{"fly", quick_mission()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gyre(arguments);
  }
  static std::string domain_of(const Launched& flight) {
    const std::string said = flight.said();
    const std::string before = "on domain ";
    const std::size_t at = said.find(before);
    return at == std::string::npos ? "" : std::to_string(std::stoi(said.substr(at + before.size())));
  }
};

TEST_F(FlyTest, AGoodFlightEndsWithATableAndNothingElse) {
  Launched flight = fly();
  EXPECT_EQ(flight.end_within(kFlight_s).exit_code, 0) << flight.said();
  for (const char* words : {"engaging", "flying", "releasing", "certified", "flown", "carrier 4", "GOOD"}) {
    EXPECT_THAT(flight.said(), HasSubstr(words));
  }
  EXPECT_EQ(kept_logs(), 0);
}

TEST_F(FlyTest, TwoFlightsAtOnceTakeTwoDomains) {
  Launched one = fly();
  Launched other = fly();
  EXPECT_EQ(one.end_within(kFlight_s).exit_code, 0) << one.said();
  EXPECT_EQ(other.end_within(kFlight_s).exit_code, 0) << other.said();
  EXPECT_NE(domain_of(one), "");
  EXPECT_NE(domain_of(one), domain_of(other));
}

TEST_F(FlyTest, ADomainInUseNamesWhoHasIt) {
  Launched one = fly({"--duration", "60"});
  ASSERT_TRUE(one.says_within(kFlight_s, "starting")) << one.said();
  Launched other = fly({"--domain", domain_of(one)});
  EXPECT_EQ(other.end_within(10.0).exit_code, 1);
  EXPECT_THAT(other.said(), HasSubstr("domain " + domain_of(one) + " cannot be used"));
  EXPECT_THAT(other.said(), HasSubstr("pid " + std::to_string(one.pid()) + " (gyre)"));
}

TEST_F(FlyTest, AMissingProgramIsNamedWithTheCure) {
  for (const std::string missing : {"gyre-simulator", "gyre-coordinator", "gyre-agent"}) {
    const std::string home = directory() + "/without-" + missing;
    std::filesystem::create_directory(home);
    for (const std::string program : {"gyre", "gyre-simulator", "gyre-coordinator", "gyre-agent"}) {
      if (program != missing) std::filesystem::copy_file(built(program), home + "/" + program);
    }
    Launched flight = launch({home + "/gyre", "fly", quick_mission()});
    EXPECT_EQ(flight.end_within(10.0).exit_code, 1);
    EXPECT_THAT(flight.said(), HasSubstr(home + "/" + missing + " is missing"));
    EXPECT_THAT(flight.said(), HasSubstr("build"));
  }
}

TEST_F(FlyTest, AKilledProcessIsNamedAndEndsTheFlight) {
  for (const std::string victim : {"gyre-agent --carrier 2", "gyre-simulator", "gyre-coordinator"}) {
    Launched flight = fly({"--duration", "60"});
    ASSERT_TRUE(flight.says_within(kFlight_s, "flying")) << flight.said();
    const auto pids = marked(victim);
    ASSERT_EQ(pids.size(), 1U) << victim;
    ::kill(pids.front(), SIGKILL);
    EXPECT_EQ(flight.end_within(10.0).exit_code, 1);
    EXPECT_THAT(flight.said(), HasSubstr(" was killed by signal 9"));
    if (victim == "gyre-agent --carrier 2") {
      EXPECT_THAT(flight.said(), HasSubstr("agent 2 was killed"));
    }
    EXPECT_TRUE(marked().empty());
  }
  EXPECT_EQ(kept_logs(), 3);
}

TEST_F(FlyTest, AKilledFlyLeavesNobodyBehind) {
  Launched flight = fly({"--duration", "60"});
  ASSERT_TRUE(flight.says_within(kFlight_s, "flying")) << flight.said();
  EXPECT_GE(marked().size(), 7U);
  flight.send(SIGKILL);
  flight.end_within(2.0);
  EXPECT_TRUE(holds_within(2.0, [&] { return marked().empty(); }));
}

TEST_F(FlyTest, AskedToStopItReleasesTheLoadAndJudges) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Launched flight = fly({"--duration", "60"});
    ASSERT_TRUE(flight.says_within(kFlight_s, "flying")) << flight.said();
    flight.send(signal);
    EXPECT_EQ(flight.end_within(30.0).exit_code, 0) << flight.said();
    EXPECT_THAT(flight.said(), HasSubstr("releasing"));
    EXPECT_THAT(flight.said(), HasSubstr("GOOD"));
  }
}

TEST_F(FlyTest, AskedToStopBeforeItFliesItJustEnds) {
  Launched flight = fly({"--duration", "60"});
  ASSERT_TRUE(flight.says_within(kFlight_s, "starting")) << flight.said();
  flight.send(SIGINT);
  EXPECT_EQ(flight.end_within(30.0).exit_code, 0) << flight.said();
  EXPECT_THAT(flight.said(), HasSubstr("nothing to judge"));
}

TEST_F(FlyTest, AskedTwiceItEndsAtOnce) {
  Launched flight = fly({"--duration", "60"});
  ASSERT_TRUE(flight.says_within(kFlight_s, "flying")) << flight.said();
  flight.send(SIGINT);
  ASSERT_TRUE(flight.says_within(10.0, "releasing")) << flight.said();
  flight.send(SIGINT);
  EXPECT_EQ(flight.end_within(5.0).exit_code, 1);
  EXPECT_THAT(flight.said(), HasSubstr("at once, as asked: the load was not brought to rest.\nAll logs: "));
}

TEST_F(FlyTest, AReleaseFromOutsideEndsTheFlightWell) {
  Launched flight = fly({"--duration", "60"});
  ASSERT_TRUE(flight.says_within(kFlight_s, "flying")) << flight.said();
  Launched release = gyre({"release", "--domain", domain_of(flight)});
  EXPECT_EQ(release.end_within(20.0).exit_code, 0) << release.said();
  EXPECT_EQ(flight.end_within(30.0).exit_code, 0) << flight.said();
  EXPECT_THAT(flight.said(), HasSubstr("GOOD"));
}

TEST_F(FlyTest, APersonSlowsTheMotionSeesItInStatusAndStopsItAtAPhase) {
  Launched flight = fly({"--duration", "60"});
  ASSERT_TRUE(flight.says_within(kFlight_s, "flying")) << flight.said();
  const std::string domain = domain_of(flight);
  Launched pace = gyre({"pace", "0.5", "--domain", domain});
  EXPECT_EQ(pace.end_within(20.0).exit_code, 0) << pace.said();
  EXPECT_THAT(pace.said(), HasSubstr("the swarm goes to 50 % of its pace"));
  ASSERT_TRUE(flight.says_within(10.0, "slowed")) << flight.said();
  Launched again = gyre({"pace", "0.5", "--domain", domain});
  EXPECT_EQ(again.end_within(20.0).exit_code, 1) << "already at that pace";
  Launched status = gyre({"status", "--domain", domain});
  EXPECT_EQ(status.end_within(20.0).exit_code, 0) << status.said();
  EXPECT_THAT(status.said(), HasSubstr("wish     motion at 50 %, as a person asked; the pace is "));
  EXPECT_THAT(status.said(), HasSubstr("the lease runs for another "));
  Launched release = gyre({"release", "--phase", "90", "--domain", domain});
  EXPECT_EQ(release.end_within(20.0).exit_code, 0) << release.said();
  EXPECT_THAT(release.said(), HasSubstr("the swarm comes to rest"));
  EXPECT_EQ(flight.end_within(60.0).exit_code, 0) << flight.said();
  EXPECT_THAT(flight.said(), HasSubstr("GOOD"));
}

TEST_F(FlyTest, ARefusedMissionIsRefusedAsByCheck) {
  Launched flight = gyre({"fly", shipped_mission("pair-level")});
  EXPECT_EQ(flight.end_within(10.0).exit_code, 1);
  EXPECT_THAT(flight.said(), HasSubstr("two-carrier obstruction"));
  EXPECT_EQ(kept_logs(), 0);
}

TEST_F(FlyTest, BadUsageAndBadFilesStartNothing) {
  const std::string garbage = directory() + "/garbage.textproto";
  std::ofstream(garbage) << "load { mass_kg: } ???";
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"fly", garbage},
                                                    {"fly", directory() + "/nowhere.textproto"},
                                                    {"fly", quick_mission(), "--domain", "101"},
                                                    {"fly", quick_mission(), "--interface", "localhost"},
                                                    {"fly", quick_mission(), "--duration", "0"},
                                                    {"fly", quick_mission(), "--duration", "nan"},
                                                    {"fly"}}) {
    Launched flight = gyre(arguments);
    EXPECT_EQ(flight.end_within(10.0).exit_code, 2) << flight.said();
    EXPECT_NE(flight.said(), "");
  }
  EXPECT_EQ(kept_logs(), 0);
}

TEST_F(FlyTest, LogsGoWhereTheyAreWanted) {
  const std::string logs = directory() + "/my/logs";
  Launched flight = fly({"--duration", "0.5", "--logs", logs});
  EXPECT_EQ(flight.end_within(kFlight_s).exit_code, 0) << flight.said();
  for (const char* name : {"simulator", "coordinator", "agent-1", "agent-4"}) {
    EXPECT_TRUE(std::filesystem::exists(logs + "/" + name + ".log")) << name;
  }
}

}  // namespace
}  // namespace gyre::test
