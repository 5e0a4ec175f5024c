// Where the network's settings come from, and what is said about wrong ones.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "common/base/log.hpp"
#include "common/dds/clock.hpp"
#include "common/dds/interface.hpp"
#include "common/program/program.hpp"

namespace gyre {
namespace {

using namespace std::chrono_literals;

/// Parses as a program would; its exit code.
int run(std::vector<program::OptionGroup> groups, const std::vector<std::string>& arguments) {
  std::vector<const char*> words{"test"};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  return program::run(program::Command{"test", "", std::move(groups), [] { return 0; }}, static_cast<int>(words.size()),
                      words.data());
}

class Options : public testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }

  static void clear() {
    for (const char* name :
         {"GYRE_DOMAIN", "GYRE_INTERFACE", "GYRE_PEER", "GYRE_NUMBER", "GYRE_A_FLAG", "GYRE_WORD", "ROS_DOMAIN_ID"})
      ::unsetenv(name);
  }
  static void set(const char* name, const char* value) { ::setenv(name, value, 1); }

  static Result<dds::NodeOptions> parse(const std::vector<std::string>& arguments) {
    program::NetworkOptions options;
    EXPECT_EQ(run({program::network_options(options)}, arguments), 0);
    return program::node_options(options, {dds::Hub::kGround, std::nullopt});
  }
};

using OptionsTest = Options;

TEST_F(OptionsTest, StayOnThisMachineUnlessTold) {
  const dds::NodeOptions options = parse({}).value();
  EXPECT_EQ(options.domain, 0);
  EXPECT_EQ(options.interface, "127.0.0.1");
  EXPECT_TRUE(options.peers.empty());
  EXPECT_EQ(options.seat.hub, dds::Hub::kGround);
}

TEST_F(OptionsTest, TakeTheDomainFromTheNearestSource) {
  set("ROS_DOMAIN_ID", "5");
  EXPECT_EQ(parse({}).value().domain, 5);
  set("GYRE_DOMAIN", "6");
  EXPECT_EQ(parse({}).value().domain, 6);
  EXPECT_EQ(parse({"--domain", "7"}).value().domain, 7);
}

TEST_F(OptionsTest, TakeInterfaceAndPeersFromTheEnvironmentToo) {
  set("GYRE_INTERFACE", "10.0.0.2");
  set("GYRE_PEER", "10.0.0.3,10.0.0.4");
  EXPECT_EQ(parse({}).value().interface, "10.0.0.2");
  EXPECT_EQ(parse({}).value().peers, (std::vector<std::string>{"10.0.0.3", "10.0.0.4"}));
  EXPECT_EQ(parse({"--peer", "10.0.0.5", "--peer", "10.0.0.6"}).value().peers,
            (std::vector<std::string>{"10.0.0.5", "10.0.0.6"}));
}

TEST_F(OptionsTest, AreTakenFromTheEnvironmentUnlessTheCommandLineSaysOtherwise) {
  double number = 1.0;
  bool flag = false;
  const std::vector<program::OptionGroup> groups{
      program::own({{"--number", &number, "", program::Bounds{0.0, 9.0}}, {"--a-flag", &flag, ""}})};
  EXPECT_EQ(run(groups, {}), 0);
  EXPECT_EQ(number, 1.0);
  EXPECT_FALSE(flag);
  set("GYRE_NUMBER", "2.5");
  set("GYRE_A_FLAG", "1");
  EXPECT_EQ(run(groups, {}), 0);
  EXPECT_EQ(number, 2.5);
  EXPECT_TRUE(flag);
  EXPECT_EQ(run(groups, {"--number", "3"}), 0);
  EXPECT_EQ(number, 3.0);
}

TEST_F(OptionsTest, RefuseWhatIsOutOfBoundsAndWhatIsNoNumber) {
  double number = 1.0;
  for (const program::Bounds& bounds : {program::Bounds{-1.0, 9.0}, program::kPositive}) {
    for (const char* wrong : {"nan", "-2", "inf", "many", ""}) {
      EXPECT_EQ(run({program::own({{"--number", &number, "", bounds}})}, {"--number", wrong}), program::kBadUsage)
          << wrong;
    }
  }
  EXPECT_EQ(run({program::own({{"--number", &number, "", program::kPositive}})}, {"--number", "0"}),
            program::kBadUsage);
  EXPECT_EQ(run({program::own({{"--number", &number, "", program::Bounds{-1.0, 9.0}}})}, {"--number", "9"}), 0);
}

TEST_F(OptionsTest, AnEmptyWordIsRefusedByHandAndNoneFromTheEnvironment) {
  std::string word = "as before";
  std::optional<std::string> perhaps;
  std::vector<std::string> several;
  const std::vector<program::OptionGroup> groups{
      program::own({{"--word", &word, ""}, {"--perhaps", &perhaps, ""}, {"--several", &several, ""}})};
  set("GYRE_WORD", "");
  EXPECT_EQ(run(groups, {}), 0);
  EXPECT_EQ(word, "as before") << "containers set variables to nothing";
  for (const char* option : {"--word", "--perhaps", "--several"}) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(run(groups, {option, ""}), program::kBadUsage) << option;
    const std::string said = ::testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find(option), std::string::npos) << said;
    EXPECT_NE(said.find("give it a value, or leave it out"), std::string::npos) << said;
  }
}

