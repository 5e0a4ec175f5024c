// Where the network's settings come from, and what is said about wrong ones.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "common/base/log.hpp"
#include "common/dds/interface.hpp"
#include "common/dds/network_options.hpp"

namespace gyre {
namespace {

class Options : public testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }

  static void clear() {
    for (const char* name : {"GYRE_DOMAIN", "GYRE_INTERFACE", "GYRE_PEER", "ROS_DOMAIN_ID"}) ::unsetenv(name);
  }
  static void set(const char* name, const char* value) { ::setenv(name, value, 1); }

  static Result<dds::NodeOptions> parse(std::vector<std::string> arguments) {
    CLI::App app("test");
    dds::NetworkOptions options;
    dds::add_network_options(app, options);
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // what CLI11 takes
    app.parse(reversed);
    return dds::node_options(options, {dds::Hub::kGround, std::nullopt});
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