TEST_F(OptionsTest, AWordTakenByHandIsNotReadFromTheEnvironment) {
  std::string word;
  set("GYRE_WORD", "of the environment");
  EXPECT_EQ(run({program::own({{"WORD", &word, "", {}, program::Take::kRequired}})}, {}), 0);
  EXPECT_EQ(word, "of the environment");
  EXPECT_EQ(run({program::own({{"WORD", &word, "", {}, program::Take::kByHand}})}, {}), program::kBadUsage);
  EXPECT_EQ(run({program::own({{"WORD", &word, "", {}, program::Take::kByHand}})}, {"said"}), 0);
  EXPECT_EQ(word, "said");
}

class ClockOptionsTest : public testing::Test {
 protected:
  void TearDown() override {
    dds::set_clock_error(Duration{}, 0.0);
    for (const char* name : {"GYRE_CLOCK_OFFSET_S", "GYRE_CLOCK_DRIFT_PPM"}) ::unsetenv(name);
  }

  static int parse(const std::vector<std::string>& arguments, program::ClockOptions& options) {
    return run({program::laboratory_options(options)}, arguments);
  }
};

TEST_F(ClockOptionsTest, LeaveTheClockAloneUnlessTold) {
  EXPECT_TRUE(program::apply({}).empty());
  EXPECT_EQ(dds::steady_time(LocalTime(7s)), dds::ClockError::Steady(7s));
}

TEST_F(ClockOptionsTest, MakeTheClockWrongAndSaySo) {
  ::setenv("GYRE_CLOCK_DRIFT_PPM", "-150", 1);
  program::ClockOptions options;
  EXPECT_EQ(parse({"--clock-offset-s", "-7200.5"}, options), 0);
  EXPECT_EQ(options.offset_s, -7200.5);
  EXPECT_EQ(options.drift_ppm, -150.0);
  const Notices notices = program::apply(options);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices.front().level, Notice::Level::kWarning);
  EXPECT_NE(notices.front().text.find("-7200.5 s and -150 ppm"), std::string::npos) << notices.front().text;
  EXPECT_LT(dds::now().time_since_epoch(), std::chrono::steady_clock::now().time_since_epoch() - 7200s);
}

TEST_F(ClockOptionsTest, RefuseWhatNoClockCanBeWrongBy) {
  program::ClockOptions options;
  for (const char* wrong : {"nan", "inf", "-inf", "1e7", "-1e7", "much", ""}) {
    EXPECT_EQ(parse({"--clock-offset-s", wrong}, options), program::kBadUsage) << wrong;
    EXPECT_EQ(parse({"--clock-drift-ppm", wrong}, options), program::kBadUsage) << wrong;
  }
}

// A tool that only listens has nothing to disturb.
TEST(LaboratoryOption, IsForProcessesThatFlyAndOffUnlessAskedFor) {
  program::Options options;
  EXPECT_EQ(run(program::with_common_in_flight({}, options), {}), 0);
  EXPECT_FALSE(options.laboratory);
  EXPECT_EQ(run(program::with_common_in_flight({}, options), {"--laboratory"}), 0);
  EXPECT_TRUE(options.laboratory);
  program::Options by_environment;
  ::setenv("GYRE_LABORATORY", "true", 1);
  EXPECT_EQ(run(program::with_common_in_flight({}, by_environment), {}), 0);
  ::unsetenv("GYRE_LABORATORY");
  EXPECT_TRUE(by_environment.laboratory);
  program::Options of_a_tool;
  EXPECT_EQ(run(program::with_common({}, of_a_tool), {"--laboratory"}), program::kBadUsage);
}

TEST(Interface, IsFoundByItsNameAndAnAddressIsTakenAsItIs) {
  EXPECT_EQ(dds::interface_address("lo").value(), "127.0.0.1");
  EXPECT_EQ(dds::interface_address("192.0.2.1").value(), "192.0.2.1");
  const std::string unknown = dds::interface_address("nosuch0").error().text;
  EXPECT_NE(unknown.find("\"nosuch0\""), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("lo (127.0.0.1)"), std::string::npos) << "what there is: " << unknown;
}

TEST_F(OptionsTest, NameTheSourceOfAWrongDomainAndTheRange) {
  const auto expect_words = [](const Result<dds::NodeOptions>& options, const std::string& source) {
    ASSERT_FALSE(options);
    EXPECT_NE(options.error().text.find(source), std::string::npos) << options.error().text;
    EXPECT_NE(options.error().text.find("0 to 100"), std::string::npos) << options.error().text;
  };
  expect_words(parse({"--domain", "101"}), "--domain");
  expect_words(parse({"--domain", "-1"}), "--domain");
  for (const char* wrong : {"101", "-1", "one", "1x", "99999999999999999999", " 1"}) {
    set("ROS_DOMAIN_ID", wrong);
    expect_words(parse({}), "ROS_DOMAIN_ID");
  }
}

TEST_F(OptionsTest, NameTheOptionOfAWrongAddress) {
  EXPECT_NE(parse({"--peer", "10.0.0.300"}).error().text.find("\"10.0.0.300\""), std::string::npos);
}

TEST(Log, TakesItsLevelsAndListsThemForAnyOther) {
  for (const char* level : {"trace", "debug", "info", "warning", "error", "off"}) EXPECT_TRUE(start_log("test", level));
  const auto wrong = start_log("test", "loud");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().text.find("trace, debug, info"), std::string::npos);
}

}  // namespace
}  // namespace gyre
